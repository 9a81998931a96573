#include "rod1d/run_rod.h"

#include <omp.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "mechanics/knot_type.h"
#include "rod1d/measure.h"
#include "rod1d/overhand.h"
#include "rod1d/polyline.h"
#include "rod1d/rod_model.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

RodParameters tight_overhand(int segments, std::vector<double> waypoints) {
  RodParameters parameters;
  parameters.segments = segments;
  parameters.path.waypoints = std::move(waypoints);
  return parameters;
}

double tbar(double tension) { return tension * 16 / M_PI; }

}  // namespace

TEST_CASE("the overhand knot tightens: T = -dE/debar, small overlap, ends in balance") {
  RodParameters parameters = tight_overhand(170, {26, 12});
  parameters.path.record = {20, 15, 12};
  int steps_seen = 0, records_seen = 0;
  RodObserver observer;
  observer.on_step = [&](const StepRow&) { ++steps_seen; };
  observer.on_record = [&](const RodState&) { ++records_seen; };
  const RodResult result = run_rod(parameters, observer);

  REQUIRE(result.outcome.status == PathStatus::finished);
  CHECK(steps_seen == static_cast<int>(result.steps.size()));
  REQUIRE(records_seen == 3);
  CHECK(result.effects == std::vector<std::string>{"stretch", "bend", "contact"});
  for (size_t i = 0; i < result.steps.size(); ++i) {
    const StepRow& row = result.steps[i];
    INFO("ebar " << row.ebar);
    CHECK(row.max_penetration < 0.002);
    CHECK(row.contact_pairs > 0);
    CHECK(row.residual < 1e-6);
    CHECK(row.reaction_mismatch < 1e-6);
    if (i == 0) continue;
    const StepRow& before = result.steps[i - 1];
    CHECK(row.tension > before.tension);
    const double work = -(row.energy - before.energy) / (row.ebar - before.ebar);
    // Logarithmic mean of T, which grows like a power of 1/ebar.
    const double mean = (row.tension - before.tension) / std::log(row.tension / before.tension);
    CHECK(work == Approx(mean).epsilon(0.005));
  }
  for (const RodState& state : result.states) {
    INFO("ebar " << state.ebar);
    CHECK(state.determinant == 3);
    CHECK(state.nodes.size() == 171);
    CHECK((state.nodes.back() - state.nodes.front()).norm() == Approx(42.17 - state.ebar));
    CHECK(smallest_distance(state.nodes, 3) > 0.98);
    CHECK(state.energy_by_effect.at("bend") > state.energy_by_effect.at("stretch"));
  }
  // The figure that later changes must keep, within the error of the discretisation.
  CHECK(tbar(result.states[0].tension) == Approx(0.02565).epsilon(0.01));
  CHECK(tbar(result.states[1].tension) == Approx(0.0534).epsilon(0.01));
  CHECK(tbar(result.states[2].tension) == Approx(0.0944).epsilon(0.015));
  // Above the law of the loose knot, pi^2/(2 ebar^2), which is its limit.
  CHECK(tbar(result.states[0].tension) > M_PI * M_PI / 800);
}

TEST_CASE("half the segments give the same tension") {
  // At ebar 30 the rod is bent up to its grips, whose segments must not count.
  double tension[2], loose[2];
  for (const int k : {0, 1}) {
    const RodResult result = run_rod(tight_overhand(k ? 340 : 170, {30, 28}));
    REQUIRE(result.outcome.status == PathStatus::finished);
    loose[k] = result.steps.front().tension;
    const RodResult tight = run_rod(tight_overhand(k ? 340 : 170, {24, 22}));
    REQUIRE(tight.outcome.status == PathStatus::finished);
    tension[k] = tight.steps.back().tension;
  }
  CHECK(loose[0] == Approx(loose[1]).epsilon(0.004));
  CHECK(tension[0] == Approx(tension[1]).epsilon(0.005));
}

TEST_CASE("tightening and loosening without friction retrace each other") {
  const RodResult result = run_rod(tight_overhand(170, {26, 24, 26}));
  INFO(result.outcome.reason);
  REQUIRE(result.outcome.status == PathStatus::finished);
  CHECK(result.steps.back().ebar == 26);
  CHECK(result.steps.back().tension == Approx(result.steps.front().tension).epsilon(2e-3));
}

