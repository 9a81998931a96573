#include <Eigen/Geometry>
#include <stdexcept>

#include "solid3d/material.h"
#include "tests/derivatives.h"

using namespace bight;
using namespace bight::solid3d;

namespace {

/// Every material of the list, with shape parameters that leave nothing out.
std::vector<Material> all_materials() {
  std::vector<Material> all;
  for (const std::string_view name : material_names()) {
    MaterialParameters p;
    p.model = name;
    p.bulk_to_shear = 5;
    p.c01_share = 0.3;
    p.ogden = {{0.7, 1.3}, {0.2, 5.0}, {0.1, -2.0}};
    all.push_back(make_material(p));
  }
  return all;
}

template <class Call>
auto ask(const Material& material, Call&& call) {
  return std::visit(std::forward<Call>(call), material);
}
std::string name(const Material& material) {
  return ask(material, [](const auto& m) { return std::string(m.name); });
}
double energy(const Material& material, const Matrix3& F) {
  return ask(material, [&](const auto& m) { return m.energy(F, F.determinant()); });
}
Matrix3 stress(const Material& material, const Matrix3& F) {
  const Matrix3 G = F.inverse().transpose();
  return ask(material, [&](const auto& m) -> Matrix3 { return m.stress(F, G, F.determinant()); });
}
Matrix3 stress_rate(const Material& material, const Matrix3& F, const Matrix3& dF) {
  const Matrix3 G = F.inverse().transpose();
  const Matrix9 A =
      ask(material, [&](const auto& m) -> Matrix9 { return m.tangent(F, G, F.determinant()); });
  return (A * dF.reshaped()).reshaped(3, 3);
}

const Matrix3 I = Matrix3::Identity();
const Matrix3 generic = (Matrix3() << 1.2, 0.3, -0.1, 0.2, 0.8, 0.4, -0.3, 0.1, 1.1).finished();
const Matrix3 turned = Eigen::AngleAxisd(0.8, Vector3(1, -2, 3).normalized()).toRotationMatrix();

}  // namespace

TEST_CASE("stress and tangent of every material are derivatives, at equal stretches too") {
  const std::vector<std::pair<std::string, Matrix3>> states = {
      {"rest", I},
      {"almost rest", I + 1e-8 * generic},
      {"turned", turned},
      {"two stretches equal", turned * Vector3(1.3, 0.8, 0.8).asDiagonal()},
      {"nearly equal", turned * Vector3(1.3, 0.8, 0.8 + 1e-9).asDiagonal() * turned},
      {"all equal", 1.4 * turned},
      {"generic", generic}};
  const Matrix3 dF = (Matrix3() << 0.5, -1, 0.2, 0.7, 0.1, 0.9, -0.4, 0.3, -0.6).finished();
  for (const Material& material : all_materials())
    for (const auto& [what, F] : states) {
      INFO(name(material) << ", " << what);
      const test::OrderOfConvergence order{0.02, 6, 3.5};
      order.check(
          "stress",
          [&, &F = F](double h) {
            const double rate =
                (energy(material, F + h * dF) - energy(material, F - h * dF)) / (2 * h);
            return std::abs(rate - stress(material, F).cwiseProduct(dF).sum());
          },
          [](double h) { return 1e-14 / h; });
      order.check(
          "tangent",
          [&, &F = F](double h) {
            const Matrix3 rate =
                (stress(material, F + h * dF) - stress(material, F - h * dF)) / (2 * h);
            return (rate - stress_rate(material, F, dF)).norm();
          },
          [](double h) { return 1e-14 / h; });
      const double t = 1e-3, theta_1 = F.determinant() - 1;
      order.check(
          "volumetric slope",
          [&](double h) {
            const double rate = (volumetric(material, theta_1 + h).energy -
                                 volumetric(material, theta_1 - h).energy) /
                                (2 * h);
            return std::abs(rate - volumetric(material, theta_1).slope);
          },
          [](double h) { return 1e-14 / h; });
      order.check(
          "volumetric curvature",
          [&](double h) {
            const double rate = (volumetric(material, theta_1 + t + h).slope -
                                 volumetric(material, theta_1 + t - h).slope) /
                                (2 * h);
            return std::abs(rate - volumetric(material, theta_1 + t).curvature);
          },
          [](double h) { return 1e-14 / h; });
    }
}

TEST_CASE("every material is at rest at rest, with Young's modulus 1 and its ratio of moduli") {
  const MaterialParameters p{.bulk_to_shear = 5};
  for (const Material& material : all_materials()) {
    CAPTURE(name(material));
    CHECK(std::abs(energy(material, I)) < 1e-15);
    CHECK(stress(material, I).norm() < 1e-15);
    CHECK(volumetric(material, 0).slope == 0);
    const double mu = ask(material, [](const auto& m) { return m.shear_modulus; });
    CHECK(mu == Approx(p.shear_modulus()).epsilon(1e-14));
    Matrix3 shear = Matrix3::Zero();
    shear(0, 1) = 1;
    CHECK((stress_rate(material, I, shear) - mu * (shear + shear.transpose())).norm() < 1e-14);
    // d2(W + U)/de2 of F = (1 + e) I is 9 K.
    const double curvature =
        stress_rate(material, I, I).trace() + 9 * volumetric(material, 0).curvature;
    CHECK(curvature == Approx(9 * p.bulk_modulus()).epsilon(1e-13));
  }
}

TEST_CASE("every material is isotropic and feels no rotation") {
  for (const Material& material : all_materials()) {
    CAPTURE(name(material));
    const double here = energy(material, generic);
    CHECK(energy(material, turned * generic) == Approx(here).epsilon(1e-13));
    CHECK(energy(material, generic * turned) == Approx(here).epsilon(1e-13));
    const Matrix3 kirchhoff = stress(material, generic) * generic.transpose();
    CHECK((kirchhoff - kirchhoff.transpose()).norm() < 1e-14);
  }
}

TEST_CASE("Ogden's exponents 2 and -2 are neo-Hookean and Mooney-Rivlin") {
  MaterialParameters p;
  p.bulk_to_shear = 5;
  p.c01_share = 0.3;
  const Material neo_hookean = NeoHookean::from(p), mooney_rivlin = MooneyRivlin::from(p);
  const Material ogden_2 = Ogden::from(p);
  p.ogden = {{0.7, 2}, {0.3, -2}};
  const Material ogden_22 = Ogden::from(p);
  const Matrix3 dF = generic * turned;
  const auto same = [&](const Material& a, const Material& b) {
    CHECK(energy(a, generic) == Approx(energy(b, generic)).epsilon(1e-13));
    CHECK((stress(a, generic) - stress(b, generic)).norm() < 1e-14);
    CHECK((stress_rate(a, generic, dF) - stress_rate(b, generic, dF)).norm() < 1e-13);
  };
  same(ogden_2, neo_hookean);
  same(ogden_22, mooney_rivlin);
}

TEST_CASE("a material that is not in the list is refused") {
  MaterialParameters p;
  p.model = "rubber";
  CHECK_THROWS_AS(make_material(p), std::invalid_argument);
}
