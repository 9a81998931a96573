#include "rod1d/effects/contact.h"

#include <algorithm>
#include <cmath>

namespace bight::rod1d {

namespace {

/// Largest distance between samples along the rod [D].
constexpr double sample_spacing = 0.045;
/// Parts of the rod that are nearer than this along it are no pair [D]. A tube that is bent as much
/// as it can be (curvature 2/D) meets itself after pi/2 D of arc, so nothing is missed; and since
/// only local minima of the distance count, a bend alone is no contact.
constexpr double exclusion = 1.5;
/// Pairs are looked for up to this gap, again when a node has moved by `search_slack` [D].
constexpr double search_gap = 0.8, search_slack = 0.2;
constexpr double known_gap = search_gap - 2 * search_slack;
/// Pairs nearer than this are given room in the Hessian's pattern [D].
constexpr double pattern_gap = 0.1;
/// Gap below which no iteration may bring a pair [D].
constexpr double deepest_gap = -0.15;

/// Coordinates of the nodes around a segment; a node beyond the end has no weight.
void write_coordinates(int segment, int nodes, int* to) {
  for (int k = 0; k < 4; ++k) {
    const int first = Rod::position(std::clamp(segment - 1 + k, 0, nodes - 1));
    for (int c = 0; c < 3; ++c) to[3 * k + c] = first + c;
  }
}

double largest_move(const Vector& dx, int nodes) {
  double square = 0;
  for (int i = 0; i < nodes; ++i) square = std::max(square, dx.segment<3>(3 * i).squaredNorm());
  return std::sqrt(square);
}

}  // namespace

Contact::Contact(const Rod& rod) : nodes_(rod.nodes()), arc_(rod.arc_length()) {
  for (int i = 0; i < rod.segments(); ++i) {
    curve_.push_back(curve_segment(rod, i));
    const int count = std::max(1, static_cast<int>(std::ceil(rod.rest_length[i] / sample_spacing - 1e-9)));
    sample_at_.emplace_back();
    sample_.emplace_back();
    for (int k = 0; k < count; ++k) {
      sample_at_[i].push_back((k + 0.5) * rod.rest_length[i] / count);
      sample_[i].push_back(curve_[i].weights(sample_at_[i].back()));
    }
  }
}

void Contact::element(const Vector& x, int i, Order order, ElementSlot& slot) const {
  const ContactPoint& at = touching_[i];
  Eigen::Matrix<double, 24, 1> values;
  for (int k = 0; k < 24; ++k) values[k] = x[at.coordinates[k]];
  slot.set(contact_element(values, at, law_, order), order);
}

void Contact::refresh(const Vector& x) {
  if (searched_.size() == 0 || largest_move(x - searched_, nodes_) > search_slack) {
    searched_ = x;
    windows_ = contact_windows(x, arc_, 1 + search_gap, exclusion);
  }
  node_.resize(nodes_), tangent_.resize(nodes_);
  for (int i = 0; i < nodes_; ++i) node_[i] = x.segment<3>(3 * i);
  for (int i = 0; i < nodes_; ++i) {
    const int segment = std::min(i, nodes_ - 2);
    const CurveWeights w = curve_[segment].weights(i == segment ? 0 : curve_[segment].length());
    tangent_[i].setZero();
    for (int k = 0; k < 4; ++k)
      tangent_[i] += w.first[k] * node_[std::clamp(segment - 1 + k, 0, nodes_ - 1)];
  }
  touching_.clear(), near_.clear();
  for (const ContactWindow& window : windows_)
    for (size_t k = 0; k < sample_[window.segment].size(); ++k)
      project(x, window.segment, static_cast<int>(k), window);
}

/// Finds the local minima of the distance from a sample to the stretch of curve in the window:
/// (p - y) . y' falls through zero there.
void Contact::project(const Vector& x, int segment, int sample, const ContactWindow& window) {
  const CurveWeights& here = sample_[segment][sample];
  const double at = sample_at_[segment][sample];
  Vector3 p = Vector3::Zero();
  for (int k = 0; k < 4; ++k)
    p += here.value[k] * node_[std::clamp(segment - 1 + k, 0, nodes_ - 1)];

  double ahead = (p - node_[window.first]).dot(tangent_[window.first]);
  for (int j = window.first; j <= window.last; ++j) {
    const double behind = ahead;
    ahead = (p - node_[j + 1]).dot(tangent_[j + 1]);
    if (!(behind >= 0 && ahead < 0)) continue;
    if ((p - node_[j]).squaredNorm() > std::pow(1 + known_gap + 1.5 * curve_[j].length(), 2)) continue;

    double low = 0, high = curve_[j].length(), s = high * behind / (behind - ahead);
    Vector3 y[4];
    for (int k = 0; k < 4; ++k) y[k] = node_[std::clamp(j - 1 + k, 0, nodes_ - 1)];
    for (int iteration = 0; iteration < 30; ++iteration) {
      const CurveWeights w = curve_[j].weights(s);
      Vector3 d = p, dy = Vector3::Zero(), ddy = Vector3::Zero();
      for (int k = 0; k < 4; ++k)
        d -= w.value[k] * y[k], dy += w.first[k] * y[k], ddy += w.second[k] * y[k];
      const double f = d.dot(dy), slope = d.dot(ddy) - dy.squaredNorm();
      (f >= 0 ? low : high) = s;
      double next = slope < 0 ? s - f / slope : 0.5 * (low + high);
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      const double change = std::abs(next - s);
      s = next;
      if (change < 1e-14) break;
    }
    if (std::abs(arc_[segment] + at - arc_[j] - s) < exclusion) continue;
    ContactPoint found = point(segment, at, here, j, s);
    Vector3 d = Vector3::Zero();
    for (int k = 0; k < 8; ++k) d += found.a[k] * x.segment<3>(found.coordinates[3 * k]);
    found.gap = d.norm() - 1;
    if (found.gap > known_gap) continue;
    found.weight = 0.5 * curve_[segment].length() / static_cast<double>(sample_[segment].size());
    near_.push_back(found);
    if (law_.touches(found.gap)) touching_.push_back(found);
  }
}

ContactPoint Contact::point(int segment, double at, const CurveWeights& here, int facing,
                            double facing_at) const {
  ContactPoint out;
  const CurveWeights there = curve_[facing].weights(facing_at);
  write_coordinates(segment, nodes_, out.coordinates.data());
  write_coordinates(facing, nodes_, out.coordinates.data() + 12);
  for (int k = 0; k < 4; ++k) {
    out.a[k] = here.value[k], out.a[4 + k] = -there.value[k];
    out.b[k] = 0, out.b[4 + k] = there.first[k];
    out.c[k] = 0, out.c[4 + k] = there.second[k];
  }
  out.segment = segment, out.at = at;
  out.facing = facing, out.facing_at = facing_at;
  return out;
}

void Contact::couplings(const std::function<void(std::span<const int>)>& couple) const {
  std::array<int, 24> coordinates;
  for (const ContactPoint& at : near_) {
    if (at.gap > pattern_gap) continue;
    coordinates = at.coordinates;
    for (int j = std::max(at.facing - 1, 0); j <= std::min(at.facing + 1, nodes_ - 2); ++j) {
      write_coordinates(j, nodes_, coordinates.data() + 12);
      couple(coordinates);
    }
  }
}

double Contact::longest_step(const Vector& x, const Vector& dx) const {
  // Pairs that are not known are more than known_gap apart.
  double longest = std::min(1.0, 0.5 * (known_gap - deepest_gap) / largest_move(dx, nodes_));
  for (const ContactPoint& at : near_) {
    Vector3 d = Vector3::Zero(), dd = Vector3::Zero();
    for (int k = 0; k < 8; ++k) {
      d += at.a[k] * x.segment<3>(at.coordinates[3 * k]);
      dd += at.a[k] * dx.segment<3>(at.coordinates[3 * k]);
    }
    const double approach = -d.dot(dd) / d.norm();
    // A pair that is deeper already (a start that overlaps) may still be pushed about a little.
    const double room = std::max(d.norm() - 1 - deepest_gap, 0.05);
    if (approach * longest > room) longest = room / approach;
  }
  return longest;
}

}  // namespace bight::rod1d
