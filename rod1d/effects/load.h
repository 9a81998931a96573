#pragma once

#include "rod1d/effects/stencils.h"
#include "rod1d/rod.h"

namespace bight::rod1d {

/// Dead forces on nodes, which keep size and direction: W = -sum of f . x   [E D^3].
class Load final : public Effect {
 public:
  explicit Load(std::string_view name = "load") : name_(name) {}

  void add(int node, const Vector3& force) {
    const int at = Rod::position(node);
    stencils_.add({at, at + 1, at + 2});
    forces_.push_back(force);
  }
  /// Sum of their sizes [E D^2].
  double total() const {
    double sum = 0;
    for (const Vector3& force : forces_) sum += force.norm();
    return sum;
  }
  std::string_view name() const override { return name_; }
  bool from_outside() const override { return true; }
  int stencils() const override { return stencils_.size(); }
  std::span<const int> coordinates(int i) const override { return stencils_[i]; }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override {
    Element<3> out;
    out.energy = -forces_[i].dot(stencils_.gather(x, i));
    out.gradient = -forces_[i];
    slot.set(out, order);
  }

 private:
  std::string_view name_;
  Stencils<3> stencils_;
  std::vector<Vector3> forces_;
};

}  // namespace bight::rod1d
