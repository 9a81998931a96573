#pragma once

#include "solid3d/hex_reference.h"

namespace bight::solid3d {

/// Adds a cell's share of the mass.
template <int degree>
void add_lumped_mass(const HexMesh& mesh, const HexCell& cell, Vector& mass) {
  const auto reference = hex_reference<degree>(cell_nodes<degree>(mesh, cell));
  for (int q = 0; q < reference.points; ++q) {
    const auto N = parent_values<degree>(cell_point(degree, q).xi);
    for (int a = 0; a < hex_nodes<degree>; ++a)
      mass.segment<3>(3 * cell[static_cast<size_t>(a)]).array() +=
          reference.weight[static_cast<size_t>(q)] * N[a];
  }
}

/// Inertia of a solid, by coordinates: every node carries its share of the cells around it,
///
///   m_a = integral of rho N_a dV   [rho D^3],
///
/// the row sums of the consistent mass matrix, positive for both degrees. As in Abaqus' first-order
/// elements; waves are too slow on a coarse mesh where consistent ones are too fast, M needs no
/// equations to be solved, and the energy of a stage (mechanics/inertial_pull.h) adds only to the
/// diagonal. A section of 8-node cells of width h has h^2/6 A too much rotary inertia, which slow
/// bending does not feel.
///
/// Only cells from `first_cell` on: the mass of one half, where the rest is its image.
inline Vector lumped_mass(const HexMesh& mesh, int coordinates, int first_cell = 0) {
  Vector mass = Vector::Zero(coordinates);
  for (size_t i = static_cast<size_t>(first_cell); i < mesh.cells.size(); ++i)
    if (mesh.degree == 1)
      add_lumped_mass<1>(mesh, mesh.cells[i], mass);
    else
      add_lumped_mass<2>(mesh, mesh.cells[i], mass);
  return mass;
}

}  // namespace bight::solid3d
