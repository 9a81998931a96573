#include "tests/solid3d/verification.h"

#include <catch2/catch.hpp>

using namespace bight;
using namespace bight::solid3d;

// Large strains against closed forms and published tables, for every element. README.md has the
// errors with refinement.

namespace {

struct Rubber {
  std::string name;
  Material material;
  double C10, C01;  ///< where it has closed forms of Mooney and Rivlin
};

std::vector<Rubber> rubbers() {
  constexpr double K = 1e6;
  return {{"neo-Hookean", NeoHookean{1, K}, 0.5, 0},
          {"Mooney-Rivlin", MooneyRivlin{1, K, 0.3}, 0.35, 0.15},
          {"Ogden", Ogden{1, K, {{0.7, 2}, {0.3, -2}}}, 0.35, 0.15}};
}

/// A distorted patch with all of its surface moved by F x.
test::HexProblem moved_patch(const Material& material, const HexElement& element,
                             const Matrix3& F) {
  test::HexProblem problem(test::distorted_patch(element.degree), material, element);
  problem.each([](const Vector3& X) { return X.minCoeff() == 0 || X.maxCoeff() == 1; },
               [&](int node) { problem.hold(node); });
  problem.each([](const Vector3&) { return true; },
               [&](int node) { problem.x.segment<3>(3 * node) = F * problem.position(node); });
  return problem;
}

}  // namespace

TEST_CASE(
    "incompressible rubber stretched along one axis: nominal stress 2 (C10 + C01/l)(l - 1/l^2)") {
  for (const HexElement& element : hex_elements())
    for (const Rubber& rubber : rubbers())
      for (const double l : {0.5, 2.0}) {
        CAPTURE(element.name, rubber.name, l);
        test::HexProblem problem(test::distorted_patch(element.degree), rubber.material, element);
        const Vector3 stretch(1 / std::sqrt(l), 1 / std::sqrt(l), l);
        problem.each([](const Vector3&) { return true; },
                     [&](int node) {
                       const Vector3& X = problem.mesh().nodes[node];
                       problem.x.segment<3>(3 * node) = stretch.cwiseProduct(X);
                       for (int c = 0; c < 3; ++c)
                         if (X[c] == 0 || (c == 2 && X[c] == 1)) problem.hold(node, c);
                     });
        const NewtonResult result = problem.solve();
        double force = 0;
        problem.each([](const Vector3& X) { return X.z() == 1; },
                     [&](int node) { force += result.gradient[3 * node + 2]; });
        CHECK(force == Approx(2 * (rubber.C10 + rubber.C01 / l) * (l - 1 / (l * l))).epsilon(1e-5));
      }
}

TEST_CASE("incompressible rubber in simple shear: shear stress and normal differences") {
  constexpr double gamma = 0.8;
  Matrix3 F = Matrix3::Identity();
  F(0, 1) = gamma;
  for (const HexElement& element : hex_elements())
    for (const Rubber& rubber : rubbers()) {
      CAPTURE(element.name, rubber.name);
      test::HexProblem problem = moved_patch(rubber.material, element, F);
      problem.solve();
      const Strain strain = problem.strain();
      for (int cell = 0; cell < strain.cells(); ++cell) {
        const Matrix3 s = strain.stress(problem.x, cell).cauchy;
        const double mu = 2 * (rubber.C10 + rubber.C01);
        CHECK(s(0, 1) == Approx(mu * gamma).epsilon(1e-7));
        CHECK(s(0, 0) - s(1, 1) == Approx(mu * gamma * gamma).epsilon(1e-7));
        CHECK(s(1, 1) - s(2, 2) == Approx(-2 * rubber.C01 * gamma * gamma).margin(1e-7));
      }
    }
}

TEST_CASE("a cylinder twisted by one radian per radius: torque and axial force") {
  // 12 and 32 cells: both fall with the square of the cell's width.
  for (const HexElement& element : hex_elements()) {
    CAPTURE(element.name);
    const auto coarse = test::torsion(element, 12, 2), fine = test::torsion(element, 32, 2);
    CHECK(std::abs(fine.moment) < 0.03);
    CHECK(std::abs(fine.force) < 0.08);
    CHECK(std::abs(fine.moment) < 0.5 * std::abs(coarse.moment));
    CHECK(std::abs(fine.force) < 0.5 * std::abs(coarse.force));
  }
}

TEST_CASE("a thick tube under pressure") {
  constexpr double exact = 0.42823;
  for (const HexElement& element : hex_elements()) {
    CAPTURE(element.name);
    const double coarse = test::thick_tube(element, 8) - exact;
    const double fine = test::thick_tube(element, 16) - exact;
    constexpr double last_digit = 5e-6;
    CHECK(std::abs(fine) < 0.001 * exact);
    CHECK(std::abs(fine) < std::max(0.3 * std::abs(coarse), last_digit));
  }
}

TEST_CASE("Cook's membrane, compressible") {
  for (const HexElement& element : hex_elements()) {
    CAPTURE(element.name);
    constexpr double last_digit = 5e-3;
    for (const auto& [plane_strain, converged] :
         {std::pair(false, 14.33), std::pair(true, 13.77)}) {
      const double coarse = converged - test::cook_compressible(element, 8, plane_strain);
      const double fine = converged - test::cook_compressible(element, 16, plane_strain);
      CHECK(std::abs(fine) < 0.01 * converged);
      CHECK(std::abs(fine) < std::max(0.4 * std::abs(coarse), last_digit));
    }
  }
}

TEST_CASE("Cook's membrane, near-incompressible: at least as near as the F-bar quadrilateral") {
  constexpr double converged = 6.9;
  for (const HexElement& element : hex_elements()) {
    CAPTURE(element.name);
    for (const auto& [cells, f_bar] : {std::pair(10, 6.75), std::pair(15, 6.82)})
      CHECK(std::abs(test::cook_incompressible(element, cells) - converged) <
            converged - f_bar + 0.05);
  }
}

TEST_CASE("a partly pressed block: the numbers of another three-field code") {
  // Ikarus 2025, tests/src/testincompressibleblock.hh: Q1-P0 on 2, 4 and 8 cells.
  const HexElement& element = hex_element("three-field");
  CHECK(test::partly_pressed_block(element, 2) == Approx(45.08467250483267).epsilon(1e-9));
  CHECK(test::partly_pressed_block(element, 4) == Approx(41.32367771133791).epsilon(1e-9));
}

TEST_CASE("a partly pressed block converges for every element", "[long]") {
  CHECK(test::partly_pressed_block(hex_element("three-field"), 8) ==
        Approx(40.56242425245286).epsilon(1e-9));
  // 39.92 with 4^3 cells of second order (Ikarus, continuous pressure).
  for (const HexElement& element : hex_elements())
    CHECK(test::partly_pressed_block(element, 16 / element.degree) == Approx(39.92).epsilon(0.025));
}
