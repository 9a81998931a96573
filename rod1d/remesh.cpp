#include "rod1d/remesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "rod1d/knot_mesh.h"

namespace bight::rod1d {

namespace {

/// A place between the middles of two neighbouring segments: (1 - weight) of the first.
struct Between {
  int segment;
  double weight;
};

double middle(const std::vector<double>& arc, int segment) {
  return 0.5 * (arc[segment] + arc[segment + 1]);
}

/// Where the middles of the new segments lie among those of the old. The end segments, which grips
/// hold, correspond to each other.
std::vector<Between> places(const std::vector<double>& arc, const std::vector<double>& wanted) {
  const int last = static_cast<int>(arc.size()) - 2;
  std::vector<Between> list;
  int k = 0;
  for (int i = 0; i <= last; ++i) {
    const double s = middle(wanted, i);
    while (k + 2 <= last && middle(arc, k + 1) < s) ++k;
    const double a = middle(arc, k), b = middle(arc, k + 1);
    list.push_back({k, i == 0 ? 0 : i == last ? 1 : std::clamp((s - a) / (b - a), 0.0, 1.0)});
  }
  return list;
}

/// Signed turn about the unit vector t from a to b, both across it.
double turn_about(const Vector3& t, const Vector3& a, const Vector3& b) {
  return std::atan2(t.cross(a).dot(b), a.dot(b));
}

/// Twist of the material frames from the first segment up to each.
std::vector<double> twist_up_to(const Frames& frames, const Eigen::Ref<const Vector>& angles) {
  std::vector<double> sum{0.0};
  for (Eigen::Index i = 1; i < angles.size(); ++i)
    sum.push_back(sum.back() + frames.twist[i] + angles[i] - angles[i - 1]);
  return sum;
}

}  // namespace

Vector remeshed(const std::vector<double>& arc, const Vector& x,
                const std::vector<double>& wanted) {
  const auto nodes = static_cast<Eigen::Index>(arc.size());
  Polyline line;
  for (Eigen::Index i = 0; i < nodes; ++i) line.push_back(x.segment<3>(3 * i));
  const Polyline points = points_at(arc, line, wanted);
  Vector out(x.size());
  for (Eigen::Index i = 0; i < nodes; ++i) out.segment<3>(3 * i) = points[i];
  if (x.size() == 3 * nodes) return out;
  const auto angles = x.tail(nodes - 1);
  const std::vector<Between> at = places(arc, wanted);
  for (Eigen::Index i = 0; i + 1 < nodes; ++i)
    out[3 * nodes + i] =
        (1 - at[i].weight) * angles[at[i].segment] + at[i].weight * angles[at[i].segment + 1];
  return out;
}

Frames remeshed(const std::vector<double>& arc, const Frames& frames,
                const std::vector<double>& wanted, const Vector& x_wanted) {
  const int segments = static_cast<int>(arc.size()) - 1;
  Frames out;
  out.twist.assign(segments + 1, 0.0);
  double last_turns = 0;
  std::vector<double> turns{0.0};  // of the old frames from the first segment on
  for (int i = 1; i < segments; ++i) turns.push_back(turns.back() + frames.twist[i]);
  const std::vector<Between> at = places(arc, wanted);
  for (int i = 0; i < segments; ++i) {
    const auto& [k, w] = at[i];
    const Vector3 t = (x_wanted.segment<3>(3 * (i + 1)) - x_wanted.segment<3>(3 * i)).normalized();
    const Vector3 a = transported(frames.normal[k], frames.tangent[k], t);
    const Vector3 b = transported(frames.normal[k + 1], frames.tangent[k + 1], t);
    out.tangent.push_back(t);
    out.normal.push_back(Eigen::AngleAxisd(w * turn_about(t, a, b), t) * a);
    const double here = (1 - w) * turns[k] + w * turns[k + 1];
    if (i > 0) {
      const Vector3 before = transported(out.normal[i - 1], out.tangent[i - 1], t);
      const double twist = turn_about(t, before, out.normal[i]), turn = 2 * std::numbers::pi;
      out.twist[i] = twist + turn * std::round((here - last_turns - twist) / turn);
    }
    last_turns = here;
  }
  return out;
}

void keep_twist(const std::vector<double>& arc, const Vector& x, const Frames& frames,
                const std::vector<double>& wanted, const Frames& frames_wanted, int fixed,
                bool start_held, bool finish_held, Vector& x_wanted) {
  const auto segments = static_cast<Eigen::Index>(arc.size()) - 1;
  const std::vector<double> twist = twist_up_to(frames, x.tail(segments));
  const std::vector<Between> at = places(arc, wanted);
  const Vector before = x_wanted.tail(segments);
  const std::vector<double> now = twist_up_to(frames_wanted, before);
  Vector change(segments);
  for (Eigen::Index i = 0; i < segments; ++i)
    change[i] = (1 - at[i].weight) * twist[at[i].segment] +
                at[i].weight * twist[at[i].segment + 1] - now[i];
  change.array() -= double(change[fixed]);
  const double middle_fixed = middle(wanted, fixed);
  const auto keep = [&](Eigen::Index end, Eigen::Index first, Eigen::Index last) {
    const double excess = change[end], way = middle(wanted, static_cast<int>(end)) - middle_fixed;
    for (Eigen::Index i = first; i <= last; ++i)
      change[i] -= excess * (middle(wanted, static_cast<int>(i)) - middle_fixed) / way;
  };
  if (start_held && fixed > 0) keep(0, 0, fixed);
  if (finish_held && fixed < segments - 1) keep(segments - 1, fixed, segments - 1);
  x_wanted.tail(segments) = before + change;
}

}  // namespace bight::rod1d
