// Solids that begin with the friction of a rod or of another solid.
#include <catch2/catch.hpp>

#include "solid3d/transfer.h"
#include "tests/coupling/tight_knot.h"

using namespace bight;
using namespace bight::coupling;
using namespace bight::test;

namespace {

constexpr double friction = 0.32;

struct Tightened {
  solid3d::Mesh mesh;
  solid3d::SolidResult result;
  solid3d::SolidState last;

  double tension() const { return result.steps.back().tension; }
};

/// From a start through the waypoints.
Tightened tightened(const solid3d::Mesh& mesh, const std::vector<Vector3>& start, double tension,
                    std::vector<Rub> rubs, const std::vector<double>& waypoints) {
  Tightened out{mesh, {}, {}};
  solid3d::SolidParameters parameters;
  parameters.friction = friction;
  // In stiffer contact, a fine section's T from a coarse one's friction is less exact: 0.13 % off
  // at an overlap of 0.2 % D, where it is 0.08 % here.
  parameters.penetration = 0.01;
  parameters.expected_tension = tension;
  parameters.rubs = std::move(rubs);
  parameters.path.waypoints = waypoints;
  parameters.path.record = {waypoints.back()};
  solid3d::SolidObserver observer;
  observer.on_record = [&](const auto& state) { out.last = state; };
  out.result = solid3d::run_solid(mesh, start, waypoints.front(), parameters, observer);
  REQUIRE(out.result.outcome.status == PathStatus::finished);
  return out;
}

solid3d::Mesh mesh_of(const rod1d::RodState& rod, int cells, double axial_ratio = 1.0) {
  return swept_mesh({.section_elements = cells, .axial_ratio = axial_ratio}, rod);
}

Tightened from_rod(const rod1d::RodState& rod, int cells, const std::vector<double>& waypoints,
                   double axial_ratio = 1.0) {
  const solid3d::Mesh mesh = mesh_of(rod, cells, axial_ratio);
  return tightened(mesh, sweep(mesh, rod), rod.tension, rod.rubs, waypoints);
}

/// The rod at ebar 20 and 18 of its path, rubbing.
const std::vector<rod1d::RodState>& rods() {
  static const std::vector<rod1d::RodState> states = [] {
    rod1d::RodParameters parameters;
    parameters.length = length;
    parameters.friction = friction;
    parameters.twist = true;
    parameters.path.waypoints = {28, 18};
    parameters.path.record = {20, 18};
    return rod1d::run_rod(parameters).states;
  }();
  return states;
}

}  // namespace

TEST_CASE("a rod tells how it rubs: along its skin, by no more than what sticks") {
  REQUIRE(rods().size() == 2);
  const rod1d::RodState& rod = rods()[1];
  REQUIRE(rod.rubs.size() > 20);
  double sliding = 0;
  for (const Rub& rub : rod.rubs) {
    CHECK(std::abs(rub.s_a - rub.s_b) > 1);
    CHECK(rub.elastic_slip.norm() <= largest_elastic_slip * (1 + 1e-9));
    sliding += rub.elastic_slip.norm() > 0.999 * largest_elastic_slip;
  }
  // While a knot is tightened nearly all of it slides.
  CHECK(sliding > 0.8 * static_cast<double>(rod.rubs.size()));
}

TEST_CASE("a solid that begins with its rod's friction is where a path would have led it") {
  const double path = from_rod(rods()[0], 12, {20, 18}).tension();
  const rod1d::RodState& rod = rods()[1];
  CHECK(from_rod(rod, 12, {18}).tension() == Approx(path).epsilon(0.005));
  // What its relaxation alone rubs is another friction.
  rod1d::RodState forgetful = rod;
  forgetful.rubs.clear();
  CHECK(from_rod(forgetful, 12, {18}).tension() < 0.97 * path);
}

TEST_CASE("with friction, too, a finer mesh finds a coarse one's state as by a path of its own") {
  const Tightened coarse = from_rod(rods()[0], 12, {20, 18});
  const solid3d::Mesh fine = mesh_of(rods()[1], 21);
  const Tightened found =
      tightened(fine, solid3d::transferred(coarse.mesh, coarse.last.nodes, fine), coarse.tension(),
                coarse.last.rubs, {18});
  CHECK(found.result.symmetric);
  CHECK(found.result.outcome.iterations <= 20);
  CHECK(found.result.steps[0].residual < 1e-4);
  CHECK(found.result.steps[0].dissipated == 0);
  const double path = from_rod(rods()[0], 21, {20, 18}).tension();
  CHECK(std::abs(coarse.tension() - path) > 0.005 * path);
  CHECK(found.tension() == Approx(path).epsilon(0.001));
}

TEST_CASE(
    "a figure-eight that is unstable while nothing sticks begins with its rod's friction too") {
  rod1d::RodParameters parameters;
  parameters.length = length;
  parameters.knot = "figure-eight";
  parameters.from_straight = true;
  parameters.friction = friction;
  parameters.twist = true;
  parameters.path.waypoints = {28, 24};
  parameters.path.record = {26, 24};
  const auto states = rod1d::run_rod(parameters).states;
  // Short cells: strands catch at long ones, and T of a path ripples by 2 %.
  const Tightened begun = from_rod(states.at(1), 12, {24}, 0.5);
  CHECK(begun.result.symmetric);
  const double path = from_rod(states.at(0), 12, {26, 24}, 0.5).tension();
  CHECK(begun.tension() == Approx(path).epsilon(0.02));
  CHECK(begun.result.steps[0].dissipated < 1e-3 * begun.result.steps[0].energy);
  CHECK(begun.result.outcome.iterations < 100);
}
