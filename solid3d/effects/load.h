#pragma once

#include <array>
#include <vector>

#include "mechanics/effect.h"

namespace bight::solid3d {

/// Dead forces on nodes, which keep size and direction: W = -sum of f . x   [E D^3].
class Load final : public Effect {
 public:
  /// The force on a node, instead of the one before [E D^2].
  void set(int node, const Vector3& force) {
    const int at = 3 * node;
    for (size_t i = 0; i < forces_.size(); ++i)
      if (coordinates_[i][0] == at) {
        forces_[i] = force;
        return;
      }
    coordinates_.push_back({at, at + 1, at + 2});
    forces_.push_back(force);
  }
  /// Sum of their sizes [E D^2].
  double total() const {
    double sum = 0;
    for (const Vector3& force : forces_) sum += force.norm();
    return sum;
  }
  std::string_view name() const override { return "load"; }
  int stencils() const override { return static_cast<int>(forces_.size()); }
  std::span<const int> coordinates(int i) const override { return coordinates_[i]; }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override {
    slot.energy = -forces_[i].dot(x.segment<3>(coordinates_[i][0]));
    if (order >= Order::gradient) Vector3::Map(slot.gradient) = -forces_[i];
  }

 private:
  std::vector<std::array<int, 3>> coordinates_;
  std::vector<Vector3> forces_;
};

}  // namespace bight::solid3d
