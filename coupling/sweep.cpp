#include "coupling/sweep.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "coupling/spline.h"

namespace bight::coupling {

namespace {

/// Poisson's ratio of the anticlastic section: the solids that bight makes are near-incompressible.
constexpr double lateral_ratio = 0.5;

/// Smallest rotation that takes one unit tangent to another (no twist about either).
Matrix3 transport(const Vector3& from, const Vector3& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

/// The rod's twist angle at arc length s, between its segments' middles [rad].
double twist_at(const rod1d::RodState& rod, double s) {
  if (rod.twist_angle.empty()) return 0;
  const auto& theta = rod.twist_angle;
  const auto middle = [&](size_t i) { return 0.5 * (rod.s[i] + rod.s[i + 1]); };
  if (s <= middle(0)) return theta.front();
  for (size_t i = 1; i < theta.size(); ++i)
    if (s <= middle(i)) {
      const double t = (s - middle(i - 1)) / (middle(i) - middle(i - 1));
      return (1 - t) * theta[i - 1] + t * theta[i];
    }
  return theta.back();
}

}  // namespace

solid3d::Mesh swept_mesh(const SweepOptions& options, const rod1d::RodState& rod) {
  const solid3d::Section section = solid3d::make_section(options.section_elements);
  const double width =
      std::sqrt(section.area() / static_cast<double>(section.quads.size()));
  // The knot: where the rod is bent or touched. Tails are nearly straight.
  constexpr double bent = 0.02;  // kappa D
  double begin = rod.s.back(), end = 0;
  for (size_t i = 0; i < rod.s.size(); ++i)
    if (rod.curvature[i] > bent) {
      begin = std::min(begin, rod.s[i]);
      end = std::max(end, rod.s[i]);
    }
  return solid3d::make_mesh(
      section, solid3d::graded_layers(rod.s.back(), options.axial_ratio * width,
                                      options.tail_ratio * width, begin - options.knot_margin,
                                      end + options.knot_margin));
}

std::vector<Vector3> sweep(const solid3d::Mesh& mesh, const rod1d::RodState& rod) {
  const Spline curve(rod.s, rod.nodes);
  std::vector<Vector3> nodes;
  nodes.reserve(static_cast<size_t>(mesh.nodes()));
  Vector3 tangent = Vector3::UnitZ();
  Matrix3 frame = Matrix3::Identity();
  for (int k = 0; k < mesh.layers(); ++k) {
    const double s = mesh.s[k];
    const Spline::Point c = curve.at(s);
    const double stretch = c.dr.norm();
    // The grips keep the end sections flat, round and across the pulling axis.
    const bool held = k == 0 || k == mesh.layers() - 1;
    const Vector3 next = held ? Vector3::UnitZ() : Vector3(c.dr / stretch);
    frame = transport(tangent, next) * frame;
    tangent = next;
    const Matrix3 R =
        frame * Eigen::AngleAxisd(twist_at(rod, s), Vector3::UnitZ()).toRotationMatrix();
    // Curvature vector dt/ds in the section's axes, by deformed length.
    const Vector3 bend = (c.ddr - tangent * tangent.dot(c.ddr)) / (stretch * stretch);
    const Vector2 kappa = held ? Vector2::Zero() : Vector2((R.transpose() * bend).head<2>());
    const double lateral = held ? 1.0 : 1 / std::sqrt(stretch);
    for (const Vector2& p : mesh.section.points) {
      // Bending strains the section by nu kappa.p: u = nu ((kappa.p) p - |p|^2 kappa / 2).
      const Vector2 u = lateral_ratio * (kappa.dot(p) * p - 0.5 * p.squaredNorm() * kappa);
      const Vector2 q = lateral * (p + u);
      nodes.push_back(c.r + R * Vector3(q.x(), q.y(), 0));
    }
  }
  return nodes;
}

}  // namespace bight::coupling
