#pragma once

#include "rod1d/effects/bend.h"
#include "rod1d/frames.h"
#include "rod1d/jet.h"
#include "rod1d/two_tangents.h"

namespace bight::rod1d {

/// What bending at one node of a naturally curved rod needs to know besides the state.
struct NaturalBendNode {
  double B = 0;                   ///< bending stiffness [E D^4]
  double length = 1;              ///< that the node stands for [D]
  Vector2 rest;                   ///< curvature about d1 and d2 when free, times length [rad]
  Vector3 tangent[2], normal[2];  ///< of the two segments at the source
};

/// kb . (k1 d1 + k2 d2) in the material frame of the segment before (side 0) or behind (side 1),
/// by t0, t1, and the segment's angle. With c = k1 d1 + k2 d2 turned by the angle in the source
/// frame s, carried to t: c - (c . t)/(1 + s . t) (s + t), and kb = 2 t0 x t1/(1 + t0 . t1).
inline Jet<7> natural_curvature_product(const TwoTangents& tangents, double angle,
                                        const NaturalBendNode& node, int side) {
  using J = Jet<7>;
  using JetVector = std::array<J, 3>;
  const auto dot = [](const JetVector& a, const auto& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  JetVector t[2];
  for (int c = 0; c < 3; ++c) {
    t[0][c] = J::variable(tangents.t0[c], c);
    t[1][c] = J::variable(tangents.t1[c], 3 + c);
  }
  const J turn = J::variable(angle, 6);
  const J cosine = J::compose(turn, std::cos(angle), -std::sin(angle), -std::cos(angle));
  const J sine = J::compose(turn, std::sin(angle), std::cos(angle), -std::sin(angle));
  const Vector3 &s = node.tangent[side], &d1 = node.normal[side];
  const Vector3 d2 = s.cross(d1);
  JetVector c;
  for (int k = 0; k < 3; ++k)
    c[k] = cosine * (node.rest[0] * d1[k] + node.rest[1] * d2[k]) +
           sine * (node.rest[0] * d2[k] - node.rest[1] * d1[k]);
  const JetVector cross{t[0][1] * t[1][2] - t[0][2] * t[1][1],
                        t[0][2] * t[1][0] - t[0][0] * t[1][2],
                        t[0][0] * t[1][1] - t[0][1] * t[1][0]};
  // kb is perpendicular to t.
  const J carried = dot(cross, c) - dot(t[side], c) / (dot(t[side], s) + 1.0) * dot(cross, s);
  return carried * 2.0 / (dot(t[0], t[1]) + 1.0);
}

/// Bending at the node x1 of a rod with the natural curvature k = (k1, k2) in its material frames:
///
///   W = 1/2 B/l (|kappa_0 - k|^2 + |kappa_1 - k|^2)/2   [E D^3]
///
/// kappa_j: components of kb along d1 and d2 of the segment before and behind (Bergou et al. 2008,
/// eq. 1 and 2). As |kappa_j| = |kb|, this is the element of the straight rod and a product that is
/// linear in k. Coordinates: x0, x1, x2 and the angles of the two segments.
inline Element<11> natural_bend_element(const Eigen::Matrix<double, 11, 1>& x,
                                        const NaturalBendNode& node) {
  Element<11> out;
  const Element<9> straight = bend_element(x.head<9>(), node.B, node.length);
  const TwoTangents tangents(x.head<9>());
  if (!(straight.energy < inadmissible && tangents.t0.dot(node.tangent[0]) > -0.9 &&
        tangents.t1.dot(node.tangent[1]) > -0.9)) {
    out.energy = inadmissible;
    return out;
  }
  const double stiffness = node.B / node.length;
  out.energy = straight.energy + 0.5 * stiffness * node.rest.squaredNorm();
  out.gradient.head<9>() = straight.gradient;
  out.hessian.topLeftCorner<9, 9>() = straight.hessian;
  const Eigen::Matrix<double, 6, 9> J = tangents.derivative();
  for (const int side : {0, 1}) {
    const Jet<7> product =
        natural_curvature_product(tangents, x[9 + side], node, side) * (-0.5 * stiffness);
    const Eigen::Matrix<double, 6, 1> g = product.gradient.head<6>();
    const Eigen::Matrix<double, 9, 1> mixed = J.transpose() * product.hessian.col(6).head<6>();
    out.energy += product.value;
    out.gradient.head<9>() += J.transpose() * g;
    out.gradient[9 + side] += product.gradient[6];
    out.hessian.topLeftCorner<9, 9>() +=
        J.transpose() * product.hessian.topLeftCorner<6, 6>() * J + tangents.second(g);
    out.hessian.col(9 + side).head<9>() += mixed;
    out.hessian.row(9 + side).head<9>() += mixed.transpose();
    out.hessian(9 + side, 9 + side) += product.hessian(6, 6);
  }
  return out;
}

/// Bending of a rod that is curved when free. `source` is read at every evaluation.
class NaturalBend final : public Effect {
 public:
  NaturalBend(const Rod& rod, const Frames& source) : rod_(rod), source_(source) {
    for (int i = 1; i + 1 < rod.nodes(); ++i) {
      std::array<int, 11> c;
      for (int k = 0; k < 9; ++k) c[k] = Rod::position(i - 1) + k;
      c[9] = rod.angle(i - 1), c[10] = rod.angle(i);
      stencils_.add(c);
    }
  }
  std::string_view name() const override { return "bend"; }
  int stencils() const override { return stencils_.size(); }
  std::span<const int> coordinates(int i) const override { return stencils_[i]; }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override {
    const NaturalBendNode node{rod_.bending_stiffness,
                               rod_.voronoi_length(i + 1),
                               rod_.rest_curvature[i + 1],
                               {source_.tangent[i], source_.tangent[i + 1]},
                               {source_.normal[i], source_.normal[i + 1]}};
    slot.set(natural_bend_element(stencils_.gather(x, i), node), order);
  }

 private:
  Rod rod_;
  const Frames& source_;
  Stencils<11> stencils_;
};

}  // namespace bight::rod1d
