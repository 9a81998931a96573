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

/// The grips keep the end sections flat, round and across the pulling axis.
bool is_held(const solid3d::Mesh& mesh, int layer) {
  return layer == 0 || layer == mesh.layers() - 1;
}

/// Section axes (third: tangent), transported along the centerline from the start, and twisted.
std::vector<Matrix3> section_frames(const solid3d::Mesh& mesh, const rod1d::RodState& rod,
                                    const Spline& curve) {
  std::vector<Matrix3> frames;
  Matrix3 frame = Matrix3::Identity();
  for (int k = 0; k < mesh.layers(); ++k) {
    const Vector3 next =
        is_held(mesh, k) ? Vector3(Vector3::UnitZ()) : Vector3(curve.at(mesh.s[k]).dr.normalized());
    frame = transport(frame.col(2), next) * frame;
    frames.push_back(
        frame * Eigen::AngleAxisd(twist_at(rod, mesh.s[k]), Vector3::UnitZ()).toRotationMatrix());
  }
  return frames;
}

/// The roll of all sections that turns the x axis of the middle one towards the pulling axis. The
/// round rod does not mind; a knot with a two-fold axis there keeps its symmetry in the mesh.
double roll_of_middle(const solid3d::Mesh& mesh, const std::vector<Matrix3>& frames,
                      const Spline& curve) {
  const int middle = mesh.layers() / 2;
  Vector3 inwards = curve.at(0).r - curve.at(mesh.s[middle]).r;
  inwards.z() = 0;
  const Vector3 local = frames[middle].transpose() * inwards;
  return local.head<2>().norm() < 1e-6 ? 0.0 : std::atan2(local.y(), local.x());
}

}  // namespace

solid3d::Mesh swept_mesh(const SweepOptions& options, const rod1d::RodState& rod) {
  const solid3d::Section section = solid3d::make_section(options.section_elements, options.degree);
  const double width = section.cell_width();
  // The knot: where kappa D is above most_bent, or above a part of the largest one. That covers
  // all contact, and more. What bends less stores 1 % of the knot's energy by length; there cells
  // of length h are too stiff by 4/9 (h/D)^2: they shear by kappa z, |z| < h/2, with G = E/3.
  constexpr double most_bent = 0.06, part = 0.1;
  const double bent =
      std::min(most_bent, part * *std::max_element(rod.curvature.begin(), rod.curvature.end()));
  double begin = rod.s.back(), end = 0;
  for (size_t i = 0; i < rod.s.size(); ++i)
    if (rod.curvature[i] > bent) {
      begin = std::min(begin, rod.s[i]);
      end = std::max(end, rod.s[i]);
    }
  // Equal tails, so that a knot tied in the middle keeps its symmetry in the mesh. Layers in the
  // knot lie where those of a mesh without tails do: how far they reach makes no difference to
  // contact.
  const double half = 0.5 * rod.s.back();
  const double fine = half / std::ceil(half / (options.axial_ratio * width));
  const double reach =
      half - std::min(begin, rod.s.back() - end) + options.knot_margin + 0.5 * options.loosened_by;
  const double covered = std::min(half, fine * std::ceil(reach / fine));
  // A grip holds its section round: with long cells there a rod stretched by a quarter is too
  // stiff.
  return solid3d::make_mesh(
      section, solid3d::graded_layers(rod.s.back(), fine, options.tail_ratio * width,
                                      half - covered, half + covered, solid3d::TailEnds::fine));
}

std::vector<Vector3> sweep(const solid3d::Mesh& mesh, const rod1d::RodState& rod) {
  const Spline curve(rod.s, rod.nodes);
  const std::vector<Matrix3> frames = section_frames(mesh, rod, curve);
  const double roll = roll_of_middle(mesh, frames, curve);
  std::vector<Vector3> nodes;
  nodes.reserve(static_cast<size_t>(mesh.nodes()));
  for (int k = 0; k < mesh.layers(); ++k) {
    const Spline::Point c = curve.at(mesh.s[k]);
    const Matrix3 R = frames[k] * Eigen::AngleAxisd(roll, Vector3::UnitZ()).toRotationMatrix();
    const double stretch = c.dr.norm();
    // Curvature vector dt/ds in the section's axes, by deformed length.
    const bool held = is_held(mesh, k);
    const Vector3 tangent = R.col(2);
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
