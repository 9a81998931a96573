#pragma once

#include "rod1d/effects/stencils.h"
#include "rod1d/frames.h"
#include "rod1d/solid_angle.h"
#include "rod1d/two_tangents.h"

namespace bight::rod1d {

/// What twisting at one node needs to know besides the state.
struct TwistNode {
  double C = 0;                ///< twisting stiffness [E D^4]
  double length = 1;           ///< that the node stands for [D]
  double rest = 0;             ///< m0 [rad]
  double source = 0;           ///< twist of the reference frames at the source [rad]
  Vector3 tangent0, tangent1;  ///< of the two segments at the source
};

/// Twisting at the node x1 between two segments with the angles a0, a1:
///
///   W = 1/2 C/l (m - m0)^2   [E D^3],   m = a1 - a0 + m_source - A(s0, t0, t1, s1)
///
/// (Bergou et al. 2010, sec. 4.2.) A is the area on the sphere of tangents between those of the
/// source, s, and the current ones, t: the twist that carrying both reference frames along takes
/// away. It vanishes to first order with the gradient (kb/2)/|e| of Bergou's eq. 9, but holds for
/// finite turns too, so W is a potential with a symmetric Hessian. Coordinates: x0, x1, x2, a0, a1.
inline Element<11> twist_element(const Eigen::Matrix<double, 11, 1>& x, const TwistNode& node) {
  Element<11> out;
  const TwoTangents tangents(x.head<9>());
  const Vector3 &t0 = tangents.t0, &t1 = tangents.t1;
  // Carrying is not defined for a tangent that was turned around.
  if (!(t0.dot(node.tangent0) > -0.9 && t1.dot(node.tangent1) > -0.9 && t0.dot(t1) > -0.9)) {
    out.energy = inadmissible;
    return out;
  }
  const SolidAngle first(node.tangent0, t0, t1), second(node.tangent0, t1, node.tangent1);
  Eigen::Matrix<double, 6, 1> g = -first.gradient;
  g.tail<3>() -= second.gradient.head<3>();
  Eigen::Matrix<double, 6, 6> H = -first.hessian;
  H.bottomRightCorner<3, 3>() -= second.hessian.topLeftCorner<3, 3>();

  const double m = x[10] - x[9] + node.source - first.value - second.value;
  const double stiffness = node.C / node.length, moment = stiffness * (m - node.rest);
  out.energy = 0.5 * moment * (m - node.rest);
  const Eigen::Matrix<double, 6, 9> J = tangents.derivative();
  Eigen::Matrix<double, 11, 1> dm;
  dm << J.transpose() * g, -1, 1;
  out.gradient = moment * dm;
  out.hessian = stiffness * dm * dm.transpose();
  out.hessian.topLeftCorner<9, 9>() += moment * (J.transpose() * H * J + tangents.second(g));
  return out;
}

/// Twisting of the rod. `source` is read at every evaluation; it may change between solves.
class Twist final : public Effect {
 public:
  Twist(const Rod& rod, const Frames& source) : rod_(rod), source_(source) {
    for (int i = 1; i + 1 < rod.nodes(); ++i) {
      std::array<int, 11> c;
      for (int k = 0; k < 9; ++k) c[k] = Rod::position(i - 1) + k;
      c[9] = rod.angle(i - 1), c[10] = rod.angle(i);
      stencils_.add(c);
    }
  }
  std::string_view name() const override { return "twist"; }
  int stencils() const override { return stencils_.size(); }
  std::span<const int> coordinates(int i) const override { return stencils_[i]; }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override {
    const int node = i + 1;
    slot.set(
        twist_element(stencils_.gather(x, i),
                      {rod_.twisting_stiffness, rod_.voronoi_length(node), rod_.natural_twist(node),
                       source_.twist[node], source_.tangent[i], source_.tangent[i + 1]}),
        order);
  }

 private:
  Rod rod_;
  const Frames& source_;
  Stencils<11> stencils_;
};

}  // namespace bight::rod1d
