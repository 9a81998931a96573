#include "rod1d/flattening.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace bight;
using namespace bight::rod1d;

namespace {

std::vector<RubbingPoint> pressed(double force) {
  RubbingPoint piece;
  piece.force = force;
  return {piece};
}

}  // namespace

TEST_CASE("the energy of flattening is the work of the approach of two long cylinders") {
  const double nu = 0.5, q = 0.05, h = 1e-4;
  const auto energy = [&](double load) {
    return flattening_energy(pressed(load * piece_length), nu) / piece_length;
  };
  // dU/dq = d, the approach by Johnson (1985), eq. 5.58, twice: one for each cylinder.
  const double a = std::sqrt(2 * q * 0.5 / (std::numbers::pi * 1 / (2 * (1 - nu * nu))));
  const double approach = 2 * q * (1 - nu * nu) / std::numbers::pi * (2 * std::log(2 / a) - 1);
  CHECK((energy(q + h) - energy(q - h)) / (2 * h) == Approx(approach).epsilon(1e-5));
  CHECK(approach == Approx(0.098).epsilon(0.01));  // a tenth of D, as tight knots flatten
  CHECK(energy(0) == 0);
}

TEST_CASE("pieces flatten by themselves") {
  auto two = pressed(0.003);
  two.push_back(two[0]);
  CHECK(flattening_energy(two, 0.5) == Approx(2 * flattening_energy(pressed(0.003), 0.5)));
}
