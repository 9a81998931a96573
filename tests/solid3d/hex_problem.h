#pragma once

#include <functional>
#include <stdexcept>

#include "mechanics/newton.h"
#include "solid3d/effects/hourglass.h"
#include "solid3d/effects/load.h"
#include "solid3d/effects/strain.h"
#include "solid3d/elements.h"

namespace bight::test {

/// Equilibrium of a block of any hexahedra with held coordinates and dead loads.
class HexProblem {
 public:
  HexProblem(solid3d::HexMesh mesh, solid3d::Material material, const solid3d::HexElement& element)
      : mesh_(std::move(mesh)),
        material_(std::move(material)),
        element_(element),
        positions_(3 * static_cast<int>(mesh_.nodes.size())),
        held_(static_cast<size_t>(positions_ + strain().internals()), false),
        force(Vector::Zero(positions_)),
        x(Vector::Zero(static_cast<int>(held_.size()))) {
    for (size_t n = 0; n < mesh_.nodes.size(); ++n)
      x.segment<3>(3 * static_cast<int>(n)) = mesh_.nodes[n];
  }

  const solid3d::HexMesh& mesh() const { return mesh_; }
  int positions() const { return positions_; }

  void hold(int node, int direction) { held_[static_cast<size_t>(3 * node + direction)] = true; }
  void hold(int node) {
    for (int c = 0; c < 3; ++c) hold(node, c);
  }
  /// Calls `act` with every node whose reference position is there.
  void each(const std::function<bool(const Vector3&)>& there,
            const std::function<void(int)>& act) const {
    for (size_t n = 0; n < mesh_.nodes.size(); ++n)
      if (there(mesh_.nodes[n])) act(static_cast<int>(n));
  }

  /// A dead traction on faces of cells whose reference corners are all there.
  void load(const std::function<bool(const Vector3&)>& there, const Vector3& traction) {
    const int degree = mesh_.degree;
    for (const auto& cell : mesh_.cells)
      for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1}) {
          std::vector<int> corner;
          bool all = true;
          for (int a = 0; a < 8; ++a)
            if (solid3d::parent_nodes()(axis, a) == side) {
              corner.push_back(cell[a]);
              all = all && there(mesh_.nodes[cell[a]]);
            }
          if (!all) continue;
          // Of a parallelogram, which every loaded face here is; Simpson's weights for parabolas.
          const Vector3& origin = mesh_.nodes[corner[0]];
          const double area =
              (mesh_.nodes[corner[1]] - origin).cross(mesh_.nodes[corner[2]] - origin).norm();
          for (size_t a = 0; a < cell.size(); ++a) {
            const Vector3 at = solid3d::parent_nodes().col(static_cast<int>(a));
            if (at[axis] != side) continue;
            double part = 1;
            for (int c = 0; c < 3; ++c)
              if (c != axis) part *= degree == 1 ? 1.0 / 2 : at[c] == 0 ? 4.0 / 6 : 1.0 / 6;
            force.segment<3>(3 * cell[a]) += part * area * traction;
          }
        }
  }

  /// To equilibrium from x, with the loads times `part`. Throws where there is none.
  NewtonResult solve(double part = 1) {
    EffectList effects = solid_effects();
    auto load = std::make_unique<solid3d::Load>();
    for (int c = 0; c < positions_; c += 3)
      if (!force.segment<3>(c).isZero(0)) load->set(c / 3, part * force.segment<3>(c));
    effects.push_back(std::move(load));
    std::vector<int> blocks;
    for (int c = 0; c < positions_; c += 3) blocks.push_back(c);
    const Unknowns unknowns(blocks, positions_, held_);
    Assembler assembler(unknowns, effects);
    SparseCholesky cholesky;
    System system{assembler, cholesky, Ordering::dissection, {}, 0, 0, {}};
    system.advance = [&](Vector& state, const Vector& dx) { unknowns.advance(state, dx); };
    NewtonOptions options;
    const double mu = std::visit([](const auto& m) { return m.shear_modulus; }, material_);
    const double size = mesh_.nodes.back().cwiseAbs().maxCoeff();
    options.largest_move = 0.5 * size;
    options.force_tolerance = 1e-10 * mu * size * size;
    options.energy_tolerance = 1e-15 * mu * size * size * size;
    options.bound.first_rise = 0.1 * mu * size * size * size;
    options.max_iterations = 200;
    NewtonResult result = newton(system, x, options);
    if (!result.ok()) throw std::runtime_error(result.reason);
    x = result.x;
    iterations += result.iterations;
    return result;
  }
  /// In `steps` equal parts of the load.
  NewtonResult solve_in(int steps) {
    NewtonResult result;
    for (int i = 1; i <= steps; ++i) result = solve(static_cast<double>(i) / steps);
    return result;
  }

  Vector3 position(int node) const { return x.segment<3>(3 * node); }
  int node_at(const Vector3& X) const {
    for (size_t n = 0; n < mesh_.nodes.size(); ++n)
      if ((mesh_.nodes[n] - X).norm() < 1e-9) return static_cast<int>(n);
    throw std::runtime_error("no node there");
  }
  solid3d::Strain strain() const {
    return solid3d::Strain(mesh_, positions_, material_, element_.quadrature);
  }
  EffectList solid_effects() const {
    EffectList effects;
    effects.push_back(std::make_unique<solid3d::Strain>(strain()));
    if (element_.hourglass)
      effects.push_back(std::make_unique<solid3d::Hourglass>(
          mesh_, std::visit([](const auto& m) { return m.shear_modulus; }, material_)));
    return effects;
  }

 private:
  solid3d::HexMesh mesh_;
  solid3d::Material material_;
  const solid3d::HexElement& element_;
  int positions_;
  std::vector<bool> held_;

 public:
  Vector force;  ///< on nodes, by coordinate
  Vector x;      ///< the state
  int iterations = 0;
};

/// The unit cube cut into n_x n_y n_z cells, each node moved to map(X).
inline solid3d::HexMesh brick(int degree, std::array<int, 3> n,
                              const std::function<Vector3(const Vector3&)>& map) {
  solid3d::HexMesh mesh;
  mesh.degree = degree;
  for (int& count : n) count *= degree;
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i)
        mesh.nodes.push_back(map({static_cast<double>(i) / n[0], static_cast<double>(j) / n[1],
                                  static_cast<double>(k) / n[2]}));
  const int nodes = degree == 1 ? 8 : 27;
  for (int k = 0; k < n[2]; k += degree)
    for (int j = 0; j < n[1]; j += degree)
      for (int i = 0; i < n[0]; i += degree) {
        solid3d::HexCell cell;
        for (int a = 0; a < nodes; ++a) {
          const auto at = solid3d::grid_place(degree, a);
          cell.push_back(((k + at[2]) * (n[1] + 1) + j + at[1]) * (n[0] + 1) + i + at[0]);
        }
        mesh.cells.push_back(cell);
      }
  return mesh;
}

}  // namespace bight::test
