#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "mechanics/effect.h"

namespace bight::solid3d {

/// Dead forces on nodes, which keep size and direction: W = -sum of f . x   [E D^3].
class Load final : public Effect {
 public:
  explicit Load(std::string_view name = "load") : name_(name) {}

  /// The force on a node that has none yet [E D^2].
  void add(int node, const Vector3& force) {
    const int at = 3 * node;
    coordinates_.push_back({at, at + 1, at + 2});
    forces_.push_back(force);
  }
  /// The force on a node, instead of the one before [E D^2].
  void set(int node, const Vector3& force) {
    const int at = 3 * node;
    for (size_t i = 0; i < forces_.size(); ++i)
      if (coordinates_[i][0] == at) {
        forces_[i] = force;
        return;
      }
    add(node, force);
  }
  /// Sum of their sizes [E D^2].
  double total() const {
    double sum = 0;
    for (const Vector3& force : forces_) sum += force.norm();
    return sum;
  }
  std::string_view name() const override { return name_; }
  bool from_outside() const override { return true; }
  int stencils() const override { return static_cast<int>(forces_.size()); }
  std::span<const int> coordinates(int i) const override { return coordinates_[i]; }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override {
    slot.energy = -forces_[i].dot(x.segment<3>(coordinates_[i][0]));
    if (order >= Order::gradient) Vector3::Map(slot.gradient) = -forces_[i];
  }

 private:
  std::string_view name_;
  std::vector<std::array<int, 3>> coordinates_;
  std::vector<Vector3> forces_;
};

}  // namespace bight::solid3d
