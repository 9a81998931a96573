#pragma once

#include "solid3d/hex.h"

namespace bight::solid3d {

/// Inertia of a solid, by coordinates: every node carries its share of the cells around it,
///
///   m_a = integral of rho N_a dV   [rho D^3],
///
/// the row sums of the consistent mass matrix. As in Abaqus' first-order elements; waves are too
/// slow on a coarse mesh where consistent ones are too fast, M needs no equations to be solved, and
/// the energy of a stage (mechanics/inertial_pull.h) adds only to the diagonal. A section of cells
/// of width h has h^2/6 A too much rotary inertia, which slow bending does not feel.
///
/// Only cells from `first_cell` on: the mass of one half, where the rest is its image.
inline Vector lumped_mass(const HexMesh& mesh, int coordinates, int first_cell = 0) {
  Vector mass = Vector::Zero(coordinates);
  const double gauss = 1 / std::sqrt(3.0);
  for (size_t i = static_cast<size_t>(first_cell); i < mesh.cells.size(); ++i) {
    const HexReference reference = hex_reference(cell_nodes(mesh, mesh.cells[i]));
    for (int q = 0; q < reference.points; ++q) {
      const Vector3 xi(q & 1 ? gauss : -gauss, q & 2 ? gauss : -gauss, q & 4 ? gauss : -gauss);
      for (int a = 0; a < 8; ++a) {
        const Vector3 f = Vector3::Ones() + xi.cwiseProduct(parent_corners().col(a));
        mass.segment<3>(3 * mesh.cells[i][static_cast<size_t>(a)]).array() +=
            reference.weight[static_cast<size_t>(q)] * f.prod() / 8;
      }
    }
  }
  return mass;
}

}  // namespace bight::solid3d
