#include "mechanics/knot_type.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <optional>

namespace bight {

namespace {

/// A crossing of the projected curve: curve parameters (segment + fraction) of its two passes.
struct Crossing {
  double over, under;
};

/// The centerline with its ends extended to a distance that dwarfs it, and joined by a far arc.
Polyline close_far_away(const Polyline& centerline) {
  Vector3 low = centerline.front(), high = low;
  for (const Vector3& p : centerline) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double far = 20 * (high - low).norm();
  const size_t n = centerline.size();
  const Vector3 begin = centerline[0] + far * (centerline[0] - centerline[1]).normalized();
  const Vector3 end =
      centerline[n - 1] + far * (centerline[n - 1] - centerline[n - 2]).normalized();
  const Vector3 aside = 2 * far * (end - begin).unitOrthogonal();
  Polyline closed = centerline;
  closed.insert(closed.end(), {end, end + aside, begin + aside, begin});
  return closed;
}

/// Crossings of the closed polygon seen along the third axis; nothing when two segments cross too
/// close to a corner (or in space) for the view to be generic.
std::optional<std::vector<Crossing>> crossings(const Polyline& p) {
  constexpr double margin = 1e-9;
  const int n = static_cast<int>(p.size());
  const auto end_of = [&](int i) -> const Vector3& { return p[(i + 1) % n]; };
  const auto low = [&](int i, int axis) { return std::min(p[i][axis], end_of(i)[axis]); };
  const auto high = [&](int i, int axis) { return std::max(p[i][axis], end_of(i)[axis]); };

  std::vector<int> order(n);
  for (int i = 0; i < n; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](int a, int b) { return low(a, 0) < low(b, 0); });

  std::vector<Crossing> found;
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n && low(order[b], 0) <= high(order[a], 0); ++b) {
      const int i = order[a], j = order[b];
      if (low(i, 1) > high(j, 1) || low(j, 1) > high(i, 1)) continue;
      if ((i + 1) % n == j || (j + 1) % n == i) continue;
      const Vector3 r = end_of(i) - p[i], s = end_of(j) - p[j], d = p[j] - p[i];
      const double area = r.x() * s.y() - r.y() * s.x();
      const double u = (d.x() * s.y() - d.y() * s.x()) / area;
      const double v = (d.x() * r.y() - d.y() * r.x()) / area;
      if (!(std::abs(area) > margin * r.norm() * s.norm())) return std::nullopt;
      if (u < -margin || u > 1 + margin || v < -margin || v > 1 + margin) continue;
      if (u < margin || u > 1 - margin || v < margin || v > 1 - margin) return std::nullopt;
      const double above = p[i].z() + u * r.z() - p[j].z() - v * s.z();
      if (std::abs(above) < margin * (r.norm() + s.norm())) return std::nullopt;
      found.push_back(above > 0 ? Crossing{i + u, j + v} : Crossing{j + v, i + u});
    }
  return found;
}

/// Determinant up to sign of a square matrix of small integers, exact modulo the prime 2^31 - 1.
int determinant(std::vector<std::vector<std::int64_t>> m) {
  constexpr std::int64_t prime = 2147483647;
  const auto power = [](std::int64_t base, std::int64_t exponent) {
    std::int64_t result = 1;
    for (; exponent > 0; exponent >>= 1, base = base * base % prime)
      if (exponent & 1) result = result * base % prime;
    return result;
  };
  std::int64_t result = 1;
  for (size_t k = 0; k < m.size(); ++k) {
    size_t pivot = k;
    while (pivot < m.size() && m[pivot][k] == 0) ++pivot;
    if (pivot == m.size()) return 0;
    std::swap(m[k], m[pivot]);
    result = result * m[k][k] % prime;
    const std::int64_t inverse = power(m[k][k], prime - 2);
    for (size_t i = k + 1; i < m.size(); ++i) {
      if (m[i][k] == 0) continue;
      const std::int64_t factor = prime - m[i][k] * inverse % prime;
      for (size_t j = k; j < m.size(); ++j) m[i][j] = (m[i][j] + factor * m[k][j]) % prime;
    }
  }
  return static_cast<int>(std::min(result, prime - result));
}

/// Minor of the colouring matrix: a row 2 over - under_before - under_after for each crossing
/// (Fox; the Alexander matrix at t = -1).
int determinant_of(const std::vector<Crossing>& found) {
  const int n = static_cast<int>(found.size());
  if (n < 3) return 1;
  std::vector<double> under;
  for (const Crossing& c : found) under.push_back(c.under);
  std::sort(under.begin(), under.end());
  // Arc k runs from the pass under number k - 1 to the one number k.
  const auto arc = [&](double at) {
    return static_cast<int>(std::lower_bound(under.begin(), under.end(), at) - under.begin()) % n;
  };
  constexpr std::int64_t prime = 2147483647;
  std::vector<std::vector<std::int64_t>> m(n - 1, std::vector<std::int64_t>(n, 0));
  for (int row = 0; row + 1 < n; ++row) {
    const int before = arc(found[row].under);
    m[row][arc(found[row].over)] += 2;
    m[row][before] -= 1;
    m[row][(before + 1) % n] -= 1;
  }
  for (auto& row : m) {
    row.pop_back();
    for (auto& entry : row) entry = (entry + prime) % prime;
  }
  return determinant(std::move(m));
}

}  // namespace

int knot_determinant(const Polyline& centerline) {
  const Polyline closed = close_far_away(centerline);
  const Vector3 chord = centerline.back() - centerline.front();
  for (int attempt = 0; attempt < 8; ++attempt) {
    // Seen from the side (few crossings), from an angle that no construction prefers.
    const double angle = 0.7390851 + 1.3247180 * attempt;
    const Eigen::Quaterniond upright =
        Eigen::Quaterniond::FromTwoVectors(chord, Vector3(0.0561, 1, 0.0843));
    const Matrix3 view =
        (Eigen::AngleAxisd(angle, Vector3(0.0417, 1, 0.0229).normalized()) * upright)
            .toRotationMatrix();
    Polyline seen;
    for (const Vector3& p : closed) seen.push_back(view * p);
    if (const auto found = crossings(seen)) return determinant_of(*found);
  }
  return 0;
}

}  // namespace bight
