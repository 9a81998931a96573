#include "rod1d/friction_spots.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "rod1d/curve.h"
#include "rod1d/jet.h"

namespace bight::rod1d {

namespace {

/// Points of strand b that are farther apart than this belong to different spots [D].
constexpr double same_spot = 0.5;

/// A point of the rod: weights of four nodes and three angles, from the segment before on.
struct Place {
  int segment;
  CurveWeights curve;
  std::array<double, 3> angle{0, 1, 0};

  Place(const Rod& rod, int segment, double u)
      : segment(segment),
        curve(curve_segment(rod.rest_length, segment).weights(u * rod.rest_length[segment])) {
    // The angle is that of a segment at its middle, linear in between.
    const double s = (u - 0.5) * rod.rest_length[segment];
    const int side = s < 0 ? -1 : 1, other = segment + side;
    if (other < 0 || other >= rod.segments()) return;
    const double w = std::abs(s) / (0.5 * (rod.rest_length[segment] + rod.rest_length[other]));
    angle[1] = 1 - w, angle[1 + side] = w;
  }
};

int node_of(const Rod& rod, const Place& at, int k) {
  return std::clamp(at.segment - 1 + k, 0, rod.nodes() - 1);
}

Vector3 sum(const Rod& rod, const Place& at, const std::array<double, 4>& weights,
            const Vector& x) {
  Vector3 result = Vector3::Zero();
  for (int k = 0; k < 4; ++k)
    result += weights[k] * x.segment<3>(Rod::position(node_of(rod, at, k)));
  return result;
}

/// Centerline and material frame (columns d1, d2, t) at one place.
struct Section {
  Vector3 point;
  double stretch;
  Matrix3 frame;

