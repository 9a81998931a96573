#include "coupling/spline.h"

#include <algorithm>

namespace bight::coupling {

Spline::Spline(std::vector<double> s, Polyline points)
    : s_(std::move(s)), r_(std::move(points)), second_(r_.size(), Vector3::Zero()) {
  // Continuity of the slope: h0 m0 + 2 (h0 + h1) m1 + h1 m2 = 6 (slope1 - slope0); Thomas
  // algorithm.
  const size_t n = r_.size();
  std::vector<double> diagonal(n, 1.0), upper(n, 0.0);
  for (size_t i = 1; i + 1 < n; ++i) {
    const double h0 = s_[i] - s_[i - 1], h1 = s_[i + 1] - s_[i];
    const Vector3 jump = 6 * ((r_[i + 1] - r_[i]) / h1 - (r_[i] - r_[i - 1]) / h0);
    const double pivot = 2 * (h0 + h1) - h0 * upper[i - 1];
    upper[i] = h1 / pivot;
    second_[i] = (jump - h0 * second_[i - 1]) / pivot;
  }
  for (size_t i = n - 1; i-- > 1;) second_[i] -= upper[i] * second_[i + 1];
}

Spline::Point Spline::at(double s) const {
  const auto after = std::upper_bound(s_.begin() + 1, s_.end() - 1, s);
  const size_t j = static_cast<size_t>(after - s_.begin()), i = j - 1;
  const double h = s_[j] - s_[i], b = (s - s_[i]) / h, a = 1 - b;
  const Vector3 &m0 = second_[i], &m1 = second_[j];
  return {a * r_[i] + b * r_[j] + h * h / 6 * ((a * a * a - a) * m0 + (b * b * b - b) * m1),
          (r_[j] - r_[i]) / h + h / 6 * ((1 - 3 * a * a) * m0 + (3 * b * b - 1) * m1),
          a * m0 + b * m1};
}

}  // namespace bight::coupling
