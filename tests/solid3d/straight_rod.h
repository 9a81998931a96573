#pragma once

#include <Eigen/Geometry>
#include <ctime>
#include <map>
#include <stdexcept>

#include "mechanics/newton.h"
#include "solid3d/effects.h"
#include "solid3d/effects/grip.h"
#include "solid3d/elements.h"
#include "solid3d/section_motion.h"
#include "tests/solid3d/shapes.h"

namespace bight::test {

/// Small strains of a straight rod: curvature, axial strain, twist per length.
struct Strains {
  double kappa = 0, epsilon = 0, psi = 0;
};

/// What a straight rod is made of.
struct RodOf {
  int cells = 32;      ///< in a section
  double axial = 0.8;  ///< length of a cell over its width
  std::string element = "three-field";
  double bulk_to_shear = 1000, hourglass_factor = 1;
};

struct RodSolution {
  NewtonResult newton;
  double cpu_seconds = 0;  ///< of all threads
  int unknowns = 0;
  std::map<std::string, double> wall_seconds = {};  ///< by phase
};

/// Equilibrium of a rod whose flat end sections are moved as those of a rod of uniform
/// strain would be.
inline RodSolution bent_rod(const RodOf& rod, double length, const Strains& strain) {
  using namespace solid3d;
  const Mesh mesh = straight_mesh(rod.cells, length, rod.axial, hex_element(rod.element).degree);
  SolidParameters parameters;
  parameters.contact = false;
  parameters.element = rod.element;
  parameters.material.bulk_to_shear = rod.bulk_to_shear;
  parameters.hourglass_factor = rod.hourglass_factor;
  const Grip grip{false, false, {}};
  const int internal = grip.coordinates(mesh);
  SolidEffects effects = make_effects(mesh, parameters, internal);
  Vector x = reference_state(mesh, effects.strain->internals());
  const Unknowns unknowns = grip.unknowns(mesh, static_cast<int>(x.size()));
  Assembler assembler(unknowns, effects.list);
  SparseCholesky cholesky;
  System system{assembler, cholesky, Ordering::dissection, {}, 0, 0, {}};
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
  const std::clock_t began = std::clock();
  const NewtonResult result = newton(system, x, options);
  if (!result.ok()) throw std::runtime_error("straight rod: " + result.reason);
  return {result, static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC, unknowns.size(),
          system.seconds};
}

/// Stiffness from the energies of two lengths, so that the effect of the flat ends cancels:
/// E(2L) - E(L) = stiffness strain^2 L / 2.
inline double rod_stiffness(const RodOf& rod, const Strains& strain) {
  constexpr double length = 2.5;
  const double size = strain.kappa + strain.epsilon + strain.psi;
  return (bent_rod(rod, 2 * length, strain).newton.energy -
          bent_rod(rod, length, strain).newton.energy) /
         (0.5 * size * size * length);
}

/// Relative errors of bending, stretching and twisting stiffness against those of a round rod:
/// B = pi/64, EA = pi/4, C = B/(1 + nu), 1 + nu = E/(2 mu_s).
struct RodErrors {
  double B, EA, C;
};
inline RodErrors rod_errors(const RodOf& rod) {
  constexpr double B = M_PI / 64, EA = M_PI / 4;
  const solid3d::MaterialParameters material{.bulk_to_shear = rod.bulk_to_shear};
  const double C = 2 * material.shear_modulus() * B;
  return {rod_stiffness(rod, {1e-3, 0, 0}) / B - 1, rod_stiffness(rod, {0, 1e-4, 0}) / EA - 1,
          rod_stiffness(rod, {0, 0, 1e-3}) / C - 1};
}

}  // namespace bight::test
