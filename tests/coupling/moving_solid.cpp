// The solid with inertia: a knot that is pulled slowly in time goes through its equilibria.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "coupling/sweep.h"
#include "rod1d/run_rod.h"
#include "solid3d/checkpoint.h"
#include "solid3d/run_solid.h"

using namespace bight;
using namespace bight::coupling;

namespace {

constexpr double seed_ebar = 20;
constexpr double slow = 1.523e-5;  ///< the paper's 0.5 mm/s over the wave speed, 32.8 m/s

const rod1d::RodState& seed(double friction, double weight = 0) {
  static std::map<std::pair<double, double>, rod1d::RodState> seeds;
  if (!seeds.contains({friction, weight})) {
    rod1d::RodParameters parameters;
    parameters.length = 350 / 8.3;
    parameters.friction = friction;
    parameters.twist = friction > 0;
    parameters.gravity = {0, -weight, 0};
    parameters.path.waypoints = {28, seed_ebar};
    parameters.path.record = {seed_ebar};
    seeds[{friction, weight}] = rod1d::run_rod(parameters).states.at(0);
  }
  return seeds.at({friction, weight});
}

/// Along a path, through equilibria at speed zero.
solid3d::SolidParameters pulled(std::vector<double> waypoints, double speed, double friction) {
  solid3d::SolidParameters parameters;
  parameters.friction = friction;
  parameters.expected_tension = seed(friction).tension;
  parameters.path.waypoints = std::move(waypoints);
  parameters.path.max_step = 0.25;
  parameters.inertia = speed > 0;
  if (speed > 0) parameters.speed = speed, parameters.damping = 1e-3;  // 4/s
  parameters.time_tolerance = 1e-3;
  // The defaults of scenes with inertia.
  parameters.penetration = 0.01, parameters.contact_stiffness = 60;
  return parameters;
}

solid3d::SolidResult pull(const solid3d::SolidParameters& parameters, double axial_ratio,
                          const solid3d::SolidObserver& observer = {},
                          const solid3d::SolidCheckpoint* from = nullptr) {
  const rod1d::RodState& rod = seed(parameters.friction, -parameters.gravity.y());
  const solid3d::Mesh mesh = swept_mesh({.section_elements = 12, .axial_ratio = axial_ratio}, rod);
  return solid3d::run_solid(mesh, sweep(mesh, rod), seed_ebar, parameters, observer, from);
}

solid3d::SolidResult pull(std::vector<double> waypoints, double speed, double axial_ratio,
                          double friction = 0) {
  return pull(pulled(std::move(waypoints), speed, friction), axial_ratio);
}

/// Largest difference of the tension at equal ebar, over the tension.
double difference(const solid3d::SolidResult& a, const solid3d::SolidResult& b) {
  INFO(a.outcome.reason << b.outcome.reason);
  REQUIRE(a.outcome.status == PathStatus::finished);
  REQUIRE(a.steps.size() == b.steps.size());
  double largest = 0;
  for (size_t i = 0; i < a.steps.size(); ++i) {
    REQUIRE(a.steps[i].ebar == Approx(b.steps[i].ebar));
    largest = std::max(largest, std::abs(a.steps[i].tension / b.steps[i].tension - 1));
  }
  return largest;
}

}  // namespace

TEST_CASE("a solid knot pulled slowly in time follows its equilibria") {
  const solid3d::SolidResult timed = pull({20, 19.5}, slow, 1.6);
  CHECK(timed.effects == std::vector<std::string>{"strain", "contact", "inertia", "damping"});
  CHECK(timed.symmetric);
  const solid3d::SolidResult still = pull({20, 19.5}, 0, 1.6);
  CHECK(still.effects == std::vector<std::string>{"strain", "contact"});
  CHECK(difference(timed, still) < 3e-4);
  const StepRow& last = timed.steps.back();
  CHECK(last.time == Approx(0.5 / slow + 10 * 350 / 8.3));
  CHECK(last.energy == Approx(still.steps.back().energy).epsilon(1e-5));
  CHECK(last.kinetic > 0);
  CHECK(last.kinetic < 1e-6 * last.energy);
  CHECK(last.dissipated > 0);
  CHECK(last.reaction_mismatch < 1e-5);
  CHECK(last.end_turn == Approx(still.steps.back().end_turn).margin(1e-3));
}

