// Knots that are pulled by a given force.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "rod1d/run_rod.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

RodParameters pulled(const std::string& knot, double friction, std::vector<double> forces) {
  RodParameters parameters;
  parameters.knot = knot;
  parameters.segments = 340;
  parameters.friction = friction;
  parameters.twist = friction > 0;
  parameters.forces = std::move(forces);
  return parameters;
}

}  // namespace

TEST_CASE("a knot is pulled to the forces asked for, and at their ebar it has these forces") {
  const char* knot = GENERATE("overhand", "figure-eight");
  RodParameters parameters = pulled(knot, 0, {0.003, 0.02, 0.006});
  // Nodes that follow the knot depend a little on the way that they came.
  parameters.follow_knot = false;
  const RodResult result = run_rod(parameters);
  INFO(knot << ": " << result.outcome.reason);
  REQUIRE(result.outcome.status == PathStatus::finished);
  REQUIRE(result.states.size() == 3);
  RodParameters back = parameters;
  back.forces.clear();
  for (size_t i = 0; i < 3; ++i) {
    CHECK(result.states[i].tension == Approx(parameters.forces[i]).epsilon(1.01e-4));
    back.path.waypoints.push_back(result.states[i].ebar);
  }
  CHECK(result.states[1].ebar < result.states[2].ebar);
  CHECK(result.states[2].ebar < result.states[0].ebar);
  back.path.record = back.path.waypoints;
  const RodResult at = run_rod(back);
  REQUIRE(at.states.size() == 4);  // the last ebar is passed on the way, too
  for (size_t i = 0; i < 3; ++i)
    CHECK(at.states[i == 0 ? 0 : i + 1].tension == Approx(parameters.forces[i]).epsilon(1e-3));
}

TEST_CASE("with friction less force holds a knot that is let go than one that is pulled") {
  const RodParameters parameters = pulled("overhand", 0.1, {0.003, 0.006, 0.003});
  const RodResult result = run_rod(parameters);
  INFO(result.outcome.reason);
  REQUIRE(result.outcome.status == PathStatus::finished);
  REQUIRE(result.states.size() == 3);
  // On the way back the same force is met tighter.
  CHECK(result.states[2].ebar < result.states[0].ebar - 1);
  RodParameters back = parameters;
  back.forces.clear();
  for (const RodState& state : result.states) back.path.waypoints.push_back(state.ebar);
  back.path.record = back.path.waypoints;
  const RodResult at = run_rod(back);
  REQUIRE(at.states.size() == 4);
  for (size_t i = 0; i < 3; ++i)
    CHECK(at.states[i == 0 ? 0 : i + 1].tension == Approx(parameters.forces[i]).epsilon(1e-3));
}

TEST_CASE("a force that no equilibrium of the knot has ends in words") {
  const RodResult result = run_rod(pulled("overhand", 0, {1e-5}));
  CHECK(result.outcome.status == PathStatus::gave_up);
  CHECK_THAT(result.outcome.reason, Catch::Contains("does not take this force"));
}
