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
/// How far beside it a spot is remembered [D].
constexpr double same_piece = 2 * piece_length;

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

Vector3 normal(const Section& a, const Section& b) { return (a.point - b.point).normalized(); }

using SlipAxes = Eigen::Matrix<double, 3, 2>;
SlipAxes slip_axes(const Section& a, const Section& b) {
  const Vector3 n = normal(a, b);
  SlipAxes axes;
  axes.col(0) = (a.tangent() - n * n.dot(a.tangent())).normalized();
  axes.col(1) = n.cross(axes.col(0));
  return axes;
}

/// A vector that depends on one section: on its dy/ds and its angle.
using SectionJet = Jet<4>;
using SectionVector = std::array<SectionJet, 3>;

SectionVector operator+(const SectionVector& a, const SectionVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
SectionVector operator-(const SectionVector& a, const SectionVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
SectionVector operator*(const SectionVector& a, const SectionJet& b) {
  return {a[0] * b, a[1] * b, a[2] * b};
}
template <class Other>
SectionJet dot(const SectionVector& a, const Other& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
SectionVector constant(const Vector3& v) { return {v[0], v[1], v[2]}; }

/// A vector fixed in a section with the tangent t0: turned about t0 by the change of the angle,
/// then carried to the tangent of dy/ds.
SectionVector fixed_in(const Section& section, const Vector3& v) {
  const Vector3 t0 = section.tangent(), along = t0 * t0.dot(v), across = v - along;
  const SectionJet turn = SectionJet::variable(0, 3);
  const SectionVector turned = constant(along) +
                               constant(across) * SectionJet::compose(turn, 1, 0, -1) +
                               constant(t0.cross(across)) * SectionJet::compose(turn, 0, 1, 0);
  const double l = section.stretch;
  const SectionVector y = {SectionJet::variable(l * t0[0], 0), SectionJet::variable(l * t0[1], 1),
                           SectionJet::variable(l * t0[2], 2)};
  const SectionVector t =
      y * SectionJet::compose(dot(y, y), 1 / l, -0.5 / (l * l * l), 0.75 / std::pow(l, 5));
  const SectionVector sum = t + constant(t0);
  return turned - sum * (dot(sum, turned) / (dot(t, t0) + 1.0)) + t * (2.0 * dot(turned, t0));
}

/// One component of the slip, axis_a . (p - q - on_b), with its derivatives by z: the axis is fixed
/// in section a, the point on_b in section b.
void slip_component(const SectionVector& axis, const Vector3& apart, const SectionVector& on_b,
                    int c, FrictionSpot& spot) {
  // Places in z of the variables of both sections.
  constexpr std::array<int, 4> in_a{3, 4, 5, 9}, in_b{6, 7, 8, 10};
  auto& gradient = spot.gradient;
  auto& hessian = spot.hessian[c];
  gradient.col(c).setZero();
  hessian.setZero();
  for (int i = 0; i < 3; ++i) {
    const SectionJet &a = axis[i], &b = on_b[i];
    const double d = apart[i] - b.value;
    gradient(i, c) = a.value;
    for (int k = 0; k < 4; ++k) {
      gradient(in_a[k], c) += d * a.gradient[k];
      gradient(in_b[k], c) -= a.value * b.gradient[k];
      hessian(in_a[k], i) = hessian(i, in_a[k]) = a.gradient[k];
      for (int l = 0; l < 4; ++l) {
        hessian(in_a[k], in_a[l]) += d * a.hessian(k, l);
        hessian(in_b[k], in_b[l]) -= a.value * b.hessian(k, l);
        hessian(in_a[k], in_b[l]) -= a.gradient[k] * b.gradient[l];
        hessian(in_b[l], in_a[k]) -= a.gradient[k] * b.gradient[l];
      }
    }
  }
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

/// Elastic slip that this place had at the last accepted state: of the spots before and behind it
/// on the same strands, in between linearly. Zero for a new one.
Vector2 remembered(const FrictionHistory& history, const RubbingPoint& spot) {
  const auto& memory = history.memory;
  const auto first =
      std::lower_bound(memory.begin(), memory.end(), spot.arc_a - same_piece,
                       [](const FrictionHistory::Memory& m, double arc) { return m.arc_a < arc; });
  const FrictionHistory::Memory *before = nullptr, *behind = nullptr;
  for (auto it = first; it != memory.end() && it->arc_a < spot.arc_a + same_piece; ++it) {
    if (std::abs(it->arc_b - spot.arc_b) > same_spot) continue;
    if (it->arc_a <= spot.arc_a) before = &*it;
    if (it->arc_a > spot.arc_a && !behind) behind = &*it;
  }
  if (before && behind) {
    const double w = (spot.arc_a - before->arc_a) / (behind->arc_a - before->arc_a);
    return (1 - w) * before->elastic_slip + w * behind->elastic_slip;
  }
  const auto* nearest = before ? before : behind;
  return nearest ? nearest->elastic_slip : Vector2::Zero();
}

/// The segment that holds the arc length, and the place in it.
Place place_at(const Rod& rod, const std::vector<double>& arc, double at) {
  const auto above = std::upper_bound(arc.begin() + 1, arc.end() - 1, at);
  const int segment = static_cast<int>(above - arc.begin()) - 1;
  return Place(rod, segment, (at - arc[segment]) / rod.rest_length[segment]);
}

/// Adds what `slope` by a point's position is by the positions of its nodes.
void add_slope(const Rod& rod, int segment, double u, const Vector3& slope,
               std::vector<std::pair<int, Vector3>>& by_node) {
  const auto weights =
      curve_segment(rod.rest_length, segment).weights(u * rod.rest_length[segment]).value;
  for (int k = 0; k < 4; ++k) {
    if (weights[k] == 0) continue;
    const int node = segment - 1 + k;
    auto it = std::find_if(by_node.begin(), by_node.end(),
                           [&](const auto& entry) { return entry.first == node; });
    if (it == by_node.end()) it = by_node.insert(it, {node, Vector3::Zero()});
    it->second += weights[k] * slope;
  }
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

std::vector<RubbingPoint> rubbing_points(const Rod& rod, const std::vector<ContactPoint>& points,
                                         bool slopes) {
  struct Pressed {
    int piece;
    const ContactPoint* at;
  };
  std::vector<Pressed> pressed;
  for (const ContactPoint& at : points)
    if (at.force > 0) pressed.push_back({static_cast<int>(at.s_a / piece_length), &at});
  std::sort(pressed.begin(), pressed.end(), [](const Pressed& l, const Pressed& r) {
    return std::tuple(l.piece, l.at->s_b, l.at->s_a) < std::tuple(r.piece, r.at->s_b, r.at->s_a);
  });
  std::vector<RubbingPoint> spots;
  for (size_t k = 0; k < pressed.size(); ++k) {
    const ContactPoint& at = *pressed[k].at;
    if (k == 0 || pressed[k - 1].piece != pressed[k].piece ||
        at.s_b - pressed[k - 1].at->s_b > same_spot)
      spots.push_back({});
    RubbingPoint& spot = spots.back();
    spot.force += at.force;
    spot.arc_a += (at.s_a - spot.arc_a) * at.force / spot.force;
    spot.arc_b += (at.s_b - spot.arc_b) * at.force / spot.force;
    if (!slopes) continue;
    add_slope(rod, at.segment_a, at.u_a, -at.stiffness * at.normal, spot.force_slope);
    add_slope(rod, at.segment_b, at.u_b, at.stiffness * at.normal, spot.force_slope);
  }
  std::sort(spots.begin(), spots.end(), [](const RubbingPoint& l, const RubbingPoint& r) {
    return std::tuple(l.arc_a, l.arc_b) < std::tuple(r.arc_a, r.arc_b);
  });
  return spots;
}

std::vector<FrictionSpot> friction_spots(const Rod& rod, const std::vector<RubbingPoint>& points,
                                         const Vector& x, const Frames& frames,
                                         const FrictionHistory& history, SlipOf of) {
  const bool surface = of == SlipOf::surface;
  const std::vector<double> arc = rod.arc_length();
  std::vector<FrictionSpot> spots;
  for (const RubbingPoint& point : points) {
    FrictionSpot spot;
    spot.at = point;
    const Place at_a = place_at(rod, arc, point.arc_a), at_b = place_at(rod, arc, point.arc_b);
    spot.a = at_a.segment, spot.b = at_b.segment;
    const Section a(rod, at_a, x, frames), b(rod, at_b, x, frames);
    const Section a_t0(rod, at_a, history.x, history.frames);
    const Section b_t0(rod, at_b, history.x, history.frames);
    const Vector3 n = normal(a, b);
    const SlipAxes axes = slip_axes(a, b);

    // Turns of both sections since then, and the distance of the two surface points then.
    const Matrix3 turn_a = a.frame * a_t0.frame.transpose();
    const Matrix3 turn_b = b.frame * b_t0.frame.transpose();
    const Vector3 apart =
        a_t0.point - b_t0.point - 0.5 * (turn_a.transpose() * n) - 0.5 * (turn_b.transpose() * n);
    const Vector3 slip = surface ? Vector3(-0.5 * (turn_a * apart + turn_b * apart))
                                 : Vector3(b_t0.point - a_t0.point);

    spot.slip = remembered(history, point) + axes.transpose() * slip;
    spot.map = slip_map(at_a, at_b);
    const auto coordinates = friction_stencil(rod, spot.a, spot.b);
    spot.z.setZero();
    for (int k = 0; k < friction_coordinates; ++k) spot.z += spot.map.col(k) * x[coordinates[k]];
    const SectionVector on_b = surface ? fixed_in(b, 0.5 * n) : constant(Vector3::Zero());
    for (const int c : {0, 1}) {
      const SectionVector axis = surface ? fixed_in(a, axes.col(c)) : constant(axes.col(c));
      slip_component(axis, a.point - b.point, on_b, c, spot);
    }
    spots.push_back(spot);
  }
  return spots;
}

std::vector<Rub> rubs(const Rod& rod, const FrictionHistory& history) {
  const std::vector<double> arc = rod.arc_length();
  std::vector<Rub> list;
  for (const auto& [arc_a, arc_b, elastic_slip] : history.memory) {
    const Section a(rod, place_at(rod, arc, arc_a), history.x, history.frames);
    const Section b(rod, place_at(rod, arc, arc_b), history.x, history.frames);
    list.push_back({arc_a, arc_b, slip_axes(a, b) * elastic_slip});
  }
  return list;
}

}  // namespace bight::rod1d
