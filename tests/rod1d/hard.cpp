// Starts and paths on which a rod could well go wrong.

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "rod1d/polyline.h"
#include "rod1d/rod_problem.h"
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
    "hard: a start whose strands overlap by a tenth of a diameter is pushed out, as the same "
    "knot") {
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

TEST_CASE("hard: a start in which strands run through each other is refused") {
  RodParameters parameters = rod(50, 300, {20});
  const RodResult loose = run_rod(parameters);
  RodParameters overlapping = rod(22.5, 300, {9});
  for (const Vector3& p : loose.states[0].nodes) overlapping.start.push_back(0.45 * p);
  CHECK_THROWS_WITH(run_rod(overlapping), Catch::Contains("overlap"));
}

TEST_CASE("hard: a knot that was tight is loosened again, over the way it came") {
  const RodResult result = run_rod(rod(42.17, 240, {29, 10, 29}));
  INFO(result.outcome.reason);
  REQUIRE(result.outcome.status == PathStatus::finished);
  REQUIRE(result.states.size() == 3);
  CHECK(result.states[2].determinant == 3);
  CHECK(result.states[2].tension == Approx(result.states[0].tension).epsilon(0.005));
}

TEST_CASE("hard: five segments end in words or in the knot") {
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

TEST_CASE("hard: strands that are exactly parallel bear their load evenly") {
  constexpr int leg = 120, arc = 20;  // segments; the legs are 20 D long
  const ContactLaw law{50, 0.004};
  Polyline line;
  for (int i = 0; i <= leg; ++i) line.push_back({-0.5, 0, 20.0 * i / leg});
  for (int i = 1; i < arc; ++i)
    line.push_back({-0.5 * std::cos(M_PI * i / arc), 0, 20 + 0.5 * std::sin(M_PI * i / arc)});
  for (int i = leg; i >= 0; --i) line.push_back({0.5, 0, 20.0 * i / leg});
  Rod rod = uniform_rod(1, static_cast<int>(line.size()) - 1, 0.5);
  for (int i = 0; i < rod.segments(); ++i) rod.rest_length[i] = (line[i + 1] - line[i]).norm();
  const int last = rod.segments();
  double overlap[2];
  for (const int k : {0, 1}) {
    RodProblem problem(rod, line, false, {law});
    const double load = (k + 1) * 1e-3 * 20 / leg;  // on a node: 0.001 and 0.002 E D per length
    problem.hold(0), problem.hold(last);
    for (int i = leg - 1; i <= leg + arc + 1; ++i) problem.hold(i);  // bears the arc's moment
    for (int i = 1; i < leg - 1; ++i)
      for (const int node : {i, last - i}) {
        problem.hold(node, 1);
        problem.load(node, {node < leg ? load : -load, 0, 0});
      }
    const NewtonResult result = problem.solve();
    INFO(result.reason);
    REQUIRE(result.ok());
    const Polyline nodes = problem.nodes();
    double least = 1, most = -1;
    for (int i = leg / 4; i <= 3 * leg / 4; ++i) {
      const double gap = nodes[last - i].x() - nodes[i].x() - 1;
      least = std::min(least, -gap), most = std::max(most, -gap);
    }
    std::printf("measured  hard: parallel strands: overlap %.6f to %.6f D, %d iterations\n", least,
                most, result.iterations);
    CHECK(law.touches(-least));
    CHECK(most - least < 1e-5);
    overlap[k] = most;
  }
  CHECK(overlap[1] > overlap[0]);
}
