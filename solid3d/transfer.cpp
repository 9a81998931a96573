#include "solid3d/transfer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace bight::solid3d {

namespace {

/// A point of a section as a mean of the corners of one of its cells.
struct InCell {
  std::array<int, 4> corners;
  std::array<double, 4> weights;
};

std::array<double, 4> bilinear(const Vector2& xi) {
  return {0.25 * (1 - xi.x()) * (1 - xi.y()), 0.25 * (1 + xi.x()) * (1 - xi.y()),
          0.25 * (1 + xi.x()) * (1 + xi.y()), 0.25 * (1 - xi.x()) * (1 + xi.y())};
}

/// Local coordinates of p in a cell, [-1, 1]^2 inside: Newton's method. Nothing where p is so far
/// outside that it has none.
std::optional<Vector2> local(const Section& section, const std::array<int, 4>& quad,
                             const Vector2& p) {
  std::array<Vector2, 4> a;
  for (int i = 0; i < 4; ++i) a[i] = section.points[quad[i]];
  Vector2 xi = Vector2::Zero();
  for (int iteration = 0; iteration < 20; ++iteration) {
    const auto w = bilinear(xi);
    const Vector2 off = w[0] * a[0] + w[1] * a[1] + w[2] * a[2] + w[3] * a[3] - p;
    Eigen::Matrix2d J;
    J.col(0) = 0.25 * ((1 - xi.y()) * (a[1] - a[0]) + (1 + xi.y()) * (a[2] - a[3]));
    J.col(1) = 0.25 * ((1 - xi.x()) * (a[3] - a[0]) + (1 + xi.x()) * (a[2] - a[1]));
    const Vector2 step = J.inverse() * off;
    xi -= step;
    if (!(step.norm() < 10)) break;
    if (off.norm() < 1e-13) return xi;
  }
  return std::nullopt;
}

/// The cell that p lies in, or least outside of.
InCell locate(const Section& section, const Vector2& p) {
  InCell best;
  double least = std::numeric_limits<double>::max();
  for (const auto& quad : section.quads) {
    const auto xi = local(section, quad, p);
    if (!xi) continue;
    const double outside = std::max(0.0, xi->cwiseAbs().maxCoeff() - 1);
    if (outside < least) least = outside, best = {quad, bilinear(*xi)};
  }
  return best;
}

/// Four layers around s and their weights in Lagrange's cubic there.
struct Along {
  int first;
  std::array<double, 4> weights;
};

Along along(const std::vector<double>& s, double at) {
  const int above = static_cast<int>(std::upper_bound(s.begin(), s.end(), at) - s.begin());
  Along result{std::clamp(above - 2, 0, static_cast<int>(s.size()) - 4), {1, 1, 1, 1}};
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k)
      if (k != i)
        result.weights[i] *=
            (at - s[result.first + k]) / (s[result.first + i] - s[result.first + k]);
  return result;
}

}  // namespace

std::vector<Vector3> transferred(const Mesh& from, const std::vector<Vector3>& nodes,
                                 const Mesh& to) {
  std::vector<InCell> in_section;
  for (const Vector2& p : to.section.points) in_section.push_back(locate(from.section, p));
  std::vector<Vector3> result;
  result.reserve(static_cast<size_t>(to.nodes()));
  for (const double s : to.s) {
    const Along layers = along(from.s, s);
    for (const InCell& cell : in_section) {
      Vector3 sum = Vector3::Zero();
      for (int i = 0; i < 4; ++i)
        for (int c = 0; c < 4; ++c)
          sum += layers.weights[i] * cell.weights[c] *
                 nodes[from.node(layers.first + i, cell.corners[c]) - from.first_node];
      result.push_back(sum);
    }
  }
  return result;
}

}  // namespace bight::solid3d