TEST_CASE("a path that begins tighter than any loose knot is reached from a loose one") {
  const RodResult result = run_rod(tight_overhand(170, {20, 19.5}));
  REQUIRE(result.outcome.status == PathStatus::finished);
  CHECK(result.steps.front().ebar == 20);
  CHECK(tbar(result.steps.front().tension) == Approx(0.02565).epsilon(0.01));
}

TEST_CASE("one and two threads give the same curve") {
  std::vector<double> tension[2];
  for (const int k : {0, 1}) {
    omp_set_num_threads(k + 1);
    for (const StepRow& row : run_rod(tight_overhand(100, {27, 25})).steps)
      tension[k].push_back(row.tension);
  }
  omp_set_num_threads(omp_get_num_procs());
  REQUIRE(tension[0].size() == tension[1].size());
  for (size_t i = 0; i < tension[0].size(); ++i)
    CHECK(tension[0][i] == Approx(tension[1][i]).epsilon(1e-9));
}

TEST_CASE("a state of another knot type is no solution") {
  const RodParameters parameters = tight_overhand(60, {28, 26});
  RodModel model(parameters, overhand_start(parameters.length, 28, parameters.segments));
  CHECK(model.determinant() == 3);
  // A guess from which the rod relaxes without a knot: an arc between the grips.
  Vector guess = model.predict(28);
  const int last = parameters.segments;
  for (int i = 2; i + 1 < last; ++i) {
    const double u = static_cast<double>(i) / last;
    guess.segment<3>(3 * i) =
        Vector3(19.2 * std::sin(M_PI * u), 0.3 * std::sin(2 * M_PI * u), 14.17 * (u - 0.5));
  }
  const NewtonResult result = model.solve(guess, 28);
  CHECK_FALSE(result.ok());
  CHECK(result.reason == "a strand has passed through another");
}

TEST_CASE("a clamped finish turns writhe into twist, a free one does not") {
  RodParameters parameters = tight_overhand(170, {28, 16});
  parameters.path.record = {28, 16};
  parameters.twist = true;
  const RodResult free = run_rod(parameters);
  parameters.finish_turns = false;
  const RodResult clamped = run_rod(parameters);
  REQUIRE(free.outcome.status == PathStatus::finished);
  REQUIRE(clamped.outcome.status == PathStatus::finished);
  const auto turns = [](const RodState& state) { return state.twist_angle.back() / (2 * M_PI); };
  for (const RodState& state : free.states) CHECK(turns(state) == Approx(0).margin(1e-6));
  CHECK(turns(clamped.states[0]) == Approx(0).margin(1e-5));
  // Twist + writhe = link, of a rod whose tails go on along the axis.
  const auto change_of_writhe = [](const RodResult& result) {
    double value[2];
    for (const int k : {0, 1}) {
      Polyline line = result.states[k].nodes;
      const Vector3 step(0, 0, 0.25);
      for (int i = 0; i < 800; ++i) line.push_back(line.back() + step);
      std::reverse(line.begin(), line.end());
      for (int i = 0; i < 800; ++i) line.push_back(line.back() - step);
      value[k] = writhe(line);
    }
    return value[1] - value[0];
  };
  CHECK(std::abs(change_of_writhe(clamped)) > 0.05);
  CHECK(turns(clamped.states[1]) == Approx(-change_of_writhe(clamped)).epsilon(0.02));
  CHECK(free.steps.back().end_turn == Approx(2 * M_PI * change_of_writhe(free)).epsilon(0.02));
  CHECK(clamped.steps.back().end_turn == 0);
  CHECK(clamped.steps.back().energy > free.steps.back().energy);
}

