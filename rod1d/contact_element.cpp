#include "rod1d/contact_element.h"

#include <vector>

#include "rod1d/touching_points.h"

namespace bight::rod1d {

namespace {

using Block = Eigen::Matrix<double, 1, 9>;  ///< a 3 x 3 block, column by column

/// What presses on one point: force and stiffness.
struct PointSums {
  bool touches = false;
  Vector3 force;
  Matrix3 stiffness;

  void add(const Vector3& f, const Matrix3& k) {
    if (!touches) force.setZero(), stiffness.setZero();
    touches = true;
    force += f;
    stiffness += k;
  }
};

/// Sums over the points of one segment, spread over its four nodes by the weights w of each.
struct NodeSums {
  Eigen::Matrix<double, 3, 4> force = Eigen::Matrix<double, 3, 4>::Zero();
  Eigen::Matrix<double, 16, 9> stiffness = Eigen::Matrix<double, 16, 9>::Zero();

  void add(const Eigen::Vector4d& w, const PointSums& sums, Order order) {
    force += sums.force * w.transpose();
    if (order < Order::hessian) return;
    const Eigen::Matrix4d ww = w * w.transpose();
    stiffness += Eigen::Map<const Eigen::Matrix<double, 16, 1>>(ww.data()) *
                 Eigen::Map<const Block>(sums.stiffness.data());
  }
};

}  // namespace

SegmentSamples::SegmentSamples(const CurveSegment& curve, int count, double begin)
    : value(count, 4), arc(count), spacing(curve.length() / count) {
  for (int i = 0; i < count; ++i) {
    const double s = (i + 0.5) * spacing;
    value.row(i) = Eigen::Map<const Eigen::RowVector4d>(curve.weights(s).value.data());
    arc[i] = begin + s;
  }
}

void contact_element(const Eigen::Matrix<double, 24, 1>& x, const SegmentSamples& a,
                     const SegmentSamples& b, std::span<const PointRun> runs, const ContactLaw& law,
                     Order order, ElementSlot& slot) {
  thread_local std::vector<PointSums> on_q;
  const double weight = a.spacing * b.spacing;
  if (order == Order::energy) {
    for_touching(runs, x.data(), a, b, law, [&](int, int, const Vector3&, double distance) {
      slot.energy += weight * law.energy(distance - 1);
    });
    return;
  }

  // Per pair of points: d gap/dp = n, d2 gap/dp dp = (I - n n')/distance, the opposite for q. They
  // are summed by points first, which share their nodes' weights; `across` by the point i on a, by
  // nodes of b (rows) and the entries of a block.
  const int n = b.size();
  if (on_q.size() < static_cast<size_t>(n)) on_q.resize(n);
  for (int j = 0; j < n; ++j) on_q[j].touches = false;
  NodeSums on_a, on_b;
  PointSums on_p;
  Eigen::Matrix<double, 4, 9> across_p;
  Eigen::Matrix<double, 4, 36> across = Eigen::Matrix<double, 4, 36>::Zero();
  int current = -1;
  const auto leave_point = [&] {
    if (current < 0) return;
    const Eigen::Vector4d w = a.value.row(current);
    on_a.add(w, on_p, order);
    if (order == Order::hessian)
      across += w * Eigen::Map<const Eigen::Matrix<double, 1, 36>>(across_p.data());
  };
  for_touching(runs, x.data(), a, b, law, [&](int i, int j, const Vector3& d, double distance) {
    if (i != current) {
      leave_point();
      current = i;
      on_p.touches = false;
      across_p.setZero();
    }
    const double gap = distance - 1;
    slot.energy += weight * law.energy(gap);
    const Vector3 n = d / distance;
    const double slope = weight * law.slope(gap), curvature = weight * law.curvature(gap);
    const Matrix3 m = (curvature - slope / distance) * n * n.transpose() +
                      (slope / distance) * Matrix3::Identity();
    on_p.add(slope * n, m);
    on_q[j].add(-slope * n, m);
    across_p += b.value.row(j).transpose() * Eigen::Map<const Block>(m.data());
  });
  slot.empty = current < 0;
  if (slot.empty) return;
  leave_point();
  for (int j = 0; j < n; ++j)
    if (on_q[j].touches) on_b.add(b.value.row(j).transpose(), on_q[j], order);

  Eigen::Map<Eigen::Matrix<double, 3, 8>> gradient(slot.gradient);
  gradient.leftCols<4>() = on_a.force;
  gradient.rightCols<4>() = on_b.force;
  if (order == Order::gradient) return;
  Eigen::Map<Eigen::Matrix<double, 24, 24>> hessian(slot.hessian);
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < 4; ++l)
      for (int c = 0; c < 9; ++c) {
        const int row = 3 * k + c % 3, column = 3 * l + c / 3;
        hessian(row, column) = on_a.stiffness(4 * l + k, c);
        hessian(12 + row, 12 + column) = on_b.stiffness(4 * l + k, c);
        hessian(row, 12 + column) = hessian(12 + column, row) = -across(k, 4 * c + l);
      }
}

}  // namespace bight::rod1d