namespace {

void goes_on_from_a_checkpoint(double friction) {
  solid3d::SolidParameters parameters = pulled({20, 19.96}, 10 * slow, friction);
  parameters.path.max_step = 0.01;
  parameters.checkpoint_every = 2;
  std::vector<solid3d::SolidCheckpoint> saved;
  solid3d::SolidObserver observer;
  observer.on_checkpoint = [&](const auto& at) { saved.push_back(at); };
  const solid3d::SolidResult whole = pull(parameters, 1.6, observer);
  REQUIRE(whole.outcome.status == PathStatus::finished);
  REQUIRE(saved.size() == 2);
  REQUIRE(saved[0].motion);
  CHECK(saved[0].motion->v.cwiseAbs().maxCoeff() > slow);
  CHECK(saved[0].motion->dissipated > 0);

  const solid3d::SolidResult rest = pull(parameters, 1.6, {}, &saved[0]);
  REQUIRE(rest.outcome.status == PathStatus::finished);
  const size_t before = whole.steps.size() - rest.steps.size();
  CHECK(before == 2);
  for (size_t i = 0; i < rest.steps.size(); ++i) {
    const StepRow &a = whole.steps[before + i], &b = rest.steps[i];
    CAPTURE(a.ebar);
    CHECK(a.time == b.time);
    CHECK(a.tension == b.tension);
    CHECK(a.energy == b.energy);
    CHECK(a.kinetic == b.kinetic);
    CHECK(a.dissipated == b.dissipated);
  }
  // Begun anew at a checkpoint, it moves as if it had gone on.
  parameters.checkpoint_every = 0;
  CHECK(difference(pull(parameters, 1.6), whole) < 1e-3);
}

}  // namespace

TEST_CASE("a solid in motion goes on from a checkpoint to the same numbers") {
  goes_on_from_a_checkpoint(0);
}

TEST_CASE("a solid in motion that rubs goes on from a checkpoint to the same numbers", "[.long]") {
  goes_on_from_a_checkpoint(0.32);
}

TEST_CASE("a slow pull of a solid knot in time agrees with equilibria", "[.long]") {
  const solid3d::SolidResult still = pull({20, 18}, 0, 0.8);
  const double paper = difference(pull({20, 18}, slow, 0.8), still);
  const double hundredfold = difference(pull({20, 18}, 100 * slow, 0.8), still);
  CHECK(paper < 1e-4);
  CHECK(hundredfold < 0.01);
  CHECK(hundredfold > 20 * paper);  // it swings
}

TEST_CASE("a slow pull in time of a solid knot with friction agrees with equilibria", "[.long]") {
  const solid3d::SolidResult still = pull({20, 19}, 0, 1, 0.32);
  const double rubbing = difference(pull({20, 19}, slow, 1, 0.32), still);
  CHECK(rubbing < 3e-3);
}

TEST_CASE("a slow pull in time of a solid knot under its weight agrees with equilibria",
          "[.long]") {
  // Of the paper's rod, across the pulling axis: no symmetry is left.
  const auto weighty = [](double speed) {
    solid3d::SolidParameters parameters = pulled({20, 19}, speed, 0);
    parameters.gravity = {0, -1160 * 9.81 * 8.3e-3 / 1.25e6, 0};
    return pull(parameters, 1);
  };
  const solid3d::SolidResult still = weighty(0), timed = weighty(slow);
  CHECK_FALSE(still.symmetric);
  CHECK(difference(timed, still) < 1e-3);
  CHECK(difference(still, pull({20, 19}, 0, 1)) > 1e-3);  // its weight counts
}
