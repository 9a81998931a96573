#include "solid3d/measure.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/derivatives.h"
#include "tests/solid3d/shapes.h"

using namespace bight;
using namespace bight::solid3d;

TEST_CASE("the curvature of a parabola is exact on unequal spacing") {
  const std::vector<double> s = {0, 0.1, 0.25, 0.3, 0.6, 1};
  Polyline line;
  for (double at : s) line.push_back({0.15 * at * at, 0, at});
  const std::vector<double> kappa = curvature(line, s);
  for (size_t i = 1; i + 1 < s.size(); ++i)
    CHECK(kappa[i] == Approx(0.3 / (1 + 0.09 * s[i] * s[i])));
}

TEST_CASE("stretch is no curvature, and does not change that of an arc by undeformed length") {
  std::vector<double> s;
  Polyline straight, arc;
  for (int i = 0; i <= 40; ++i) {
    s.push_back(0.05 * i);
    straight.push_back({0, 0, s[i] + 0.1 * s[i] * s[i]});
    const double angle = 0.8 * s[i], radius = 1.2 / 0.8;  // stretched by 1.2
    arc.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  for (const double kappa : curvature(straight, s)) CHECK(kappa == Approx(0).margin(1e-12));
  for (const double kappa : curvature(arc, s)) CHECK(kappa == Approx(0.8).epsilon(1e-3));
}

TEST_CASE("the centerline is the mean of the centre points, whatever the others do") {
  const Mesh mesh = test::straight_mesh(21, 2.0, 1.0);
  Vector x = test::reference_state(mesh, 0);
  for (int p : mesh.section.rim) x[3 * mesh.node(1, p)] += 0.1;
  for (int p : mesh.section.centre) x[3 * mesh.node(2, p)] += 0.2;
  const Polyline line = centerline(mesh, x);
  for (int k = 0; k < mesh.layers(); ++k)
    CHECK((line[k] - Vector3(k == 2 ? 0.2 : 0, 0, mesh.s[k])).norm() < 1e-14);
}

TEST_CASE("a round section is not flat, one pressed to 0.9 D is by 0.1") {
  const int cells = GENERATE(12, 32);
  const Mesh mesh = test::straight_mesh(cells, 1.0, 1.0);
  // Pressed along a direction of the section, and turned in space.
  const Matrix3 R = Eigen::AngleAxisd(0.7, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  for (const double pressed : {0.0, 0.1})
    for (const double angle : {0.0, 0.4, 1.2}) {
      const Vector3 d(std::cos(angle), std::sin(angle), 0);
      Vector x = test::reference_state(mesh, 0);
      for (int n = 0; n < mesh.nodes(); ++n) {
        const Vector3 X = mesh.reference(n);
        x.segment<3>(3 * n) = R * (X - pressed * d * d.dot(X));
      }
      for (double flat : flattening(mesh, x)) CHECK(flat == Approx(pressed).margin(0.003));
    }
}

TEST_CASE("fields of a rod under a known strain, with its turns pressed on each other") {
  const Mesh mesh = test::straight_mesh(12, 2.12 * M_PI * 2, 1.0);
  const int positions = 3 * mesh.nodes(), cells = static_cast<int>(mesh.cells.size());
  SolidParameters parameters;
  parameters.material.bulk_to_shear = 20;
  SolidEffects effects = make_effects(mesh, parameters, positions);

  // F = diag(1.1, 1.1, 0.8)
  Vector x = test::reference_state(mesh, 2 * cells);
  for (int n = 0; n < mesh.nodes(); ++n)
    x.segment<3>(3 * n).array() *= Eigen::Array3d(1.1, 1.1, 0.8);
  effects.strain->settle(x);
  effects.contact->refresh(x);
  const SolidState strained = fields(mesh, effects, x);
  const double mu = MaterialParameters{.bulk_to_shear = 20}.shear_modulus(), J = 1.1 * 1.1 * 0.8;
  for (int cell = 0; cell < cells; ++cell) {
    CHECK(strained.jacobian[cell] == Approx(J));
    CHECK(strained.pressure[cell] == Approx(20 * mu * (J - 1)));
    CHECK(strained.von_mises[cell] == Approx(mu * std::pow(J, -5.0 / 3) * (1.1 * 1.1 - 0.8 * 0.8)));
  }
  CHECK(strained.min_jacobian == Approx(J));
  CHECK(strained.determinant == 1);
  for (double pressure : strained.contact_pressure) CHECK(pressure == 0);

  x = test::helix_state(mesh, 2.0, 0.985, 2 * cells);
  effects.contact->refresh(x);
  const SolidState touching = fields(mesh, effects, x);
  const double overlap = effects.contact->max_penetration();
  CHECK(*std::min_element(touching.gap.begin(), touching.gap.end()) == -overlap);
  // A node shows the mean of its patch, of which a part touches.
  const auto& pressure = touching.contact_pressure;
  const double largest = *std::max_element(pressure.begin(), pressure.end());
  CHECK(largest < parameters.contact_stiffness * overlap);
  CHECK(largest > 0.3 * parameters.contact_stiffness * overlap);
  CHECK(*std::min_element(pressure.begin(), pressure.end()) == 0);
}

namespace {

SolidEffects strain_alone(const Mesh& mesh) {
  SolidParameters parameters;
  parameters.element = mesh.degree() == 1 ? "three-field" : "quadratic";
  parameters.contact = false;
  return make_effects(mesh, parameters, 3 * mesh.nodes());
}

double energy(const SolidEffects& effects, Vector x) {
  const Unknowns unknowns({}, 0, std::vector<bool>(static_cast<size_t>(x.size()), true));
  effects.strain->settle(x);
  Assembler assembler(unknowns, effects.list);
  return assembler.energy(x);
}

}  // namespace

TEST_CASE("moment and force of the first section are what turning and moving it stores") {
  const int degree = GENERATE(1, 2);
  const Mesh mesh = test::straight_mesh(degree == 1 ? 12 : 5, 1.0, 1.0, degree);
  const SolidEffects effects = strain_alone(mesh);
  const int internal = effects.strain->internals();
  Vector x = test::shaken(test::reference_state(mesh, internal), 3 * mesh.nodes(), 0.01);
  effects.strain->settle(x);
  const SectionLoads loads = section_loads(mesh, effects, x);
  const Polyline line = centerline(mesh, x);
  const Vector3 t = (line[1] - line[0]).normalized();
  const auto changed = [&](double turn, double shift) {
    Vector y = x;
    const Matrix3 R = Eigen::AngleAxisd(turn, t).toRotationMatrix();
    for (int n = 0; n < mesh.points_per_layer(); ++n)
      y.segment<3>(3 * n) = line[0] + R * (x.segment<3>(3 * n) - line[0]) + shift * t;
    return energy(effects, y);
  };
  constexpr double h = 1e-5;
  CHECK(loads.twisting[0] == Approx(-(changed(h, 0) - changed(-h, 0)) / (2 * h)).epsilon(1e-5));
  CHECK(loads.axial[0] == Approx(-(changed(0, h) - changed(0, -h)) / (2 * h)).epsilon(1e-5));
}

TEST_CASE("sections of a twisted rod carry G J times the twist, right-handed") {
  const int degree = GENERATE(1, 2);
  const Mesh mesh = test::straight_mesh(degree == 1 ? 60 : 5, 3.0, 1.0, degree);
  const SolidEffects effects = strain_alone(mesh);
  Vector x = test::reference_state(mesh, effects.strain->internals());
  constexpr double rate = 0.05, shear_modulus = 1.0 / 3;
  for (int n = 0; n < mesh.nodes(); ++n)
    x.segment<3>(3 * n) =
        Eigen::AngleAxisd(rate * x[3 * n + 2], Vector3::UnitZ()) * mesh.reference(n);
  effects.strain->settle(x);
  const SectionLoads loads = section_loads(mesh, effects, x);
  for (const double torque : loads.twisting)
    CHECK(torque == Approx(shear_modulus * M_PI / 32 * rate).epsilon(0.01));
  for (const double moment : loads.bending) CHECK(moment < 1e-10);
}
