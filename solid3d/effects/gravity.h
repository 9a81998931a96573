#pragma once

#include <memory>

#include "solid3d/effects/inertia.h"
#include "solid3d/effects/load.h"

namespace bight::solid3d {

/// Weight of the solid, a dead load on its lumped masses:
///
///   W = -sum of m_a g . x_a   [E D^3]
///
/// g: acceleration of gravity [E/(rho D)].
inline std::unique_ptr<Load> gravity(const HexMesh& mesh, const Vector3& g) {
  auto weight = std::make_unique<Load>("gravity");
  const int nodes = static_cast<int>(mesh.nodes.size());
  const Vector mass = lumped_mass(mesh, 3 * nodes);
  for (int n = 0; n < nodes; ++n) weight->add(n, mass[3 * n] * g);
  return weight;
}

}  // namespace bight::solid3d
