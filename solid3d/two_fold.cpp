#include "solid3d/two_fold.h"

#include <Eigen/Geometry>
#include <cmath>

namespace bight::solid3d {

namespace {

constexpr double off_axis = 0.05;  ///< least radius of the middle section that names an axis [D]

/// Index of the point that mirrors `p` in the section's x axis, -1 for none.
int mirrored(const std::vector<Vector2>& points, const Vector2& p) {
  for (size_t i = 0; i < points.size(); ++i)
    if ((points[i] - Vector2(p.x(), -p.y())).norm() < 1e-9) return static_cast<int>(i);
  return -1;
}

Vector3 half_turn(const Vector3& r) { return {r.x(), -r.y(), -r.z()}; }

}  // namespace

std::optional<TwoFold> TwoFold::find(const Mesh& mesh, const std::vector<Vector3>& start,
                                     double tolerance) {
  if (mesh.layers() % 2 == 0) return std::nullopt;
  const auto centre = [&](int layer) {
    Vector3 mean = Vector3::Zero();
    for (int p = 0; p < mesh.points_per_layer(); ++p)
      mean += start[mesh.node(layer, p)] / mesh.points_per_layer();
    return mean;
  };
  const Vector3 first = centre(0), last = centre(mesh.layers() - 1);
  TwoFold symmetry;
  symmetry.first_layer_ = mesh.layers() / 2;
  symmetry.origin_ = 0.5 * (first + last);
  const Vector3 radius = centre(symmetry.first_layer_) - symmetry.origin_;
  if (radius.head<2>().norm() < off_axis) return std::nullopt;
  symmetry.angle_ = std::atan2(radius.y(), radius.x());

  std::vector<int> section;
  for (const Vector2& p : mesh.section.points) {
    section.push_back(mirrored(mesh.section.points, p));
    if (section.back() < 0) return std::nullopt;
  }
  for (int n = 0; n < mesh.nodes(); ++n) {
    const int layer = n / mesh.points_per_layer(), point = n % mesh.points_per_layer();
    symmetry.image_.push_back(mesh.node(mesh.layers() - 1 - layer, section[point]));
  }
  const Matrix3 back = Eigen::AngleAxisd(-symmetry.angle_, Vector3::UnitZ()).toRotationMatrix();
  const auto in_frame = [&](int node) { return Vector3(back * (start[node] - symmetry.origin_)); };
  for (int n = 0; n < mesh.nodes(); ++n)
    if (!((half_turn(in_frame(n)) - in_frame(symmetry.image_[n])).norm() < tolerance))
      return std::nullopt;
  return symmetry;
}

void TwoFold::constrain(const Mesh& mesh, std::vector<Image>& images,
                        std::vector<bool>& held) const {
  for (int n = mesh.points_per_layer(); n < mesh.node(first_layer_ + 1, 0); ++n) {
    if (image(n) > n) {
      images[3 * n] = {3 * image(n), 1};
      images[3 * n + 1] = {3 * image(n) + 1, -1};
      images[3 * n + 2] = {3 * image(n) + 2, -1};
    } else if (image(n) == n) {
      held[3 * n + 1] = held[3 * n + 2] = true;
    }
  }
}

void TwoFold::impose(const Mesh& mesh, Vector& x) const {
  for (int n = 0; n < mesh.node(first_layer_ + 1, 0); ++n) {
    const Vector3 other = half_turn(x.segment<3>(3 * image(n)));
    if (image(n) > n)
      x.segment<3>(3 * n) = other;
    else if (image(n) == n)
      x.segment<3>(3 * n) = Vector3(other.x(), 0, 0);
  }
}

}  // namespace bight::solid3d
