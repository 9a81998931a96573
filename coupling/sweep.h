#pragma once

#include <vector>

#include "rod1d/run_rod.h"
#include "solid3d/mesh.h"

namespace bight::coupling {

/// How fine the swept mesh is.
struct SweepOptions {
  int section_elements = 32;
  int degree = 1;            ///< of the cells
  double axial_ratio = 0.8;  ///< cell length over section cell width, in the knot: of either degree
                             ///< the surface grid is as fine around as along
  double tail_ratio = 3.0;   ///< the same at the ends of the tails
  double knot_margin = 2.0;  ///< fine cells reach this far beyond the knot [D]
  /// By how much ebar rises above that of the rod on the path to come: so much more of the rod is
  /// in the knot then [D].
  double loosened_by = 0;
};

/// The mesh of a straight rod of that length whose fine part covers the rod's knot.
solid3d::Mesh swept_mesh(const SweepOptions& options, const rod1d::RodState& rod);

/// Node positions [D] that bring the mesh onto the rod's centerline: cubic spline through the
/// nodes, parallel-transported frame from the start (plus the rod's twist), section shrunk by
/// 1/sqrt(stretch) and bent anticlastically. The ends are flat, round and across the z axis.
std::vector<Vector3> sweep(const solid3d::Mesh& mesh, const rod1d::RodState& rod);

}  // namespace bight::coupling
