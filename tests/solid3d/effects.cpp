#include "solid3d/effects.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <limits>

#include "solid3d/elements.h"
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
  Mesh mesh;
  int positions = 3 * mesh.nodes();
  SolidEffects effects;

  explicit Wound(const HexElement& element = hex_elements()[0])
      : mesh(test::straight_mesh(element.degree == 1 ? 12 : 5, 2.12 * M_PI * radius, element.degree,
                                 element.degree)) {
    SolidParameters parameters;
    parameters.element = element.name;
    parameters.material.bulk_to_shear = 20;
    parameters.sample_spacing = 0.15;
    effects = make_effects(mesh, parameters, positions);
  }
  int internal() const { return effects.strain->internals(); }
  Vector state(double pitch) const { return helix_state(mesh, radius, pitch, internal()); }
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
  Wound rod(GENERATE(from_range(hex_elements())));
  const Vector rest = test::reference_state(rod.mesh, rod.internal());
  const Vector generic = shaken(rod.state(touching_pitch), rod.positions, 1e-3);
  // Small steps: the contact spline is C1, so its Hessian jumps where a projection changes patch.
  const test::OrderOfConvergence order{1e-4, 4, 3.0};
  for (const auto& effect : rod.effects.list) {
    CAPTURE(effect->name());
    REQUIRE(test::evaluate(*effect, generic, Vector::Zero(generic.size())).energy > 0);
    test::check_derivatives(*effect, rest, rod.positions, order);
    test::check_derivatives(*effect, shaken(rest, rod.positions, 1e-8), rod.positions, order);
    test::check_derivatives(*effect, generic, rod.positions, order);
    // Coming from afar, pairs are found anew.
    CHECK(test::evaluate(*effect, generic, Vector::Zero(generic.size())).energy > 0);
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

TEST_CASE("contact is sampled on the whole surface of both strands, half each") {
  Wound rod;
  rod.effects.contact->refresh(rod.state(0.985));
  const ContactSurface& surface = rod.effects.contact->surface();
  std::vector<double> sampled(static_cast<size_t>(surface.patches()), 0.0);
  for (const auto& sample : rod.effects.contact->samples()) sampled[sample.patch] += sample.weight;
  int patches = 0;
  for (int patch = 0; patch < surface.patches(); ++patch) {
    if (sampled[patch] == 0) continue;
    ++patches;
    CHECK(2 * sampled[patch] == Approx(surface.area(patch)));
  }
  CHECK(patches > 20);
}

/// A little more than a turn whose strands, 0.06 D apart, have both gone half of `closed` [D]
/// towards each other, so that no new search is due.
Vector closed_by(const Wound& rod, double closed) {
  Vector x = rod.state(1.06);
  for (int n = 0; n < rod.mesh.nodes(); ++n)
    x[3 * n + 2] += (rod.mesh.reference(n).z() < 0.5 * rod.mesh.s.back() ? 0.5 : -0.5) * closed;
  return x;
}

TEST_CASE("samples that were left out as too far touch as soon as any") {
  Wound rod;
  bool touched = false;
  for (double closed = 0; closed < 0.09; closed += 0.01) {
    const Vector x = closed_by(rod, closed);
    rod.effects.contact->refresh(x);
    Wound fresh;
    fresh.effects.contact->refresh(x);
    CHECK(rod.effects.contact->stencils() == fresh.effects.contact->stencils());
    CHECK(rod.effects.contact->max_penetration() ==
          Approx(fresh.effects.contact->max_penetration()).margin(1e-9));
    touched = touched || fresh.effects.contact->stencils() > 0;
  }
  CHECK(touched);
}

TEST_CASE("contact finds itself again after a state that is nowhere") {
  Wound rod;
  Vector nowhere = closed_by(rod, 0);
  const ContactSurface& surface = rod.effects.contact->surface();
  nowhere[surface.coordinate(0, surface.layers() / 2)] = std::numeric_limits<double>::infinity();
  for (const Vector& x : {closed_by(rod, 0), nowhere, closed_by(rod, 0), closed_by(rod, 0.09)})
    rod.effects.contact->refresh(x);
  CHECK(rod.effects.contact->stencils() > 0);
}

TEST_CASE("the far side of a strand is no overlap") {
  const Mesh mesh = test::straight_mesh(12, 6.0, 1.0);
  SolidEffects effects = make_effects(mesh, {}, 3 * mesh.nodes());
  // The rod broken in two halves, side by side, one within the other by 0.1 and by 0.4 D.
  const int half = mesh.layers() / 2;
  for (const double overlap : {0.1, 0.4}) {
    Vector x = test::reference_state(mesh, 0);
    for (int n = mesh.node(half, 0); n < mesh.nodes(); ++n)
      x.segment<3>(3 * n) += Vector3(1 - overlap, 0, -mesh.s[half]);
    effects.contact->refresh(x);
    const auto off_the_break = [&](double along) { return std::abs(along - half) > 2; };
    double least = 1;
    for (const auto& sample : effects.contact->samples())
      if (sample.faces && off_the_break(effects.contact->surface().along(sample.patch)) &&
          off_the_break(sample.facing.y()))
        least = std::min(least, sample.gap);
    CHECK(least >= -0.25);
    if (overlap < 0.25) CHECK(least == Approx(-overlap).margin(0.01));
  }
}

TEST_CASE("a step may close the gap and overlap a little, no more") {
  Wound rod;
  const Vector x = rod.state(1.06);
  rod.effects.contact->refresh(x);
  Vector dx = Vector::Zero(x.size());
  for (int n = 0; n < rod.mesh.nodes(); ++n)
    dx[3 * n + 2] = rod.mesh.reference(n).z() < 0.5 * rod.mesh.s.back() ? 0.15 : -0.15;
  CHECK(0.3 * rod.effects.contact->longest_step(x, dx) == Approx(0.06 + 0.08).margin(0.01));
  CHECK(rod.effects.contact->longest_step(x, -dx) == 1);
  CHECK(rod.effects.contact->longest_step(x, 0.1 * dx) == 1);
}

TEST_CASE("no effect feels a rigid motion, and its forces balance") {
  Wound rod(GENERATE(from_range(hex_elements())));
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
  // mu J^(-5/3) dev(F F^T) + K (J - 1) 1
  const double mu = parameters.material.shear_modulus();
  const double J = F.determinant(), bulk_modulus = parameters.material.bulk_modulus();
  const Matrix3 B = F * F.transpose(), I = Matrix3::Identity();
  const Matrix3 exact =
      mu * std::pow(J, -5.0 / 3) * (B - B.trace() / 3 * I) + bulk_modulus * (J - 1) * I;
  CHECK((stress - exact).norm() < 1e-9 * exact.norm());
  CHECK(effects.strain->stress(settled, 0).jacobian == Approx(J));
  CHECK(effects.strain->stress(settled, 0).least_jacobian == Approx(std::min(J, 1.0)));
  for (int cell = 1; cell < effects.strain->stencils(); ++cell)
    CHECK((effects.strain->stress(settled, cell).cauchy - stress).norm() < 1e-10 * stress.norm());
  std::vector<bool> on_rim(static_cast<size_t>(mesh.points_per_layer()), false);
  for (int p : mesh.section.rim) on_rim[p] = true;
  for (int k = 1; k + 1 < mesh.layers(); ++k)
    for (int p = 0; p < mesh.points_per_layer(); ++p)
      if (!on_rim[p])
        CHECK(all.gradient.segment<3>(3 * mesh.node(k, p)).norm() < 1e-10 * stress.norm());
}

TEST_CASE("Young's modulus is 1 at any ratio of bulk and shear modulus") {
  for (const double ratio : {1.0, 20.0, 1000.0}) {
    const MaterialParameters material{.bulk_to_shear = ratio};
    const double mu = material.shear_modulus(), bulk = material.bulk_modulus();
    CHECK(9 * bulk * mu / (3 * bulk + mu) == Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("dilatation and pressure: recovered by the linear part of settling, work as stated") {
  const HexElement element = GENERATE(from_range(hex_elements()));
  const Mesh mesh = test::straight_mesh(12, 1.0, 1.0, element.degree);
  const int positions = 3 * mesh.nodes(), cells = static_cast<int>(mesh.cells.size());
  SolidParameters parameters;
  parameters.element = element.name;
  parameters.material.bulk_to_shear = 20;
  SolidEffects effects = make_effects(mesh, parameters, positions);
  Strain& strain = *effects.strain;
  const int per_cell = internals_per_cell(element.degree);
  const Vector away =
      shaken(test::reference_state(mesh, strain.internals()), positions, 1e-2 / element.degree);
  Vector x = away;
  strain.settle(x);

  // From anywhere, without motion: to the settled state. From there: along with the motion.
  Vector dx = Vector::Zero(x.size());
  strain.recover(away, dx);
  CHECK((away + dx - x).norm() < 1e-13);
  const Vector v = shaken(Vector::Zero(x.size()), positions, 1.0);
  dx = v;
  strain.recover(x, dx);
  constexpr double h = 1e-5;
  Vector up = x + h * v, down = x - h * v;
  strain.settle(up);
  strain.settle(down);
  CHECK(((up - down) / (2 * h) - dx).norm() < 1e-7 * dx.norm());

  // dPi/dp = v - V theta; a miss of V t costs U'' = K and the quadratic term mu.
  const auto energy = [&](const Vector& at) {
    double sum = 0;
    for (int i = 0; i < strain.stencils(); ++i) {
      ElementSlot slot{};
      strain.element(at, i, Order::energy, slot);
      sum += slot.energy;
    }
    return sum;
  };
  const double mu = MaterialParameters{.bulk_to_shear = 20}.shear_modulus(), t = 0.01;
  Vector off = x, pressed = x;
  for (int cell = 0; cell < cells; ++cell) {
    off[positions + per_cell * cell] += t;
    pressed[positions + per_cell * cell] += t;
    pressed[positions + per_cell * cell + per_cell / 2] += 1;
  }
  const double volume = mesh.section.area() * mesh.s.back();
  CHECK(energy(pressed) - energy(off) == Approx(-volume * t));
  CHECK(energy(off) - energy(x) == Approx(0.5 * volume * t * t * (20 * mu + mu)));
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
