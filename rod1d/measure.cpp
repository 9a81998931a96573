#include "rod1d/measure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace bight::rod1d {

Polyline nodes_of(const Rod& rod, const Vector& x) {
  Polyline nodes;
  for (int i = 0; i < rod.nodes(); ++i) nodes.push_back(x.segment<3>(Rod::position(i)));
  return nodes;
}

std::vector<double> curvature(const Rod& rod, const Vector& x) {
  const Polyline p = nodes_of(rod, x);
  std::vector<double> kappa(p.size(), 0.0);
  for (size_t i = 1; i + 1 < p.size(); ++i) {
    const Vector3 t0 = (p[i] - p[i - 1]).normalized(), t1 = (p[i + 1] - p[i]).normalized();
    kappa[i] = 2 * t0.cross(t1).norm() / (1 + t0.dot(t1)) / rod.voronoi_length(static_cast<int>(i));
  }
  return kappa;
}

std::vector<double> stretch(const Rod& rod, const Vector& x) {
  std::vector<double> ratio;
  for (int i = 0; i < rod.segments(); ++i)
    ratio.push_back((x.segment<3>(Rod::position(i + 1)) - x.segment<3>(Rod::position(i))).norm() /
                    rod.rest_length[i]);
  return ratio;
}

std::vector<double> twist_rate(const Rod& rod, const std::vector<double>& twist_angle) {
  std::vector<double> rate(rod.nodes(), 0.0);
  for (int i = 1; i < rod.segments(); ++i)
    rate[i] = (twist_angle[i] - twist_angle[i - 1]) / rod.voronoi_length(i);
  return rate;
}

std::vector<double> contact_force(const Rod& rod, const std::vector<ContactPoint>& points) {
  std::vector<double> force(rod.nodes(), 0.0);
  const auto share = [&](int segment, double u, double size) {
    force[segment] += (1 - u) * size;
    force[segment + 1] += u * size;
  };
  for (const ContactPoint& at : points) {
    share(at.segment_a, at.u_a, at.force);
    share(at.segment_b, at.u_b, at.force);
  }
  for (int i = 0; i < rod.nodes(); ++i) {
    const double before = i > 0 ? rod.rest_length[i - 1] : 0;
    const double behind = i < rod.segments() ? rod.rest_length[i] : 0;
    force[i] /= 0.5 * (before + behind);
  }
  return force;
}

namespace {

/// Solid angle over 4 pi that segment 3-4 spans on segment 1-2, with its sign.
double gauss_exact(const Vector3& p1, const Vector3& p2, const Vector3& p3, const Vector3& p4) {
  const Vector3 r13 = p3 - p1, r14 = p4 - p1, r23 = p3 - p2, r24 = p4 - p2;
  const Vector3 across = (p4 - p3).cross(p2 - p1);
  const double volume = across.dot(r13);
  // In one plane, as in a straight tail: no solid angle, and normals that are round-off.
  if (std::abs(volume) < 1e-12 * (p4 - p3).norm() * (p2 - p1).norm() * r13.norm()) return 0;
  const Vector3 n[4] = {r13.cross(r14).stableNormalized(), r14.cross(r24).stableNormalized(),
                        r24.cross(r23).stableNormalized(), r23.cross(r13).stableNormalized()};
  double angle = 0;
  for (int k = 0; k < 4; ++k) angle += std::asin(std::clamp(n[k].dot(n[(k + 1) % 4]), -1.0, 1.0));
  return volume > 0 ? angle : -angle;
}

}  // namespace

double writhe(const Polyline& line) {
  constexpr double far =
      6;  // midpoints in lengths of the longer segment: error of the midpoint rule < 1 %
  double sum = 0;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const Vector3 e = line[i + 1] - line[i], middle = 0.5 * (line[i + 1] + line[i]);
    const double size = e.squaredNorm();
    for (size_t j = i + 2; j + 1 < line.size(); ++j) {
      const Vector3 f = line[j + 1] - line[j], r = 0.5 * (line[j + 1] + line[j]) - middle;
      const double square = r.squaredNorm();
      if (square > far * far * std::max(size, f.squaredNorm()))
        sum -= e.cross(f).dot(r) / (square * std::sqrt(square));
      else
        sum += gauss_exact(line[i], line[i + 1], line[j], line[j + 1]);
    }
  }
  // Every pair counts twice in the double integral over 4 pi.
  return sum / (2 * std::numbers::pi);
}

}  // namespace bight::rod1d
