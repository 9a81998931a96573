#pragma once

#include <array>
#include <vector>

#include "mechanics/contact_law.h"
#include "mechanics/effect.h"
#include "rod1d/contact_pairs.h"
#include "rod1d/curve.h"

namespace bight::rod1d {

/// A sample p of the centerline and the point y of a facing stretch that is nearest to it, as
/// weights of the eight nodes around: d = p - y = sum a x, y' = sum b x, y'' = sum c x.
struct ContactPoint {
  std::array<int, 24> coordinates;
  std::array<double, 8> a, b, c;
  double weight = 0;              ///< undeformed arc length that the sample stands for [D]
  double gap = 0;                 ///< |d| - 1 at the last refresh [D]
  int segment = 0, facing = 0;    ///< where p and y lie
  double at = 0, facing_at = 0;   ///< undeformed arc length from the start of that segment [D]
};

/// Contact of one sample with the stretch that it faces:
///
///   W = weight law(g),  g = min over s of |p - y(s)| - 1   [E D^3]
///
/// y is the nearest point for the x at hand (y' . d = 0). Gradient and Hessian contain its motion:
/// with n = d/|d|, P = I - n n', by the implicit function theorem
///
///   dg/dx_k = a_k n,   d2g/dx_k dx_l = a_k a_l P/|d| - q_k q_l'/g_ss,
///   q_k = b_k n + a_k y'/|d|,   g_ss = |y'|^2/|d| - n . y''
///
/// so that contact is a true potential (Newton sees a symmetric tangent, T = -dE/de holds).
inline Element<24> contact_element(const Eigen::Matrix<double, 24, 1>& x, const ContactPoint& at,
                                   const ContactLaw& law, Order order) {
  Element<24> out;
  Vector3 d = Vector3::Zero(), dy = Vector3::Zero(), ddy = Vector3::Zero();
  for (int k = 0; k < 8; ++k) {
    const Vector3 node = x.segment<3>(3 * k);
    d += at.a[k] * node, dy += at.b[k] * node, ddy += at.c[k] * node;
  }
  const double distance = d.norm(), gap = distance - 1;
  const Vector3 n = d / distance;
  out.energy = at.weight * law.energy(gap);
  if (order == Order::energy) return out;
  const double slope = at.weight * law.slope(gap), curvature = at.weight * law.curvature(gap);
  for (int k = 0; k < 8; ++k) out.gradient.segment<3>(3 * k) = (slope * at.a[k]) * n;
  if (order == Order::gradient) return out;

  const Vector3 along = dy / distance;
  const double pull = slope / (dy.squaredNorm() / distance - n.dot(ddy));
  const Matrix3 nn = n * n.transpose();
  const Matrix3 aa = curvature * nn + (slope / distance) * (Matrix3::Identity() - nn) -
                     pull * along * along.transpose();
  const Matrix3 bb = -pull * nn, ba = -pull * n * along.transpose();
  for (int l = 0; l < 8; ++l) {
    const Matrix3 a_side = at.a[l] * aa + at.b[l] * ba.transpose();
    const Matrix3 b_side = at.a[l] * ba + at.b[l] * bb;
    for (int k = 0; k < 8; ++k)
      out.hessian.block<3, 3>(3 * k, 3 * l) = at.a[k] * a_side + at.b[k] * b_side;
  }
  return out;
}

/// Self-contact of the round tube. Samples along every segment are projected on every stretch that
/// they face; all of them with half their weight, as each strand also faces the samples of the
/// other.
class Contact final : public Effect {
 public:
  explicit Contact(const Rod& rod);

  std::string_view name() const override { return "contact"; }
  int stencils() const override { return static_cast<int>(touching_.size()); }
  std::span<const int> coordinates(int i) const override { return touching_[i].coordinates; }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override;
  void refresh(const Vector& x) override;
  void couplings(const std::function<void(std::span<const int>)>& couple) const override;
  double longest_step(const Vector& x, const Vector& dx) const override;

  /// What carries load, and the law it follows.
  const std::vector<ContactPoint>& touching() const { return touching_; }
  const ContactLaw& law() const { return law_; }
  /// To be changed between solves only: it is part of the energy.
  void set_law(const ContactLaw& law) { law_ = law; }

 private:
  void project(const Vector& x, int segment, int sample, const ContactWindow& window);
  ContactPoint point(int segment, double at, const CurveWeights& here, int facing,
                     double facing_at) const;

  int nodes_;
  std::vector<double> arc_;                        ///< undeformed arc length of the nodes
  std::vector<CurveSegment> curve_;                ///< by segment
  std::vector<std::vector<double>> sample_at_;     ///< by segment: arc length from its start
  std::vector<std::vector<CurveWeights>> sample_;  ///< by segment
  ContactLaw law_;

  Vector searched_;                     ///< state for which windows_ were found
  std::vector<ContactWindow> windows_;
  std::vector<Vector3> node_, tangent_;  ///< of the state at hand; tangent: y' at the nodes
  std::vector<ContactPoint> touching_, near_;
};

}  // namespace bight::rod1d
