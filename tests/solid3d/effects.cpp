#include "solid3d/effects.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "tests/derivatives.h"
#include "tests/solid3d/shapes.h"

using namespace bight;
using namespace bight::solid3d;
using test::helix_state;
using test::shaken;

namespace {

constexpr double touching_pitch = 0.99, radius = 2.0;

/// A rod of one turn and a bit, so that its ends lie side by side, and its effects.
struct Wound {
  Mesh mesh = test::straight_mesh(12, 2.12 * M_PI * radius, 1.0);
  int positions = 3 * mesh.nodes();
  int internal = 2 * static_cast<int>(mesh.cells.size());
  SolidEffects effects;

  Wound() {
    SolidParameters parameters;
    parameters.bulk_to_shear = 20;
    parameters.sample_spacing = 0.15;
    effects = make_effects(mesh, parameters, positions);
  }
  Vector state(double pitch) const { return helix_state(mesh, radius, pitch, internal); }
};

Vector3 sum_of_forces(const Vector& gradient, int positions) {
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < positions; i += 3) sum += gradient.segment<3>(i);
  return sum;
}

Vector3 sum_of_torques(const Vector& x, const Vector& gradient, int positions) {
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < positions; i += 3)
    sum += Vector3(x.segment<3>(i)).cross(Vector3(gradient.segment<3>(i)));
  return sum;
}

}  // namespace

TEST_CASE("derivatives of every solid effect converge with the square of the step") {
  Wound rod;
  const Vector rest = test::reference_state(rod.mesh, rod.internal);
  const Vector generic = shaken(rod.state(touching_pitch), rod.positions, 1e-3);
  // Small steps: the contact spline is C1, so its Hessian jumps where a projection changes patch.
  const test::OrderOfConvergence order{1e-4, 4, 3.0};
  for (const auto& effect : rod.effects.list) {
    CAPTURE(effect->name());
    test::check_derivatives(*effect, rest, rod.positions, order);
    test::check_derivatives(*effect, shaken(rest, rod.positions, 1e-8), rod.positions, order);
    test::check_derivatives(*effect, generic, rod.positions, order);
  }
}

TEST_CASE("contact begins just where the tubes touch") {
  Wound rod;
  rod.effects.contact->refresh(rod.state(1.02));
  CHECK(rod.effects.contact->stencils() == 0);
  rod.effects.contact->refresh(rod.state(0.985));
  CHECK(rod.effects.contact->stencils() > 0);
  // The spline of 8 sides is round to 0.3 % of D.
  CHECK(rod.effects.contact->max_penetration() == Approx(0.015).margin(0.005));
}

TEST_CASE("no effect feels a rigid motion, and its forces balance") {
  Wound rod;
  Vector x = shaken(rod.state(touching_pitch), rod.positions, 1e-3);
  const Matrix3 R = Eigen::AngleAxisd(0.7, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  Vector moved = x;
  for (int i = 0; i < rod.positions; i += 3)
    moved.segment<3>(i) = R * x.segment<3>(i) + Vector3(3, -2, 5);
  for (const auto& effect : rod.effects.list) {
    CAPTURE(effect->name());
    const Vector zero = Vector::Zero(x.size());
    const auto here = test::evaluate(*effect, x, zero);
    const auto there = test::evaluate(*effect, moved, zero);
    REQUIRE(here.energy > 0);
    CHECK(there.energy == Approx(here.energy).epsilon(1e-9));
    const double force = here.gradient.cwiseAbs().sum();
    CHECK(sum_of_forces(here.gradient, rod.positions).norm() < 1e-11 * force);
    CHECK(sum_of_torques(x, here.gradient, rod.positions).norm() < 1e-10 * force);
  }
}

TEST_CASE("a linear deformation strains every cell alike and keeps inner nodes in balance") {
  const Mesh mesh = test::straight_mesh(21, 1.0, 1.0);
  SolidParameters parameters;
  parameters.contact = false;
  SolidEffects effects = make_effects(mesh, parameters, 3 * mesh.nodes());
  CHECK(effects.list.size() == 1);
  Vector x = test::reference_state(mesh, 2 * static_cast<int>(mesh.cells.size()));
  Matrix3 F;
  F << 1.1, 0.2, 0.0, 0.0, 0.95, 0.1, 0.05, 0.0, 0.98;
  for (int n = 0; n < mesh.nodes(); ++n) x.segment<3>(3 * n) = F * mesh.reference(n);
  const auto all = test::evaluate(*effects.strain, x, Vector::Zero(x.size()));
  Vector settled = x;
  effects.strain->settle(settled);
  const Matrix3 stress = effects.strain->stress(settled, 0).cauchy;
  for (int cell = 1; cell < effects.strain->stencils(); ++cell)
    CHECK((effects.strain->stress(settled, cell).cauchy - stress).norm() < 1e-10 * stress.norm());
  std::vector<bool> on_rim(static_cast<size_t>(mesh.points_per_layer()), false);
  for (int p : mesh.section.rim) on_rim[p] = true;
  for (int k = 1; k + 1 < mesh.layers(); ++k)
    for (int p = 0; p < mesh.points_per_layer(); ++p)
      if (!on_rim[p])
        CHECK(all.gradient.segment<3>(3 * mesh.node(k, p)).norm() < 1e-10 * stress.norm());
}

TEST_CASE("an inverted cell is inadmissible") {
  const Mesh mesh = test::straight_mesh(12, 1.0, 1.0);
  SolidParameters parameters;
  parameters.contact = false;
  SolidEffects effects = make_effects(mesh, parameters, 3 * mesh.nodes());
  Vector x = test::reference_state(mesh, 2 * static_cast<int>(mesh.cells.size()));
  x[3 * mesh.node(1, 0) + 2] -= 3 * mesh.s[1];
  CHECK(test::evaluate(*effects.strain, x, Vector::Zero(x.size())).energy == inadmissible);
}
