#pragma once

#include "rod1d/effects/stencils.h"
#include "rod1d/rod.h"

namespace bight::rod1d {

/// Stretching of one segment from x0 to x1:
///
///   W = 1/2 EA l (|x1 - x0|/l - 1)^2   [E D^3]
///
/// l is the undeformed length.
inline Element<6> stretch_element(const Eigen::Matrix<double, 6, 1>& x, double EA, double l) {
  Element<6> out;
  const Vector3 e = x.tail<3>() - x.head<3>();
  const double length = e.norm();
  if (!(length > 1e-3 * l)) {
    out.energy = inadmissible;
    return out;
  }
  const Vector3 t = e / length;
  const double strain = length / l - 1;
  const double force = EA * strain;
  out.energy = 0.5 * EA * l * strain * strain;
  out.gradient.head<3>() = -force * t;
  out.gradient.tail<3>() = force * t;
  // d(force t)/de = EA/l t t' + force/length (I - t t')
  const Matrix3 k =
      (EA / l) * t * t.transpose() + (force / length) * (Matrix3::Identity() - t * t.transpose());
  out.hessian.topLeftCorner<3, 3>() = out.hessian.bottomRightCorner<3, 3>() = k;
  out.hessian.topRightCorner<3, 3>() = out.hessian.bottomLeftCorner<3, 3>() = -k;
  return out;
}

class Stretch final : public Effect {
 public:
  explicit Stretch(const Rod& rod) : rod_(rod) {
    for (int i = 0; i < rod.segments(); ++i) {
      const int a = Rod::position(i), b = Rod::position(i + 1);
      stencils_.add({a, a + 1, a + 2, b, b + 1, b + 2});
    }
  }
  std::string_view name() const override { return "stretch"; }
  int stencils() const override { return stencils_.size(); }
  std::span<const int> coordinates(int i) const override { return stencils_[i]; }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override {
    slot.set(
        stretch_element(stencils_.gather(x, i), rod_.stretching_stiffness, rod_.rest_length[i]),
        order);
  }

 private:
  Rod rod_;
  Stencils<6> stencils_;
};

}  // namespace bight::rod1d
