#include "solid3d/two_fold.h"

namespace bight::solid3d {

namespace {

/// Half a turn about a horizontal line.
struct HalfTurn {
  Vector3 point, direction;
  HalfTurn(const Vector3& middle, const Vector3& pulling_axis)
      : point(pulling_axis.x(), pulling_axis.y(), middle.z()),
        direction((middle - point).normalized()) {}
  Vector3 operator()(const Vector3& y) const {
    const Vector3 r = y - point;
    return point + 2 * direction.dot(r) * direction - r;
  }
};

/// Index of the point that mirrors `p` in the section's x axis, -1 for none.
int mirrored(const std::vector<Vector2>& points, const Vector2& p) {
  for (size_t i = 0; i < points.size(); ++i)
    if ((points[i] - Vector2(p.x(), -p.y())).norm() < 1e-9) return static_cast<int>(i);
  return -1;
}

}  // namespace

std::optional<TwoFold> TwoFold::find(const Mesh& mesh, const std::vector<Vector3>& start,
                                     double tolerance) {
  const int layers = mesh.layers();
  if (layers % 2 == 0 || mesh.section.centre.size() != 1) return std::nullopt;
  std::vector<Vector2> middles;
  for (const auto& q : mesh.section.quads) {
    Vector2 sum = Vector2::Zero();
    for (int p : q) sum += mesh.section.points[p] / 4;
    middles.push_back(sum);
  }
  TwoFold symmetry;
  symmetry.middle_ = mesh.node(layers / 2, mesh.section.centre[0]);
  for (int k = 0; k < layers; ++k)
    for (const Vector2& p : mesh.section.points) {
      const int image = mirrored(mesh.section.points, p);
      if (image < 0) return std::nullopt;
      symmetry.node_.push_back(mesh.node(layers - 1 - k, image));
    }
  const int quads = static_cast<int>(middles.size());
  for (int k = 0; k + 1 < layers; ++k)
    for (const Vector2& middle : middles) {
      const int image = mirrored(middles, middle);
      if (image < 0) return std::nullopt;
      symmetry.cell_.push_back((layers - 2 - k) * quads + image);
    }
  symmetry.start_ = mesh.node(0, mesh.section.centre[0]);
  const HalfTurn turn(start[symmetry.middle_], start[symmetry.start_]);
  for (size_t n = 0; n < start.size(); ++n)
    if (!((turn(start[n]) - start[symmetry.node_[n]]).norm() < tolerance)) return std::nullopt;
  return symmetry;
}

void TwoFold::impose(Vector& x, int internal_begin) const {
  const HalfTurn turn(x.segment<3>(3 * middle_), x.segment<3>(3 * start_));
  const Vector old = x;
  for (size_t n = 0; n < node_.size(); ++n)
    x.segment<3>(3 * static_cast<Eigen::Index>(n)) =
        0.5 *
        (old.segment<3>(3 * static_cast<Eigen::Index>(n)) + turn(old.segment<3>(3 * node_[n])));
  for (size_t c = 0; c < cell_.size(); ++c)
    x.segment<2>(internal_begin + 2 * static_cast<Eigen::Index>(c)) =
        0.5 * (old.segment<2>(internal_begin + 2 * static_cast<Eigen::Index>(c)) +
               old.segment<2>(internal_begin + 2 * cell_[c]));
}

}  // namespace bight::solid3d
