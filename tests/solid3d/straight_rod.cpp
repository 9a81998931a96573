#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <numbers>

#include "mechanics/newton.h"
#include "solid3d/effects.h"
#include "solid3d/effects/grip.h"
#include "solid3d/section_motion.h"
#include "tests/solid3d/shapes.h"

using namespace bight;
using namespace bight::solid3d;

namespace {

/// Small strains of a straight rod: curvature, axial strain, twist per length.
struct Strains {
  double kappa = 0, epsilon = 0, psi = 0;
};

/// Energy at equilibrium of a rod whose flat end sections are moved as those of a rod of uniform
/// strain would be.
double energy(int cells, double length, double axial, const Strains& strain) {
  const Mesh mesh = test::straight_mesh(cells, length, axial);
  SolidParameters parameters;
  parameters.contact = false;
  const Grip grip{false, false, {}};
  const int internal = grip.coordinates(mesh);
  SolidEffects effects = make_effects(mesh, parameters, internal);
  Vector x = test::reference_state(mesh, 2 * static_cast<int>(mesh.cells.size()));
  const Unknowns unknowns = grip.unknowns(mesh, static_cast<int>(x.size()));
  Assembler assembler(unknowns, effects.list);
  SparseCholesky cholesky;
  System system{assembler, cholesky, Ordering::natural, {}, 0, 0, {}};
  system.advance = [&](Vector& state, const Vector& dx) { advance_sections(mesh, state, dx); };
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Vector3 X = mesh.reference(n);
    const double z = X.z(), a = strain.kappa * z;
    const Vector3 centre =
        strain.kappa > 0 ? Vector3((1 - std::cos(a)) / strain.kappa, 0, std::sin(a) / strain.kappa)
                         : Vector3(0, 0, z * (1 + strain.epsilon));
    const Matrix3 R = (Eigen::AngleAxisd(a, Vector3::UnitY()) *
                       Eigen::AngleAxisd(strain.psi * z, Vector3::UnitZ()))
                          .toRotationMatrix();
    x.segment<3>(3 * n) = centre + R * Vector3(X.x(), X.y(), 0);
  }
  NewtonOptions options;
  options.force_tolerance = 1e-10;  // bending moments are about 5e-5
  options.energy_tolerance = 1e-16;
  options.bound.first_rise = 1e-3;
  const NewtonResult result = newton(system, x, options);
  REQUIRE(result.ok());
  return result.energy;
}

/// Stiffness from the energies of two lengths, so that the effect of the flat ends cancels:
/// E(2L) - E(L) = stiffness strain^2 L / 2.
double stiffness(int cells, double axial, const Strains& strain) {
  constexpr double length = 2.5;
  const double size = strain.kappa + strain.epsilon + strain.psi;
  return (energy(cells, 2 * length, axial, strain) - energy(cells, length, axial, strain)) /
         (0.5 * size * size * length);
}

void check_rod(int cells, double axial, double tolerance) {
  constexpr double B = std::numbers::pi / 64, EA = std::numbers::pi / 4, C = B / 1.5;
  CHECK(stiffness(cells, axial, {1e-3, 0, 0}) == Approx(B).epsilon(tolerance));
  CHECK(stiffness(cells, axial, {0, 1e-4, 0}) == Approx(EA).epsilon(tolerance));
  CHECK(stiffness(cells, axial, {0, 0, 1e-3}) == Approx(C).epsilon(tolerance));
}

}  // namespace

TEST_CASE("a straight rod of 32 cells bends, stretches and twists as B, EA and C to 1 %") {
  check_rod(32, 0.8, 0.01);
}

TEST_CASE("a straight rod of 108 cells does so to 0.3 %", "[long]") { check_rod(108, 0.8, 0.003); }
