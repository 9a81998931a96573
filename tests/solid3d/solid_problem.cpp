#include "solid3d/solid_problem.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/solid3d/touching_rods.h"

using namespace bight;
using namespace bight::solid3d;

namespace {

constexpr double length = 2.4;

std::vector<double> layers() { return graded_layers(length, 0.2, 0.2, 0, length); }

/// A strand along x below one along y, a little apart.
struct Crossed {
  explicit Crossed(SolidParameters parameters = {})
      : problem({{make_section(12), layers(), test::along_x(length, -0.5)},
                 {make_section(12), layers(), test::along_y(length, 0.51)}},
                with(std::move(parameters))) {
    for (const int layer : {0, last()}) {
      problem.hold(problem.section(0, layer));
      for (const int n : problem.section(1, layer)) grips.push_back(n);
    }
  }
  static SolidParameters with(SolidParameters parameters) {
    parameters.sample_spacing = 0.1;
    parameters.material.bulk_to_shear = 20;
    return parameters;
  }
  int last() const { return problem.strands()[0].layers() - 1; }
  std::vector<int> feet() const {
    std::vector<int> nodes = problem.section(0, 0);
    for (const int n : problem.section(0, last())) nodes.push_back(n);
    return nodes;
  }
  SolidProblem problem;
  std::vector<int> grips;  ///< both ends of the upper strand
};

}  // namespace

TEST_CASE("a strand whose ends move as one rigid body follows without strain") {
  SolidParameters parameters;
  parameters.contact = false;
  SolidProblem problem({{make_section(12), layers(), [](const Vector3& X) { return X; }}},
                       parameters);
  const RigidMotion motion{{0.1, -0.2, 0.3}, {0.4, 0.2, -0.3}, {1, 0, 0}};
  const int last = problem.strands()[0].layers() - 1;
  for (const int layer : {0, last}) problem.move(problem.section(0, layer), motion);
  const PathOutcome outcome = problem.go(2, 0.5);
  REQUIRE(outcome.status == PathStatus::finished);
  CHECK(outcome.steps == 5);
  CHECK(problem.energy() < 1e-10);
  for (const int n : problem.section(0, last / 2))
    CHECK((problem.position(n) - motion(problem.strands()[0].reference(n), 2)).norm() < 1e-6);
}

TEST_CASE("a rigid motion turns about its centre by the right hand, and shifts") {
  const RigidMotion motion{{0, 0, 1}, {0, 0, M_PI / 2}, {1, 0, 0}};
  CHECK((motion({2, 0, 0}, 1) - Vector3(1, 1, 1)).norm() < 1e-12);
  CHECK((motion({2, 0, 0}, 2) - Vector3(0, 0, 2)).norm() < 1e-12);
}

TEST_CASE("an end that was moved stays when it is held, and comes back when it is released") {
  SolidParameters parameters;
  parameters.contact = false;
  SolidProblem problem({{make_section(12), layers(), [](const Vector3& X) { return X; }}},
                       parameters);
  const auto head = problem.section(0, problem.strands()[0].layers() - 1);
  problem.hold(problem.section(0, 0));
  problem.move(head, RigidMotion{.shift = {0.3, 0, 0}});
  REQUIRE(problem.go(1, 0.5).status == PathStatus::finished);
  const double energy = problem.energy();
  CHECK(energy > 1e-4);
  problem.release(head);
  problem.hold(head);
  REQUIRE(problem.go(1.5, 1).status == PathStatus::finished);
  CHECK(problem.energy() == Approx(energy).epsilon(1e-6));
  problem.release(head);
  REQUIRE(problem.go(2, 1).status == PathStatus::finished);
  CHECK(problem.energy() < 1e-10);
}

