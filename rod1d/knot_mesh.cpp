#include "rod1d/knot_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "rod1d/curve.h"

namespace bight::rod1d {

namespace {

constexpr double finest = 0.3;          ///< [D]; only the ratios of wished lengths matter
constexpr double at_grips = 0.1;        ///< a gripped segment is straight [D]
constexpr double per_gap = 0.12;        ///< of a segment's length [1]
constexpr double largest_angle = 0.07;  ///< between neighbouring segments [rad]
constexpr double growth = 0.15;         ///< of the length wished for, per arc length [1]
constexpr double came_back = 0.6;       ///< distance over arc length of another strand, at most
constexpr double nearest_on_rod = 1.5;  ///< arc length of points that are no other strand [D]

}  // namespace

std::vector<double> wished_lengths(const std::vector<double>& arc, const Polyline& line) {
  const int n = static_cast<int>(line.size());
  const double far = arc.back() - arc.front();
  Eigen::ArrayXd square = Eigen::ArrayXd::Constant(n, far * far);
  Eigen::ArrayXd x(n), y(n), z(n);
  for (int i = 0; i < n; ++i) x[i] = line[i].x(), y[i] = line[i].y(), z[i] = line[i].z();
  const Eigen::Map<const Eigen::ArrayXd> s(arc.data(), n);
  Eigen::ArrayXd d(n);
  for (int i = 0; i < n; ++i) {
    const auto behind = std::upper_bound(arc.begin() + i, arc.end(), arc[i] + nearest_on_rod);
    const int m = static_cast<int>(arc.end() - behind);
    if (m == 0) continue;
    d.head(m) =
        (x.tail(m) - x[i]).square() + (y.tail(m) - y[i]).square() + (z.tail(m) - z[i]).square();
    d.head(m) = (d.head(m) < came_back * came_back * (s.tail(m) - s[i]).square())
                    .select(d.head(m), far * far);
    square[i] = std::min(square[i], d.head(m).minCoeff());
    square.tail(m) = square.tail(m).min(d.head(m));
  }

  std::vector<double> h(n, finest);
  for (int i = 1; i + 1 < n; ++i) {
    const Vector3 e0 = line[i] - line[i - 1], e1 = line[i + 1] - line[i];
    const double angle = std::atan2(e0.cross(e1).norm(), e0.dot(e1));
    const double kappa = 2 * angle / (e0.norm() + e1.norm());
    h[i] = finest + per_gap * std::max(0.0, std::sqrt(square[i]) - 1);
    h[i] = std::min(h[i], largest_angle / std::max(kappa, 1e-9));
    h[i] = std::max(h[i], finest / 3);
  }
  h.front() = h.back() = at_grips;
  for (int i = 1; i < n; ++i) h[i] = std::min(h[i], h[i - 1] + growth * (arc[i] - arc[i - 1]));
  for (int i = n - 2; i >= 0; --i) h[i] = std::min(h[i], h[i + 1] + growth * (arc[i + 1] - arc[i]));
  return h;
}

std::vector<double> spread_nodes(const std::vector<double>& arc, const std::vector<double>& wished,
                                 int segments, int fixed, double fixed_arc) {
  // Number of wished segments up to each point; between points it is taken as linear.
  std::vector<double> count(1, 0.0);
  for (size_t i = 1; i < arc.size(); ++i)
    count.push_back(count.back() +
                    (arc[i] - arc[i - 1]) * 0.5 * (1 / wished[i] + 1 / wished[i - 1]));
  const auto count_at = [&](double s) {
    const size_t k = static_cast<size_t>(
        std::clamp<long>(std::upper_bound(arc.begin(), arc.end(), s) - arc.begin(), 1,
                         static_cast<long>(arc.size()) - 1));
    return count[k - 1] + (s - arc[k - 1]) / (arc[k] - arc[k - 1]) * (count[k] - count[k - 1]);
  };
  std::vector<double> nodes(static_cast<size_t>(segments) + 1);
  const auto fill = [&](int first, int last, double from, double to) {
    size_t k = 1;
    for (int i = first; i <= last; ++i) {
      const double c = from + (to - from) * (i - first) / (last - first);
      while (k + 1 < count.size() && count[k] < c) ++k;
      nodes[static_cast<size_t>(i)] =
          arc[k - 1] + (arc[k] - arc[k - 1]) * (c - count[k - 1]) / (count[k] - count[k - 1]);
    }
  };
  if (fixed > 0 && fixed < segments) {
    const double middle = count_at(fixed_arc);
    fill(0, fixed, 0, middle);
    fill(fixed, segments, middle, count.back());
    nodes[static_cast<size_t>(fixed)] = fixed_arc;
  } else {
    fill(0, segments, 0, count.back());
  }
  nodes.front() = arc.front();
  nodes.back() = arc.back();
  return nodes;
}

Polyline points_at(const std::vector<double>& arc, const Polyline& line,
                   const std::vector<double>& wanted) {
  const int last = static_cast<int>(arc.size()) - 2;
  const auto length = [&](int k) { return k < 0 || k > last ? 0.0 : arc[k + 1] - arc[k]; };
  Polyline points;
  int k = 0;
  for (const double s : wanted) {
    while (k < last && arc[k + 1] < s) ++k;
    const CurveSegment curve(length(k - 1), length(k), length(k + 1));
    const auto weights = curve.weights(std::clamp(s, arc.front(), arc.back()) - arc[k]).value;
    Vector3 point = Vector3::Zero();
    for (int j = 0; j < 4; ++j)
      point += weights[j] * line[static_cast<size_t>(std::clamp(k - 1 + j, 0, last + 1))];
    points.push_back(point);
  }
  return points;
}

}  // namespace bight::rod1d
