#pragma once

#include "rod1d/effects/inertia.h"
#include "rod1d/effects/stencils.h"
#include "rod1d/rod.h"

namespace bight::rod1d {

/// Weight of the rod, as that of its lumped masses:
///
///   W = -sum of m_i g . x_i   [E D^3]
///
/// g: acceleration of gravity [E/(rho D)].
class Gravity final : public Effect {
 public:
  Gravity(const Rod& rod, const Vector3& acceleration) {
    const Vector mass = lumped_mass(rod, false);
    for (int i = 0; i < rod.nodes(); ++i) {
      const int at = Rod::position(i);
      stencils_.add({at, at + 1, at + 2});
      weight_.push_back(mass[at] * acceleration);
    }
  }
  std::string_view name() const override { return "gravity"; }
  int stencils() const override { return stencils_.size(); }
  std::span<const int> coordinates(int i) const override { return stencils_[i]; }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override {
    Element<3> out;
    out.energy = -weight_[i].dot(stencils_.gather(x, i));
    out.gradient = -weight_[i];
    slot.set(out, order);
  }

 private:
  Stencils<3> stencils_;
  std::vector<Vector3> weight_;
};

}  // namespace bight::rod1d