  Section(const Rod& rod, const Place& at, const Vector& x, const Frames& frames)
      : point(sum(rod, at, at.curve.value, x)) {
    const Vector3 slope = sum(rod, at, at.curve.first, x);
    stretch = slope.norm();
    const Vector3 t = slope / stretch;
    const auto director = [&](int segment) {
      return transported(frames.director(segment, x[rod.angle(segment)]), frames.tangent[segment],
                         t);
    };
    Vector3 d1 = director(at.segment);
    for (const int side : {-1, 1}) {
      if (at.angle[1 + side] == 0) continue;
      const Vector3 other = director(at.segment + side);
      const double turn = std::atan2(t.cross(d1).dot(other), d1.dot(other));
      d1 = Eigen::AngleAxisd(at.angle[1 + side] * turn, t) * d1;
      break;
    }
    frame << d1, t.cross(d1), t;
  }
  Vector3 tangent() const { return frame.col(2); }
};

using SlipJet = Jet<slip_variables>;
using SlipVector = std::array<SlipJet, 3>;

SlipVector operator+(const SlipVector& a, const SlipVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
SlipVector operator-(const SlipVector& a, const SlipVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
SlipVector operator*(const SlipVector& a, const SlipJet& b) {
  return {a[0] * b, a[1] * b, a[2] * b};
}
template <class Other>
SlipJet dot(const SlipVector& a, const Other& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
SlipVector constant(const Vector3& v) { return {v[0], v[1], v[2]}; }
SlipVector variables(const Vector3& v, int first) {
  return {SlipJet::variable(v[0], first), SlipJet::variable(v[1], first + 1),
          SlipJet::variable(v[2], first + 2)};
}

/// A vector fixed in a section with the tangent t0: turned about t0 by the change of the angle
/// (variable `angle`), then carried to the tangent of dy/ds (variables from `slope` on).
SlipVector fixed_in(const Section& section, int slope, int angle, const Vector3& v) {
  const Vector3 t0 = section.tangent(), along = t0 * t0.dot(v), across = v - along;
  const SlipJet turn = SlipJet::variable(0, angle);
  const SlipVector turned = constant(along) + constant(across) * SlipJet::compose(turn, 1, 0, -1) +
                            constant(t0.cross(across)) * SlipJet::compose(turn, 0, 1, 0);
  const SlipVector y = variables(section.stretch * t0, slope);
  const double l = section.stretch;
  const SlipJet square = dot(y, y);
  const SlipVector t =
      y * SlipJet::compose(square, 1 / l, -0.5 / (l * l * l), 0.75 / std::pow(l, 5));
  const SlipVector sum = t + constant(t0);
  return turned - sum * (dot(sum, turned) / (dot(t, t0) + 1.0)) + t * (2.0 * dot(turned, t0));
}

/// z = map x for two places.
Eigen::Matrix<double, slip_variables, friction_coordinates> slip_map(const Place& a,
                                                                     const Place& b) {
  Eigen::Matrix<double, slip_variables, friction_coordinates> map;
  map.setZero();
  for (int k = 0; k < 4; ++k) {
    map.block<3, 3>(0, 3 * k) = a.curve.value[k] * Matrix3::Identity();
    map.block<3, 3>(0, 12 + 3 * k) = -b.curve.value[k] * Matrix3::Identity();
    map.block<3, 3>(3, 3 * k) = a.curve.first[k] * Matrix3::Identity();
    map.block<3, 3>(6, 12 + 3 * k) = b.curve.first[k] * Matrix3::Identity();
  }
  for (int k = 0; k < 3; ++k) map(9, 24 + k) = a.angle[k], map(10, 27 + k) = b.angle[k];
  return map;
}

/// Sums the points that belong to one spot.
std::vector<RubbingPoint> merged(std::vector<RubbingPoint> points) {
  std::sort(points.begin(), points.end(), [](const RubbingPoint& l, const RubbingPoint& r) {
    return std::tuple(l.a, l.u_a, l.arc_b) < std::tuple(r.a, r.u_a, r.arc_b);
  });
  std::vector<RubbingPoint> sums;
  double last = 0;
  for (const RubbingPoint& point : points) {
    if (!(point.force > 0)) continue;
    const bool same = !sums.empty() && sums.back().a == point.a && sums.back().u_a == point.u_a &&
                      point.arc_b - last < same_spot;
    last = point.arc_b;
    if (!same) {
      sums.push_back(point);
      continue;
    }
    RubbingPoint& sum = sums.back();
    const double force = sum.force + point.force;
    sum.arc_b += (point.arc_b - sum.arc_b) * point.force / force;
    sum.force = force;
  }
  return sums;
}

/// Elastic slip that a spot had at the last accepted state; zero for a new one.
Vector2 remembered(const FrictionHistory& history, const RubbingPoint& spot) {
  Vector2 found = Vector2::Zero();
  double nearest = same_spot;
  const auto key = std::pair(spot.a, spot.u_a);
  auto it = std::lower_bound(history.memory.begin(), history.memory.end(), key,
                             [](const FrictionHistory::Memory& memory, const auto& key) {
                               return std::pair(memory.a, memory.u_a) < key;
                             });
  for (; it != history.memory.end() && std::pair(it->a, it->u_a) == key; ++it)
    if (std::abs(it->arc_b - spot.arc_b) < nearest) {
      nearest = std::abs(it->arc_b - spot.arc_b);
      found = it->elastic_slip;
    }
  return found;
}

}  // namespace

std::array<int, friction_coordinates> friction_stencil(const Rod& rod, int a, int b) {
  std::array<int, friction_coordinates> coordinates;
  for (const int side : {0, 1}) {
    const int segment = side ? b : a;
    // A node or an angle beyond the end has no weight.
    for (int k = 0; k < 4; ++k)
      for (int c = 0; c < 3; ++c)
        coordinates[12 * side + 3 * k + c] =
            Rod::position(std::clamp(segment - 1 + k, 0, rod.nodes() - 1)) + c;
    for (int k = 0; k < 3; ++k)
      coordinates[24 + 3 * side + k] =
          rod.angle(std::clamp(segment - 1 + k, 0, rod.segments() - 1));
  }
  return coordinates;
}

std::vector<RubbingPoint> rubbing_points(const std::vector<ContactPoint>& points) {
  std::vector<RubbingPoint> list;
  for (const ContactPoint& at : points) list.push_back({at.segment_a, at.u_a, at.s_b, at.force});
  return merged(std::move(list));
}

std::vector<FrictionSpot> friction_spots(const Rod& rod, const std::vector<RubbingPoint>& points,
                                         const Vector& x, const Frames& frames,
                                         const FrictionHistory& history) {
  const std::vector<double> arc = rod.arc_length();
  std::vector<FrictionSpot> spots;
  for (const RubbingPoint& point : points) {
    FrictionSpot spot;
    spot.at = point;
    const auto above = std::upper_bound(arc.begin() + 1, arc.end() - 1, point.arc_b);
    spot.b = static_cast<int>(above - arc.begin()) - 1;
    const Place at_a(rod, point.a, point.u_a);
    const Place at_b(rod, spot.b, (point.arc_b - arc[spot.b]) / rod.rest_length[spot.b]);
    const Section a(rod, at_a, x, frames), b(rod, at_b, x, frames);
    const Section a_t0(rod, at_a, history.x, history.frames);
    const Section b_t0(rod, at_b, history.x, history.frames);
    const Vector3 n = (a.point - b.point).normalized();
    Eigen::Matrix<double, 3, 2> axes;
    axes.col(0) = (a.tangent() - n * n.dot(a.tangent())).normalized();
    axes.col(1) = n.cross(axes.col(0));

    // Turns of both sections since then, and the distance of the two surface points then.
    const Matrix3 turn_a = a.frame * a_t0.frame.transpose();
    const Matrix3 turn_b = b.frame * b_t0.frame.transpose();
    const Vector3 apart =
        a_t0.point - b_t0.point - 0.5 * (turn_a.transpose() * n) - 0.5 * (turn_b.transpose() * n);
    const Vector3 slip = -0.5 * (turn_a * apart + turn_b * apart);

    spot.slip = remembered(history, point) + axes.transpose() * slip;
    spot.map = slip_map(at_a, at_b);
    const auto coordinates = friction_stencil(rod, point.a, spot.b);
    spot.z.setZero();
    for (int k = 0; k < friction_coordinates; ++k) spot.z += spot.map.col(k) * x[coordinates[k]];
    const SlipVector apart_now = variables(a.point - b.point, 0) - fixed_in(b, 6, 10, 0.5 * n);
    for (const int c : {0, 1}) {
      const SlipJet jet = dot(fixed_in(a, 3, 9, axes.col(c)), apart_now);
      spot.gradient.col(c) = jet.gradient;
      spot.hessian[c] = jet.hessian;
    }
    spots.push_back(spot);
  }
  return spots;
}

}  // namespace bight::rod1d
