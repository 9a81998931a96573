#pragma once

#include <array>

#include "rod1d/rod.h"

namespace bight::rod1d {

/// Weights of four nodes in a point of the centerline and in its derivatives by arc length.
struct CurveWeights {
  std::array<double, 4> value, first, second;
};

/// The centerline between two nodes as part of a curve that passes through all nodes and is C2 in
/// undeformed arc length s, so that contact is smooth in arc length and has a continuous Hessian:
///
///   y(s) = x1 (1 - u) + x2 u + s (s - b) [(1 - w) D1 + w D2],  u = s/b,  w = u^2 (3 - 2 u)
///
/// D1, D2: second divided differences at the two nodes (half the curvature vector). That is two
/// parabolas blended (Overhauser, 1968), with a smooth step in place of his linear blend, which
/// would be C1 only. The error of position is O(h^3), the stencil the four nodes around.
class CurveSegment {
 public:
  /// `a`, `b`, `c`: undeformed lengths of the segment before, this one, and the one behind; zero
  /// for a neighbour that does not exist (there the curvature is zero).
  CurveSegment(double a, double b, double c) : length_(b) {
    if (a > 0) difference1_ = {1 / (a * (a + b)), -1 / (a * b), 1 / (b * (a + b))};
    if (c > 0) difference2_ = {1 / (b * (b + c)), -1 / (b * c), 1 / (c * (b + c))};
  }

  double length() const { return length_; }

  CurveWeights weights(double s) const {
    const double b = length_, u = s / b;
    const double q = s * (s - b), dq = 2 * s - b, ddq = 2;
    const double w = u * u * (3 - 2 * u), dw = 6 * u * (1 - u) / b, ddw = (6 - 12 * u) / (b * b);
    const double value2 = q * w, value1 = q - value2;
    const double first2 = dq * w + q * dw, first1 = dq - first2;
    const double second2 = ddq * w + 2 * dq * dw + q * ddw, second1 = ddq - second2;
    CurveWeights out{{0, 1 - u, u, 0}, {0, -1 / b, 1 / b, 0}, {0, 0, 0, 0}};
    for (int k = 0; k < 3; ++k) {
      out.value[k] += value1 * difference1_[k];
      out.value[k + 1] += value2 * difference2_[k];
      out.first[k] += first1 * difference1_[k];
      out.first[k + 1] += first2 * difference2_[k];
      out.second[k] += second1 * difference1_[k];
      out.second[k + 1] += second2 * difference2_[k];
    }
    return out;
  }

 private:
  double length_;
  std::array<double, 3> difference1_{}, difference2_{};
};

/// Segment i of a centerline whose segments have these undeformed lengths.
inline CurveSegment curve_segment(const std::vector<double>& lengths, int i) {
  const auto length = [&](int k) {
    return k < 0 || k >= static_cast<int>(lengths.size()) ? 0.0 : lengths[k];
  };
  return CurveSegment(length(i - 1), length(i), length(i + 1));
}

}  // namespace bight::rod1d