TEST_CASE("turning the clamped finish of a knot takes the torque that its twist says") {
  RodParameters parameters = tight_overhand(170, {28});
  parameters.twist = true;
  parameters.finish_turns = false;
  double energy[3];
  for (const int k : {0, 1, 2}) {
    parameters.finish_turn = 1.0 + 0.1 * k;
    parameters.path.record = {28};
    const RodResult result = run_rod(parameters);
    REQUIRE(result.outcome.status == PathStatus::finished);
    energy[k] = result.steps.back().energy;
    CHECK(result.steps.back().end_turn == Approx(parameters.finish_turn));
    if (k != 1) continue;
    // An isotropic rod without friction carries a uniform twist.
    const std::vector<double>& rate = result.states[0].twist;
    for (size_t i = 1; i + 1 < rate.size(); ++i) CHECK(rate[i] == Approx(rate[1]).epsilon(1e-5));
    energy[k] = rate[1] * M_PI / 64 / 1.5;  // C times the twist per length
    CHECK(result.steps.back().end_torque == Approx(energy[k]).epsilon(1e-5));
    // Every piece of contact presses on two strands.
    double pieces = 0, nodes = 0;
    const RodState& state = result.states[0];
    for (const ContactSpot& at : state.contacts) {
      pieces += at.force;
      CHECK(at.s_b - at.s_a > 1.5);
    }
    for (size_t i = 1; i + 1 < state.s.size(); ++i)
      nodes += state.contact_force[i] * 0.5 * (state.s[i + 1] - state.s[i - 1]);
    CHECK(pieces > 0);
    CHECK(nodes == Approx(2 * pieces).epsilon(1e-6));
  }
  CHECK((energy[2] - energy[0]) / 0.2 == Approx(energy[1]).epsilon(0.002));
}

TEST_CASE("a knot hangs from its grips, which carry half its weight each") {
  RodParameters parameters = tight_overhand(120, {28, 26});
  parameters.gravity = Vector3(0, -9e-5, 0);
  parameters.path.record = {26};
  const RodResult heavy = run_rod(parameters);
  REQUIRE(heavy.outcome.status == PathStatus::finished);
  CHECK(heavy.effects == std::vector<std::string>{"stretch", "bend", "gravity", "contact"});
  parameters.gravity.setZero();
  const RodResult light = run_rod(parameters);
  // Nothing holds the knot along the rod: the ends pull alike, and more than without weight.
  CHECK(heavy.steps.back().reaction_mismatch < 1e-6);
  CHECK(heavy.steps.back().tension > 1.05 * light.steps.back().tension);
  const auto middle = [](const RodResult& result) {
    Vector3 sum = Vector3::Zero();
    for (const Vector3& node : result.states[0].nodes) sum += node;
    return Vector3(sum / static_cast<double>(result.states[0].nodes.size()));
  };
  CHECK(middle(heavy).y() < -0.5);
  CHECK(std::abs(middle(heavy).x()) < 1e-3);
}

TEST_CASE("a rod that is a helix when free is tied and pulled like a straight one") {
  RodParameters parameters = tight_overhand(120, {28, 26});
  parameters.twist = true;
  const RodResult straight = run_rod(parameters);
  parameters.natural_curvature = 0.1;
  parameters.natural_twist = 0.02;
  const RodResult curved = run_rod(parameters);
  REQUIRE(curved.outcome.status == PathStatus::finished);
  // The knot's loop is curved in the mean, so that less bending is left, and less tension.
  CHECK(curved.steps.back().energy < 0.7 * straight.steps.back().energy);
  CHECK(curved.steps.back().tension < 0.95 * straight.steps.back().tension);
  for (size_t i = 1; i < curved.steps.size(); ++i) {
    const StepRow &row = curved.steps[i], &before = curved.steps[i - 1];
    const double work = -(row.energy - before.energy) / (row.ebar - before.ebar);
    CHECK(work == Approx(0.5 * (row.tension + before.tension)).epsilon(0.005));
  }
  parameters.twist = false;
  CHECK_THROWS_WITH(run_rod(parameters), Catch::Contains("twist"));
}

TEST_CASE("what the rod cannot do is refused in words") {
  RodParameters parameters = tight_overhand(170, {30, 20});
  parameters.friction = 0.3;
  CHECK_THROWS_WITH(run_rod(parameters), Catch::Contains("twist"));
  parameters.friction = 0;
  parameters.finish_turns = false;
  CHECK_THROWS_WITH(run_rod(parameters), Catch::Contains("twist"));
  parameters.finish_turns = true;
  parameters.length = 20;
  CHECK_THROWS_WITH(run_rod(parameters), Catch::Contains("20 D"));
  parameters.length = 42.17;
  parameters.damping = 0.1;
  CHECK_THROWS_WITH(run_rod(parameters), Catch::Contains("inertia"));
  parameters.damping = 0;
  parameters.segments = 4;
  CHECK_THROWS_WITH(run_rod(parameters), Catch::Contains("segments"));
}
