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

}  // namespace

std::optional<TwoFold> TwoFold::find(Polyline& start, int segments, double tolerance) {
  if (segments % 2 != 0) return std::nullopt;
  const Polyline points = resampled(start, compared);
  const auto has = [&](const TwoFold& symmetry, const Matrix3& turn) {
    for (int i = 0; i <= compared / 2; ++i) {
      const Vector3 image = symmetry.signs().cwiseProduct(turn * points[i]);
      if (!((image - turn * points[compared - i]).norm() < tolerance)) return false;
    }
    return true;
  };
  const auto made_symmetric = [&](const TwoFold& symmetry, const Matrix3& turn) {
    const Polyline line = resampled(start, 2 * static_cast<int>(start.size()));
    const size_t last = line.size() - 1;
    start.clear();
    for (size_t i = 0; i <= last; ++i)
      start.push_back(0.5 *
                      (turn * line[i] + symmetry.signs().cwiseProduct(turn * line[last - i])));
    return symmetry;
  };
  const TwoFold inversion(Kind::inversion, segments);
  if (has(inversion, Matrix3::Identity())) return made_symmetric(inversion, Matrix3::Identity());
  const Vector3& middle = points[compared / 2];
  if (middle.head<2>().norm() < off_axis) return std::nullopt;
  const Matrix3 turn =
      Eigen::AngleAxisd(-std::atan2(middle.y(), middle.x()), Vector3::UnitZ()).toRotationMatrix();
  const TwoFold half_turn(Kind::half_turn, segments);
  if (!has(half_turn, turn)) return std::nullopt;
  return made_symmetric(half_turn, turn);
}

std::vector<Image> TwoFold::images(bool twist) const {
  const int nodes = last_ + 1;
  std::vector<Image> list(3 * nodes + (twist ? last_ : 0));
  for (int i = last_ / 2 + 1; i <= last_; ++i) {
    const int source = Rod::position(last_ - i), image = Rod::position(i);
    for (int c = 0; c < 3; ++c) list[image + c] = {source + c, signs()[c]};
  }
  if (twist)
    for (int j = last_ / 2; j < last_; ++j)
      list[3 * nodes + j] = {3 * nodes + last_ - 1 - j, angle_sign()};
  return list;
}

void TwoFold::hold_middle(std::vector<bool>& held) const {
  const int middle = Rod::position(last_ / 2);
  for (int c = 0; c < 3; ++c)
    if (signs()[c] < 0) held[middle + c] = true;
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
    x.segment<3>(Rod::position(last_ - i)) = signs().cwiseProduct(x.segment<3>(Rod::position(i)));
  for (int c = 0; c < 3; ++c)
    if (signs()[c] < 0) x[Rod::position(last_ / 2) + c] = 0;
  const int angles = 3 * (last_ + 1);
  if (x.size() > angles)
    for (int j = 0; j < last_ / 2; ++j) x[angles + last_ - 1 - j] = angle_sign() * x[angles + j];
}

/// A director's image under inversion is its opposite; of the two, that of the same turn is taken.
void TwoFold::impose(Frames& frames) const {
  for (int j = 0; j < last_ / 2; ++j) {
    frames.tangent[last_ - 1 - j] = -signs().cwiseProduct(frames.tangent[j]);
    frames.normal[last_ - 1 - j] = -angle_sign() * signs().cwiseProduct(frames.normal[j]);
  }
  for (int i = 1; i < last_ / 2; ++i) frames.twist[last_ - i] = -angle_sign() * frames.twist[i];
}

void TwoFold::align(Frames& frames) const {
  const int j = last_ / 2 - 1;
  const Vector3 &t = frames.tangent[last_ - 1 - j], &n = frames.normal[last_ - 1 - j];
  if (kind_ == Kind::half_turn) {
    const Vector3 image = signs().cwiseProduct(frames.normal[j]);
    const double turn = 0.5 * std::atan2(t.cross(n).dot(image), n.dot(image));
    for (size_t k = 0; k < frames.normal.size(); ++k)
      frames.normal[k] = Eigen::AngleAxisd(turn, frames.tangent[k]) * frames.normal[k];
  }
  impose(frames);
}

int TwoFold::weight(std::span<const int> coordinates) const {
  const int angles = 3 * (last_ + 1);
  int side = 0;
  for (const int c : coordinates)
    side += c < angles ? 2 * (c / 3) - last_ : 2 * (c - angles) - (last_ - 1);
  return side < 0 ? 2 : side == 0 ? 1 : 0;
}

EffectList TwoFold::halves(const EffectList& whole, const Effect* halved) const {
  EffectList list;
  for (const auto& effect : whole)
    list.push_back(std::make_unique<HalfEffect>(*effect, *this, effect.get() == halved));
  return list;
}

std::vector<ContactPoint> TwoFold::halved(std::vector<ContactPoint> points, double length) const {
  std::erase_if(points,
                [&](const ContactPoint& at) { return at.s_a + at.s_b > (1 + same_arc) * length; });
  for (ContactPoint& at : points)
    if (at.s_a + at.s_b < (1 - same_arc) * length) at.force *= 2, at.stiffness *= 2;
  return points;
}

std::vector<Rub> TwoFold::whole(std::vector<Rub> half, double length) const {
  for (size_t i = 0, count = half.size(); i < count; ++i) {
    const auto& [s_a, s_b, slip] = half[i];
    half.push_back({length - s_a, length - s_b, image(slip)});
  }
  return half;
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
