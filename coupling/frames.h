#pragma once

#include "mechanics/types.h"
#include "rod1d/run_rod.h"

namespace bight::coupling {

/// An orthonormal frame per node of a rod: d3 tangent, d1 and d2 material directors.
struct NodeFrames {
  std::vector<Vector3> d1, d2, d3;
};

/// The twist-free frame carried along the centerline from node 0 (Bishop 1975), turned by the twist
/// angles where the rod has them.
NodeFrames node_frames(const rod1d::RodState& state);

}  // namespace bight::coupling
