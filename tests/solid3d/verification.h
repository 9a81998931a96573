#pragma once

#include <Eigen/Geometry>
#include <random>

#include "solid3d/mesh.h"
#include "tests/solid3d/hex_problem.h"

/// Problems whose answer is known, each as a function of the element and the mesh.
namespace bight::test {

using solid3d::HexElement;
using solid3d::Material;

inline bool at(double a, double b) { return std::abs(a - b) < 1e-9; }

/// A cube of 3 x 3 x 3 cells whose inner nodes are moved at random: a distorted patch, of degree 2
/// with curved sides.
inline solid3d::HexMesh distorted_patch(int degree) {
  solid3d::HexMesh mesh = brick(degree, {3, 3, 3}, [](const Vector3& X) { return X; });
  std::mt19937 generator(11);
  const double most = 0.08 / (degree * degree);
  std::uniform_real_distribution<double> move(-most, most);
  for (Vector3& X : mesh.nodes)
    if (X.minCoeff() > 0.1 && X.maxCoeff() < 0.9)
      X += Vector3(move(generator), move(generator), move(generator));
  return mesh;
}

/// Torque and axial force on a rod of radius 1/2 twisted by psi per length between flat ends.
/// Incompressible: M = pi/2 mu psi R^4, N = -pi/4 mu psi^2 R^4 (Rivlin 1949); over those, minus 1.
struct TorsionErrors {
  double moment, force;
};
inline TorsionErrors torsion(const HexElement& element, int cells, double psi) {
  const solid3d::NeoHookean material{1, 1e5};
  const solid3d::Mesh rod = solid3d::make_mesh(solid3d::make_section(cells, element.degree), [&] {
    const double width = std::sqrt(M_PI / 4 / cells);
    const int layers = static_cast<int>(std::ceil(1 / width));
    std::vector<double> s;
    for (int k = 0; k <= layers; ++k) s.push_back(static_cast<double>(k) / layers);
    return s;
  }());
  HexProblem problem(rod.hexahedra(), material, element);
  const int steps = 4;
  NewtonResult result;
  for (int step = 1; step <= steps; ++step) {
    for (int n = 0; n < rod.nodes(); ++n) {
      const Vector3 now = problem.position(n);
      const double turn = psi * rod.reference(n).z() / steps;
      problem.x.segment<3>(3 * n) = Eigen::AngleAxisd(turn, Vector3::UnitZ()) * now;
    }
    problem.each([](const Vector3& X) { return at(X.z(), 0) || at(X.z(), 1); },
                 [&](int n) { problem.hold(n); });
    result = problem.solve();
  }
  double moment = 0, force = 0;
  problem.each([](const Vector3& X) { return at(X.z(), 1); },
               [&](int n) {
                 const Vector3 r = problem.position(n), f = result.gradient.segment<3>(3 * n);
                 moment += r.x() * f.y() - r.y() * f.x();
                 force += f.z();
               });
  constexpr double R4 = 1.0 / 16;
  return {moment / (M_PI / 2 * psi * R4) - 1, force / (-M_PI / 4 * psi * psi * R4) - 1};
}

/// Pressure over mu_s in a tube of radii 1 and 2, in plane strain, blown up to an inner radius of
/// 1.5; a quarter of n x n cells. Incompressible: 0.42823.
inline double thick_tube(const HexElement& element, int n) {
  constexpr double blown = 1.5, height = 0.25;
  HexProblem problem(brick(element.degree, {n, n, 1},
                           [&](const Vector3& u) {
                             const double r = 1 + u.x(), angle = M_PI / 2 * u.y();
                             return Vector3(r * std::cos(angle), r * std::sin(angle),
                                            height * u.z());
                           }),
                     solid3d::NeoHookean{1, 1e5}, element);
  const auto inner = [](const Vector3& X) { return at(X.head<2>().norm(), 1); };
  for (size_t i = 0; i < problem.mesh().nodes.size(); ++i) {
    const Vector3& X = problem.mesh().nodes[i];
    const int node = static_cast<int>(i);
    problem.hold(node, 2);
    if (at(X.x(), 0)) problem.hold(node, 0);
    if (at(X.y(), 0)) problem.hold(node, 1);
    if (inner(X)) problem.hold(node, 0), problem.hold(node, 1);
    // r^2 - R^2 is the same everywhere.
    const double R = X.head<2>().norm();
    problem.x.segment<2>(3 * node) *= std::sqrt(R * R + blown * blown - 1) / R;
  }
  const NewtonResult result = problem.solve();
  double outwards = 0;
  problem.each(inner, [&](int node) {
    outwards += result.gradient.segment<2>(3 * node).dot(problem.position(node).head<2>()) / blown;
  });
  // The nodes' forces are along their radii r: p times the growth of the area inside by r, which
  // is twice the area over r. Triangles, and of degree 2 the segments of parabolas on them.
  const double half = M_PI / 4 / n, chord = 2 * std::sin(half);
  const double parabola = element.degree == 2 ? 4.0 / 3 * chord * (1 - std::cos(half)) : 0;
  return outwards / (n * blown * height * (std::sin(2 * half) + parabola));
}

/// Rise of the upper corner of Cook's membrane [mm] of thickness 1, n x n cells, under a dead total
/// force on its right side [N]; moduli in MPa. In plane strain, or with faces that are free: then
/// half the thickness is simulated.
inline double cook(const HexElement& element, int n, const Material& material, double force,
                   bool plane_strain) {
  const double thickness = plane_strain ? 1 : 0.5;
  HexProblem problem(brick(element.degree, {n, n, 1},
                           [&](const Vector3& u) {
                             const double x = 48 * u.x(), low = 44 * u.x(), high = 44 + 16 * u.x();
                             return Vector3(x, low + u.y() * (high - low), thickness * u.z());
                           }),
                     material, element);
  problem.each([&](const Vector3& X) { return plane_strain || at(X.z(), 0); },
               [&](int node) { problem.hold(node, 2); });
  problem.each([](const Vector3& X) { return at(X.x(), 0); },
               [&](int node) { problem.hold(node); });
  problem.load([](const Vector3& X) { return at(X.x(), 48); }, {0, force / 16, 0});
  problem.solve_in(4);
  return problem.position(problem.node_at({48, 60, 0})).y() - 60;
}

/// Compressible: mu = 0.4225 MPa, nu = 0.3, 1 N (Miehe 1994). 14.33 mm with faces that are free:
/// Pelteret and McBride, deal.II code gallery (2016), second order; said to be plane strain, but
/// the program looks for its faces at x = 1/2 instead of z. In plane strain all elements go
/// to 13.77.
inline double cook_compressible(const HexElement& element, int n, bool plane_strain) {
  constexpr double mu = 0.4225, nu = 0.3;
  return cook(element, n,
              solid3d::CompressibleNeoHookean{mu, 2 * mu * (1 + nu) / (3 * (1 - 2 * nu))}, 1,
              plane_strain);
}

/// Near-incompressible, plane strain: G = 80.1938 MPa, K = 40.0942e4 MPa, 6.25 N/mm^2 (de Souza
/// Neto 1996).
inline double cook_incompressible(const HexElement& element, int n) {
  return cook(element, n, solid3d::NeoHookean{80.1938, 40.0942e4}, 100, true);
}

/// How far the middle of the upper face of a block of 100 x 100 x 50 mm sinks [mm] under a dead
/// pressure of 9 MPa on the inner quarter of that face, whose points only move up and down; a
/// quarter of the block, n^3 cells. Reese, Wriggers and Reddy (2000), with the numbers of Schroeder
/// et al. (2021): mu = 1.61148 MPa, lambda = 499.92568 MPa.
inline double partly_pressed_block(const HexElement& element, int n) {
  constexpr double mu = 1.61148, lambda = 499.92568, L = 50;
  HexProblem problem(brick(element.degree, {n, n, n}, [&](const Vector3& u) { return L * u; }),
                     solid3d::NeoHookean{mu, lambda + 2 * mu / 3}, element);
  for (size_t i = 0; i < problem.mesh().nodes.size(); ++i) {
    const Vector3& X = problem.mesh().nodes[i];
    const int node = static_cast<int>(i);
    if (at(X.x(), 0) || at(X.z(), L)) problem.hold(node, 0);
    if (at(X.y(), 0) || at(X.z(), L)) problem.hold(node, 1);
    if (at(X.z(), 0)) problem.hold(node, 2);
  }
  problem.load(
      [&](const Vector3& X) {
        return at(X.z(), L) && X.x() < L / 2 + 1e-9 && X.y() < L / 2 + 1e-9;
      },
      {0, 0, -9});
  problem.solve_in(6);
  return L - problem.position(problem.node_at({0, 0, L})).z();
}

}  // namespace bight::test
