#include "mechanics/snap.h"

#include <catch2/catch.hpp>

using namespace bight;

TEST_CASE("what a step loses is what the work of its ends does not explain") {
  const Equilibrium from{10, 5, 1};
  // The ends do work T times the shortening, with T between both values.
  CHECK(energy_lost(from, {9, 6.1, 1.2}) == 0);
  CHECK(energy_lost(from, {11, 4, 0.9}) == 0);
  // A little less is an error of the mesh.
  CHECK(energy_lost(from, {9, 5.95, 1}) == 0);
  CHECK(energy_lost(from, {9, 5.5, 1}) == Approx(0.5));
  CHECK(energy_lost(from, {11, 3.5, 1}) == Approx(0.5));
  // Behind a snap T is another.
  CHECK(energy_lost(from, {9.99, 4.5, 0.5}) == Approx(0.505));
}
