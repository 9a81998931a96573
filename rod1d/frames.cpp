#include "rod1d/frames.h"

#include <numbers>

#include "rod1d/solid_angle.h"

namespace bight::rod1d {

namespace {

Vector3 tangent_of(const Vector& x, int segment) {
  return (x.segment<3>(Rod::position(segment + 1)) - x.segment<3>(Rod::position(segment)))
      .normalized();
}

/// Twist at node i: of the reference frames and by the difference of the angles.
double node_twist(const Rod& rod, const Frames& frames, const Vector& x, int i) {
  return frames.twist[i] + x[rod.angle(i)] - x[rod.angle(i - 1)];
}

}  // namespace

Vector3 transported(const Vector3& v, const Vector3& from, const Vector3& to) {
  const Vector3 moved = v - v.dot(to) / (1 + from.dot(to)) * (from + to);
  return (moved - moved.dot(to) * to).normalized();
}

Frames twist_free_frames(const Rod& rod, const Vector& x) {
  Frames frames;
  frames.twist.assign(rod.nodes(), 0.0);
  for (int i = 0; i < rod.segments(); ++i) {
    const Vector3 t = tangent_of(x, i);
    frames.normal.push_back(i == 0 ? t.unitOrthogonal()
                                   : transported(frames.normal.back(), frames.tangent.back(), t));
    frames.tangent.push_back(t);
  }
  return frames;
}

Frames carried_frames(const Rod& rod, const Frames& source, const Vector& x) {
  Frames frames;
  frames.twist = source.twist;
  for (int i = 0; i < rod.segments(); ++i) {
    frames.tangent.push_back(tangent_of(x, i));
    frames.normal.push_back(
        transported(source.normal[i], source.tangent[i], frames.tangent.back()));
    if (i == 0) continue;
    const Vector3 &s0 = source.tangent[i - 1], &s1 = source.tangent[i];
    const Vector3 &t0 = frames.tangent[i - 1], &t1 = frames.tangent[i];
    frames.twist[i] -= solid_angle(s0, t0, t1) + solid_angle(s0, t1, s1);
  }
  return frames;
}

std::vector<double> twist_angles(const Rod& rod, const Frames& frames, const Vector& x) {
  std::vector<double> angles{x[rod.angle(0)]};
  for (int i = 1; i < rod.segments(); ++i)
    angles.push_back(angles.back() + node_twist(rod, frames, x, i));
  return angles;
}

double total_twist(const Rod& rod, const Frames& frames, const Vector& x) {
  double sum = 0;
  for (int i = 1; i < rod.segments(); ++i) sum += node_twist(rod, frames, x, i);
  return sum / (2 * std::numbers::pi);
}

}  // namespace bight::rod1d
