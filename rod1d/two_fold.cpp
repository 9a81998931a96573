#include "rod1d/two_fold.h"

#include <Eigen/Geometry>
#include <cmath>

#include "rod1d/polyline.h"
#include "rod1d/rod.h"

namespace bight::rod1d {

namespace {

constexpr double off_axis = 0.05;   ///< least radius of the middle point that names an axis [D]
constexpr int compared = 400;       ///< points of a start that are compared with their images
constexpr double same_arc = 1e-12;  ///< of two arc lengths, in parts of the length

Vector3 half_turn(const Vector3& r) { return {r.x(), -r.y(), -r.z()}; }

}  // namespace

std::optional<Polyline> TwoFold::aligned(const Polyline& start, double tolerance) {
  const Polyline points = resampled(start, compared);
  const Vector3& middle = points[compared / 2];
  if (middle.head<2>().norm() < off_axis) return std::nullopt;
  const Matrix3 turn =
      Eigen::AngleAxisd(-std::atan2(middle.y(), middle.x()), Vector3::UnitZ()).toRotationMatrix();
  for (int i = 0; i <= compared / 2; ++i)
    if (!((half_turn(turn * points[i]) - turn * points[compared - i]).norm() < tolerance))
      return std::nullopt;
  Polyline out;
  for (const Vector3& p : start) out.push_back(turn * p);
  return out;
}

std::vector<Image> TwoFold::images(bool twist) const {
  const int nodes = last_ + 1;
  std::vector<Image> list(3 * nodes + (twist ? last_ : 0));
  for (int i = last_ / 2 + 1; i <= last_; ++i) {
    const int source = Rod::position(last_ - i), image = Rod::position(i);
    list[image] = {source, 1};
    list[image + 1] = {source + 1, -1};
    list[image + 2] = {source + 2, -1};
  }
  if (twist)
    for (int j = last_ / 2; j < last_; ++j) list[3 * nodes + j] = {3 * nodes + last_ - 1 - j, -1};
  return list;
}

void TwoFold::hold_middle(std::vector<bool>& held) const {
  const int middle = Rod::position(last_ / 2);
  held[middle + 1] = held[middle + 2] = true;
}

void TwoFold::impose(std::vector<double>& arc) const {
  const double length = arc.back();
  for (int i = 0; i <= last_ / 2; ++i) {
    arc[i] = 0.5 * (arc[i] + length - arc[last_ - i]);
    arc[last_ - i] = length - arc[i];
  }
}

void TwoFold::impose(Vector& x) const {
  for (int i = 0; i < last_ / 2; ++i)
    x.segment<3>(Rod::position(last_ - i)) = half_turn(x.segment<3>(Rod::position(i)));
  x.segment<2>(Rod::position(last_ / 2) + 1).setZero();
  const int angles = 3 * (last_ + 1);
  if (x.size() > angles)
    for (int j = 0; j < last_ / 2; ++j) x[angles + last_ - 1 - j] = -x[angles + j];
}

void TwoFold::impose(Frames& frames) const {
  for (int j = 0; j < last_ / 2; ++j) {
    frames.tangent[last_ - 1 - j] = -half_turn(frames.tangent[j]);
    frames.normal[last_ - 1 - j] = half_turn(frames.normal[j]);
  }
  for (int i = 1; i < last_ / 2; ++i) frames.twist[last_ - i] = frames.twist[i];
}

void TwoFold::align(Frames& frames) const {
  const int j = last_ / 2 - 1;
  const Vector3 &t = frames.tangent[last_ - 1 - j], &n = frames.normal[last_ - 1 - j];
  const Vector3 image = half_turn(frames.normal[j]);
  const double turn = 0.5 * std::atan2(t.cross(n).dot(image), n.dot(image));
  for (size_t k = 0; k < frames.normal.size(); ++k)
    frames.normal[k] = Eigen::AngleAxisd(turn, frames.tangent[k]) * frames.normal[k];
  impose(frames);
}

int TwoFold::weight(std::span<const int> coordinates) const {
  const int angles = 3 * (last_ + 1);
  int side = 0;
  for (const int c : coordinates)
    side += c < angles ? 2 * (c / 3) - last_ : 2 * (c - angles) - (last_ - 1);
  return side < 0 ? 2 : side == 0 ? 1 : 0;
}

std::vector<ContactPoint> TwoFold::halved(std::vector<ContactPoint> points, double length) const {
  std::erase_if(points,
                [&](const ContactPoint& at) { return at.s_a + at.s_b > (1 + same_arc) * length; });
  for (ContactPoint& at : points)
    if (at.s_a + at.s_b < (1 - same_arc) * length) at.force *= 2, at.stiffness *= 2;
  return points;
}

void HalfEffect::list() {
  kept_.clear();
  for (int i = 0; i < whole_.stencils(); ++i)
    if (const int w = weight(whole_.coordinates(i))) kept_.push_back({i, w});
}

void HalfEffect::element(const Vector& x, int i, Order order, ElementSlot& slot) const {
  whole_.element(x, kept_[i].stencil, order, slot);
  if (slot.empty || kept_[i].weight == 1) return;
  const size_t count = whole_.coordinates(kept_[i].stencil).size();
  slot.energy *= 2;
  if (order >= Order::gradient)
    for (size_t k = 0; k < count; ++k) slot.gradient[k] *= 2;
  if (order >= Order::hessian)
    for (size_t k = 0; k < count * count; ++k) slot.hessian[k] *= 2;
}

void HalfEffect::refresh(const Vector& x) {
  whole_.refresh(x);
  list();
}

void HalfEffect::couplings(const std::function<void(std::span<const int>)>& couple) const {
  whole_.couplings([&](std::span<const int> coordinates) {
    if (weight(coordinates) > 0) couple(coordinates);
  });
}

}  // namespace bight::rod1d
