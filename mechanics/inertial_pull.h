#pragma once

#include "mechanics/effect.h"
#include "mechanics/unknowns.h"

namespace bight {

/// Inertia, or drag, in an implicit stage of time integration, as an energy:
///
///   P(x) = strength/2 sum of m_i (x_i - target_i)^2   [E D^3]
///
/// over the coordinates that Newton moves, angles among them. Where W + P is least, the stage's
/// equations of motion hold (mechanics/dynamics.h). Without a stage its strength is zero.
/// A step h of implicit Euler with a drag of alpha M v and no inertia is one with alpha/h.
class InertialPull final : public Effect {
 public:
  /// `mass`: by coordinates [rho D^3]; of an angle, what the points that it carries weigh is there
  /// already.
  InertialPull(const Unknowns& unknowns, const Vector& mass) : mass_(mass) {
    for (int c = 0; c < unknowns.coordinates(); ++c)
      if (unknowns.index(c) >= 0 && mass[c] > 0) coordinates_.push_back(c);
  }

  void set(double strength, Vector target) {
    strength_ = strength;
    target_ = std::move(target);
  }
  void rest() { strength_ = 0; }

  std::string_view name() const override { return "inertia"; }
  bool from_outside() const override { return true; }
  int stencils() const override {
    return strength_ > 0 ? static_cast<int>(coordinates_.size()) : 0;
  }
  std::span<const int> coordinates(int i) const override {
    return {&coordinates_[static_cast<size_t>(i)], 1};
  }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override {
    const int c = coordinates_[static_cast<size_t>(i)];
    const double k = strength_ * mass_[c], away = x[c] - target_[c];
    slot.energy = 0.5 * k * away * away;
    if (order >= Order::gradient) slot.gradient[0] = k * away;
    if (order >= Order::hessian) slot.hessian[0] = k;
  }

 private:
  Vector mass_, target_;
  std::vector<int> coordinates_;
  double strength_ = 0;
};

}  // namespace bight
