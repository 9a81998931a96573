#pragma once

#include <memory>

#include "rod1d/effects/inertia.h"
#include "rod1d/effects/load.h"

namespace bight::rod1d {

/// Weight of the rod, a dead load on its lumped masses:
///
///   W = -sum of m_i g . x_i   [E D^3]
///
/// g: acceleration of gravity [E/(rho D)].
inline std::unique_ptr<Load> gravity(const Rod& rod, const Vector3& g) {
  auto weight = std::make_unique<Load>("gravity");
  const Vector mass = lumped_mass(rod, false);
  for (int i = 0; i < rod.nodes(); ++i) weight->add(i, mass[Rod::position(i)] * g);
  return weight;
}

}  // namespace bight::rod1d
