#include "rod1d/effects/magnetic.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "mechanics/newton.h"
#include "rod1d/effects/bend.h"
#include "rod1d/effects/stretch.h"
#include "rod1d/run_rod.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

/// Square of m at which a straight cantilever of unit length and bending stiffness, across the
/// field, ceases to be stable. Its first segment lies half inside the clamp.
double critical(int segments) {
  Rod rod;
  const double h = 1 / (segments - 0.5);
  rod.rest_length.assign(segments, h);
  rod.bending_stiffness = 1;
  rod.stretching_stiffness = 1e6;
  Vector x = Vector::Zero(3 * rod.nodes());
  for (int i = 0; i < rod.nodes(); ++i) x[3 * i + 2] = (i - 0.5) * h;
  std::vector<bool> held(x.size(), false);
  for (int c = 0; c < 6; ++c) held[c] = true;
  const Unknowns unknowns(rod.blocks(false), static_cast<int>(x.size()), held);
  double low = 0, high = 10;
  while (high - low > 1e-7) {
    const double middle = 0.5 * (low + high);
    EffectList effects;
    effects.push_back(std::make_unique<Stretch>(rod));
    effects.push_back(std::make_unique<Bend>(rod));
    effects.push_back(std::make_unique<Magnetic>(rod, Vector3(std::sqrt(middle), 0, 0)));
    Assembler assembler(unknowns, effects);
    (stable(assembler, x) ? low : high) = middle;
  }
  return low;
}

}  // namespace

// The angle theta of the tangent to its rest minimises 1/2 the integral of theta'^2 - m^2 theta^2:
// theta'' + m^2 theta = 0 with theta(0) = theta'(1) = 0.
TEST_CASE("a cantilever across a magnetic field buckles at m^2 L^2/B = pi^2/4") {
  const double exact = M_PI * M_PI / 4;
  const double coarse = std::abs(critical(20) / exact - 1),
               fine = std::abs(critical(40) / exact - 1);
  INFO(coarse << " " << fine);
  CHECK(fine < 5e-4);
  CHECK(std::log2(coarse / fine) == Approx(2).margin(0.2));
}

TEST_CASE("a knot in a magnetic field: the work of its ends is its energy") {
  RodParameters parameters;
  parameters.segments = 170;
  parameters.path.waypoints = parameters.path.record = {26, 24};
  const RodResult free = run_rod(parameters);
  parameters.magnetic = Vector3(0, 0, 0.03);
  const RodResult along = run_rod(parameters);
  REQUIRE(along.outcome.status == PathStatus::finished);
  CHECK(along.states.back().determinant == 3);
  CHECK(along.states.back().energy_by_effect.at("magnetic") < 0);
  // The field turns the loop into its line: less force is needed to hold the ends apart.
  CHECK(along.steps.back().tension < 0.98 * free.steps.back().tension);
  for (size_t i = 1; i < along.steps.size(); ++i) {
    const StepRow &row = along.steps[i], &before = along.steps[i - 1];
    const double work = 0.5 * (row.tension + before.tension) * (before.ebar - row.ebar);
    CHECK(row.energy - before.energy == Approx(work).epsilon(0.01));
  }
}
