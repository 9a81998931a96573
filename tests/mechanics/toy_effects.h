#pragma once

#include <array>
#include <vector>

#include "mechanics/assemble.h"

namespace bight::test {

/// Springs between points, W = k/4 (|d|^2 - l^2)^2: a smooth energy with an easy Hessian,
/// indefinite where a spring is short.
class Springs final : public Effect {
 public:
  struct Spring {
    int a, b;  ///< first coordinates of two points
    double k, l;
  };
  explicit Springs(std::vector<Spring> springs) : springs_(std::move(springs)) {
    for (const Spring& s : springs_)
      coordinates_.push_back({s.a, s.a + 1, s.a + 2, s.b, s.b + 1, s.b + 2});
  }
  std::string_view name() const override { return "springs"; }
  int stencils() const override { return static_cast<int>(springs_.size()); }
  std::span<const int> coordinates(int i) const override { return coordinates_[i]; }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override {
    const auto& [a, b, k, l] = springs_[i];
    const Vector3 d = x.segment<3>(b) - x.segment<3>(a);
    const double excess = d.squaredNorm() - l * l;
    Element<6> out;
    out.energy = 0.25 * k * excess * excess;
    out.gradient.head<3>() = -k * excess * d;
    out.gradient.tail<3>() = k * excess * d;
    const Matrix3 h = k * (excess * Matrix3::Identity() + 2 * d * d.transpose());
    out.hessian.topLeftCorner<3, 3>() = out.hessian.bottomRightCorner<3, 3>() = h;
    out.hessian.topRightCorner<3, 3>() = out.hessian.bottomLeftCorner<3, 3>() = -h;
    slot.set(out, order);
  }

 private:
  std::vector<Spring> springs_;
  std::vector<std::array<int, 6>> coordinates_;
};

inline Eigen::MatrixXd dense(const SymmetricMatrix& m) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(m.size(), m.size());
  for (int j = 0; j < m.size(); ++j)
    for (int at = m.column_start[j]; at < m.column_start[j + 1]; ++at)
      if (m.row[at] >= j) out(m.row[at], j) = out(j, m.row[at]) = m.value[at];
  return out;
}

}  // namespace bight::test
