#include "solid3d/two_fold.h"

#include <Eigen/Geometry>
#include <cmath>

namespace bight::solid3d {

namespace {

constexpr double off_axis = 0.05;  ///< least radius of the middle section that names an axis [D]

/// Index of the section's point at `p`, -1 for none.
int point_at(const std::vector<Vector2>& points, const Vector2& p) {
  for (size_t i = 0; i < points.size(); ++i)
    if ((points[i] - p).norm() < 1e-9) return static_cast<int>(i);
  return -1;
}

}  // namespace

std::optional<TwoFold> TwoFold::find(const Mesh& mesh, const std::vector<Vector3>& start,
                                     double tolerance) {
  // The middle layer lies between cells.
  if ((mesh.layers() - 1) % (2 * mesh.degree()) != 0) return std::nullopt;
  const auto centre = [&](int layer) {
    Vector3 mean = Vector3::Zero();
    for (int p = 0; p < mesh.points_per_layer(); ++p)
      mean += start[mesh.node(layer, p)] / mesh.points_per_layer();
    return mean;
  };
  const Vector3 origin = 0.5 * (centre(0) + centre(mesh.layers() - 1));
  const Vector3 radius = centre(mesh.layers() / 2) - origin;
  const bool names_axis = radius.head<2>().norm() > off_axis;
  const double angle = names_axis ? std::atan2(radius.y(), radius.x()) : 0;
  TwoFold symmetry(names_axis ? Kind::half_turn : Kind::inversion, mesh, origin, angle);
  if (!symmetry.fits(mesh, start, tolerance)) return std::nullopt;
  return symmetry;
}

/// Half a turn about x turns a section over, across its own x axis; inversion turns it by half a
/// turn, for the tangent stays.
bool TwoFold::fits(const Mesh& mesh, const std::vector<Vector3>& start, double tolerance) {
  std::vector<int> section;
  for (const Vector2& p : mesh.section.points) {
    const Vector2 image = kind_ == Kind::half_turn ? Vector2(p.x(), -p.y()) : Vector2(-p);
    section.push_back(point_at(mesh.section.points, image));
    if (section.back() < 0) return false;
  }
  for (int n = 0; n < mesh.nodes(); ++n) {
    const int layer = n / mesh.points_per_layer(), point = n % mesh.points_per_layer();
    image_.push_back(mesh.node(mesh.layers() - 1 - layer, section[point]));
  }
  const Matrix3 back = Eigen::AngleAxisd(-angle_, Vector3::UnitZ()).toRotationMatrix();
  const auto in_frame = [&](int node) { return Vector3(back * (start[node] - origin_)); };
  for (int n = 0; n < mesh.nodes(); ++n)
    if (!((signs().cwiseProduct(in_frame(n)) - in_frame(image_[n])).norm() < tolerance))
      return false;
  return true;
}

void TwoFold::constrain(const Mesh& mesh, std::vector<Image>& images,
                        std::vector<bool>& held) const {
  for (int n = mesh.points_per_layer(); n < mesh.node(first_layer_ + 1, 0); ++n)
    for (int c = 0; c < 3; ++c) {
      if (image(n) > n) images[3 * n + c] = {3 * image(n) + c, signs()[c]};
      if (image(n) == n && signs()[c] < 0) held[3 * n + c] = true;
    }
}

void TwoFold::impose(const Mesh& mesh, Vector& x) const {
  for (int n = 0; n < mesh.node(first_layer_ + 1, 0); ++n) {
    if (image(n) < n) continue;
    const Vector3 other = signs().cwiseProduct(x.segment<3>(3 * image(n)));
    for (int c = 0; c < 3; ++c)
      if (image(n) > n)
        x[3 * n + c] = other[c];
      else if (signs()[c] < 0)
        x[3 * n + c] = 0;
  }
}

}  // namespace bight::solid3d
