// Starts and paths on which a rod could well go wrong.

#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "rod1d/polyline.h"
#include "rod1d/run_rod.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

RodParameters rod(double length, int segments, std::vector<double> waypoints) {
  RodParameters parameters;
  parameters.length = length;
  parameters.segments = segments;
  parameters.path.record = waypoints;
  parameters.path.waypoints = std::move(waypoints);
  return parameters;
}

}  // namespace

TEST_CASE(
    "a start whose strands overlap by a tenth of a diameter is pushed out, as the same knot") {
  const char* knot = GENERATE("overhand", "figure-eight");
  INFO(knot);
  RodParameters parameters = rod(50, 300, {22});
  parameters.knot = knot;
  const RodResult loose = run_rod(parameters);
  REQUIRE(loose.outcome.status == PathStatus::finished);
  // Made smaller by a tenth, with the diameter kept.
  RodParameters overlapping = rod(45, 300, {0.9 * 22});
  for (const Vector3& p : loose.states[0].nodes) overlapping.start.push_back(0.9 * p);
  CHECK(smallest_distance(resampled(overlapping.start, 450), 3) < 0.91);
  const RodResult pushed = run_rod(overlapping);
  INFO(pushed.outcome.reason);
  REQUIRE(pushed.outcome.status == PathStatus::finished);
  CHECK(pushed.states[0].determinant == loose.states[0].determinant);
  CHECK(pushed.steps[0].max_penetration < 0.002);
  overlapping.start.clear();
  overlapping.knot = knot;
  const RodResult direct = run_rod(overlapping);
  CHECK(pushed.steps[0].tension == Approx(direct.steps[0].tension).epsilon(0.005));
}

TEST_CASE("a start in which strands run through each other is refused") {
  RodParameters parameters = rod(50, 300, {20});
  const RodResult loose = run_rod(parameters);
  RodParameters overlapping = rod(22.5, 300, {9});
  for (const Vector3& p : loose.states[0].nodes) overlapping.start.push_back(0.45 * p);
  CHECK_THROWS_WITH(run_rod(overlapping), Catch::Contains("overlap"));
}

TEST_CASE("a knot that was tight is loosened again, over the way it came") {
  const RodResult result = run_rod(rod(42.17, 240, {29, 10, 29}));
  INFO(result.outcome.reason);
  REQUIRE(result.outcome.status == PathStatus::finished);
  REQUIRE(result.states.size() == 3);
  CHECK(result.states[2].determinant == 3);
  CHECK(result.states[2].tension == Approx(result.states[0].tension).epsilon(0.005));
}

TEST_CASE("five segments end in words or in the knot") {
  const bool follow = GENERATE(true, false);
  RodParameters parameters = rod(42.17, 5, {30, 28});
  parameters.follow_knot = follow;
  try {
    const RodResult result = run_rod(parameters);
    if (result.outcome.status == PathStatus::finished)
      CHECK(result.states.back().determinant == 3);
    else
      CHECK_FALSE(result.outcome.reason.empty());
  } catch (const std::invalid_argument& error) {
    CHECK_THAT(error.what(), Catch::Contains("5 segments"));
  }
}
