#pragma once

#include "rod1d/effects/stencils.h"
#include "rod1d/rod.h"

namespace bight::rod1d {

/// Bending at the node x1 between two segments of a round rod that is straight when free:
///
///   W = 1/2 B/l |kb|^2   [E D^3],   kb = 2 t0 x t1 / (1 + t0 . t1)
///
/// kb is the discrete curvature binormal (Bergou et al., Discrete Elastic Rods, 2008, eq. 1), l
/// half the undeformed length of both segments. A round section bends alike in all directions, so
/// no frame is needed. With q = 1 - t0 . t1 = |t1 - t0|^2/2, which stays exact for a nearly
/// straight rod, |kb|^2 = F(q) = 4 q/(2 - q).
inline Element<9> bend_element(const Eigen::Matrix<double, 9, 1>& x, double B, double l) {
  Element<9> out;
  const Vector3 e0 = x.segment<3>(3) - x.head<3>(), e1 = x.tail<3>() - x.segment<3>(3);
  const double l0 = e0.norm(), l1 = e1.norm();
  const Vector3 t0 = e0 / l0, t1 = e1 / l1;
  const double q = 0.5 * (t1 - t0).squaredNorm(), c = 1 - q;
  if (!(q < 1.9)) {  // folded by more than 154 degrees at one node, or a segment of no length
    out.energy = inadmissible;
    return out;
  }
  const double half = 0.5 * B / l;
  const double dF = 8 / ((2 - q) * (2 - q)), ddF = 2 * dF / (2 - q);
  out.energy = half * 4 * q / (2 - q);

  // dq/de0 = -(t1 - c t0)/l0 = -p0, dq/de1 = -(t0 - c t1)/l1 = -p1
  const Vector3 p0 = (t1 - t0 + q * t0) / l0, p1 = (t0 - t1 + q * t1) / l1;
  const Vector3 g0 = -half * dF * p0, g1 = -half * dF * p1;
  out.gradient.head<3>() = -g0;
  out.gradient.segment<3>(3) = g0 - g1;
  out.gradient.tail<3>() = g1;

  // Minus the second derivatives of q by e0 and e1.
  const Matrix3 P0 = Matrix3::Identity() - t0 * t0.transpose();
  const Matrix3 P1 = Matrix3::Identity() - t1 * t1.transpose();
  const Matrix3 c00 = -(t0 * p0.transpose() + p0 * t0.transpose()) / l0 - c / (l0 * l0) * P0;
  const Matrix3 c11 = -(t1 * p1.transpose() + p1 * t1.transpose()) / l1 - c / (l1 * l1) * P1;
  const Matrix3 c01 = P0 * P1 / (l0 * l1);
  const Matrix3 h00 = half * (ddF * p0 * p0.transpose() - dF * c00);
  const Matrix3 h11 = half * (ddF * p1 * p1.transpose() - dF * c11);
  const Matrix3 h01 = half * (ddF * p0 * p1.transpose() - dF * c01);
  const Matrix3 h10 = h01.transpose();
  const auto block = [&](int row, int column) {
    return out.hessian.block<3, 3>(3 * row, 3 * column);
  };
  block(0, 0) = h00, block(0, 1) = h01 - h00, block(0, 2) = -h01;
  block(1, 0) = h10 - h00, block(1, 1) = h00 - h01 - h10 + h11, block(1, 2) = h01 - h11;
  block(2, 0) = -h10, block(2, 1) = h10 - h11, block(2, 2) = h11;
  return out;
}

class Bend final : public Effect {
 public:
  explicit Bend(const Rod& rod) : rod_(rod) {
    for (int i = 1; i + 1 < rod.nodes(); ++i) {
      std::array<int, 9> c;
      for (int k = 0; k < 9; ++k) c[k] = Rod::position(i - 1) + k;
      stencils_.add(c);
    }
  }
  std::string_view name() const override { return "bend"; }
  int stencils() const override { return stencils_.size(); }
  std::span<const int> coordinates(int i) const override { return stencils_[i]; }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override {
    slot.set(
        bend_element(stencils_.gather(x, i), rod_.bending_stiffness, rod_.voronoi_length(i + 1)),
        order);
  }

 private:
  Rod rod_;
  Stencils<9> stencils_;
};

}  // namespace bight::rod1d
