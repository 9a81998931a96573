#include "solid3d/skin_crossings.h"

#include <catch2/catch.hpp>

#include "tests/solid3d/shapes.h"

using namespace bight;
using namespace bight::solid3d;

TEST_CASE("skins cut each other where strands overlap by more than they were drawn in") {
  const double radius = 2.0, turn = 2 * M_PI * radius;
  for (const int cells : {12, 60}) {
    const Mesh mesh = test::straight_mesh(cells, 1.6 * turn, 1.0);
    const ContactSurface surface(mesh);
    const auto crossings = [&](double pitch, double inward) {
      return skin_crossings(surface, test::helix_state(mesh, radius, pitch, 0), inward);
    };
    CHECK(crossings(1.02, 0) == 0);
    CHECK(crossings(0.96, 0.025) == 0);
    CHECK(crossings(0.96, 0.015) > 10);
    CHECK(crossings(0.5, 0.1) > 100);  // one strand has sunk into the next
  }
}

TEST_CASE("a bend that folds its own skin cuts itself, though neighbours never touch in contact") {
  const Mesh mesh = test::straight_mesh(12, 2.0, 1.0);
  const ContactSurface surface(mesh);
  CHECK(skin_crossings(surface, test::helix_state(mesh, 0.6, 2.0, 0), 0) == 0);
  CHECK(skin_crossings(surface, test::helix_state(mesh, 0.3, 0.0, 0), 0) > 10);
}
