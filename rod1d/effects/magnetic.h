#pragma once

#include "rod1d/effects/stencils.h"
#include "rod1d/rod.h"

namespace bight::rod1d {

/// A segment from x0 to x1 of a paramagnetic rod in a uniform field b. A slender rod is magnetised
/// more easily along its tangent t than across, so that it turns into the line of the field:
///
///   W = -1/2 l (m . t)^2   [E D^3],   m = b sqrt(pi/4 chi^2/(2 + chi)/(mu_0 E))   [sqrt(E) D]
///
/// with the demagnetising factors 0 and 1/2 of a long cylinder of susceptibility chi (Gerbal et
/// al., PNAS 112, 7135, 2015). l is the undeformed length. With q = m - (m . t) t:
///
///   d(m . t)/dx1 = q/|x1 - x0|
///   d2(m . t)/dx1^2 = -(t q' + q t' + (m . t) (I - t t'))/|x1 - x0|^2
inline Element<6> magnetic_element(const Eigen::Matrix<double, 6, 1>& x, const Vector3& m,
                                   double l) {
  Element<6> out;
  const Vector3 e = x.tail<3>() - x.head<3>();
  const double length = e.norm();
  if (!(length > 1e-3 * l)) {
    out.energy = inadmissible;
    return out;
  }
  const Vector3 t = e / length;
  const double along = m.dot(t);
  const Vector3 q = m - along * t, slope = q / length;
  const Matrix3 curvature =
      -(t * q.transpose() + q * t.transpose() + along * (Matrix3::Identity() - t * t.transpose())) /
      (length * length);
  out.energy = -0.5 * l * along * along;
  out.gradient.tail<3>() = -l * along * slope;
  out.gradient.head<3>() = -out.gradient.tail<3>();
  const Matrix3 k = -l * (slope * slope.transpose() + along * curvature);
  out.hessian.topLeftCorner<3, 3>() = out.hessian.bottomRightCorner<3, 3>() = k;
  out.hessian.topRightCorner<3, 3>() = out.hessian.bottomLeftCorner<3, 3>() = -k;
  return out;
}

class Magnetic final : public Effect {
 public:
  Magnetic(const Rod& rod, const Vector3& m) : m_(m), rest_length_(rod.rest_length) {
    for (int i = 0; i < rod.segments(); ++i) {
      const int a = Rod::position(i), b = Rod::position(i + 1);
      stencils_.add({a, a + 1, a + 2, b, b + 1, b + 2});
    }
  }
  std::string_view name() const override { return "magnetic"; }
  bool from_outside() const override { return true; }
  int stencils() const override { return stencils_.size(); }
  std::span<const int> coordinates(int i) const override { return stencils_[i]; }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override {
    slot.set(magnetic_element(stencils_.gather(x, i), m_, rest_length_[i]), order);
  }

 private:
  Vector3 m_;
  std::vector<double> rest_length_;
  Stencils<6> stencils_;
};

}  // namespace bight::rod1d