TEST_CASE("a pulled strand is held by what pulls it, and stretches as its material says") {
  SolidParameters parameters;
  parameters.contact = false;
  SolidProblem problem({{make_section(32), layers(), [](const Vector3& X) { return X; }}},
                       parameters);
  const int last = problem.strands()[0].layers() - 1;
  const auto foot = problem.section(0, 0), head = problem.section(0, last);
  problem.hold(foot, 2);
  for (const int axis : {0, 1}) problem.hold({problem.strands()[0].node(0, 12)}, axis);
  problem.hold({problem.strands()[0].node(0, problem.strands()[0].section.rim[0])}, 1);
  const double area = problem.strands()[0].section.area();

  // Uniaxial: nominal stress mu (l - 1/l^2), mu = 1/3.
  problem.load(head, {0, 0, 1e-3});
  REQUIRE(problem.go(1, 1).status == PathStatus::finished);
  CHECK(problem.reaction(foot).z() == Approx(-1e-3).epsilon(1e-6));
  double stretch = 0;
  for (const int n : head) stretch += problem.position(n).z() / length / head.size();
  CHECK(stretch - 1 == Approx(1e-3 / area).epsilon(0.02));
  // Instead of it, none.
  problem.load(head, Vector3::Zero());
  REQUIRE(problem.go(2, 1).status == PathStatus::finished);
  CHECK(std::abs(problem.reaction(foot).z()) < 1e-8);
}

TEST_CASE("strands pushed together carry what pushes them, over the surface where they touch") {
  Crossed crossed;
  crossed.problem.move(crossed.grips, RigidMotion{.shift = {0, 0, -1}});
  REQUIRE(crossed.problem.go(0.1, 0.05).status == PathStatus::finished);
  const Vector3 push = crossed.problem.reaction(crossed.grips);
  CHECK(push.z() < -1e-3);
  CHECK((push + crossed.problem.reaction(crossed.feet())).norm() < 1e-6 * push.norm());
  Vector3 carried = Vector3::Zero();
  for (const auto& touch : crossed.problem.touches()) {
    CHECK(touch.pressure > 0);
    CHECK((touch.strand == 0 ? touch.normal.z() > 0 : touch.normal.z() < 0));
    if (touch.strand == 1) carried -= touch.pressure * touch.area * touch.normal;
  }
  // Each surface is sampled for itself, and carries half.
  CHECK(carried.z() == Approx(-push.z()).epsilon(0.1));
}

TEST_CASE("apart again, strands are free of each other") {
  Crossed crossed;
  crossed.problem.move(crossed.grips, RigidMotion{.shift = {0, 0, -1}});
  REQUIRE(crossed.problem.go(0.05, 0.05).status == PathStatus::finished);
  CHECK(crossed.problem.energy() > 1e-6);
  REQUIRE(crossed.problem.go(-0.01, 0.03).status == PathStatus::finished);
  CHECK(crossed.problem.energy() < 1e-12);
  CHECK(crossed.problem.touches().empty());
}

TEST_CASE("work of the moves is stored or dissipated") {
  SolidParameters parameters;
  parameters.friction = 0.3;
  Crossed crossed(parameters);
  SolidProblem& problem = crossed.problem;
  double work = 0, dissipated = 0, energy = 0;
  const auto walk = [&](const Vector3& shift, int steps, double distance) {
    problem.move(crossed.grips, RigidMotion{.shift = shift});
    for (int i = 0; i < steps; ++i) {
      Vector3 before = Vector3::Zero();
      if (energy > 0) before = problem.reaction(crossed.grips);
      const PathOutcome outcome =
          problem.go(problem.time() + distance / steps, 1,
                     [&](const StepRow& row) { energy = row.energy, dissipated = row.dissipated; });
      REQUIRE(outcome.status == PathStatus::finished);
      work += 0.5 * (before + problem.reaction(crossed.grips)).dot(shift) * distance / steps;
    }
  };
  walk({0, 0, -1}, 8, 0.09);
  walk({0, 1, 0}, 12, 0.12);
  const Vector3 push = problem.reaction(crossed.grips);
  CHECK(push.y() == Approx(0.3 * std::abs(push.z())).epsilon(0.15));
  CHECK(dissipated > 0.1 * energy);
  CHECK(work == Approx(energy + dissipated).epsilon(0.03));
}
