#include "rod1d/effects/contact.h"

#include <algorithm>
#include <cmath>

namespace bight::rod1d {

namespace {

/// A tube that is bent as much as it can be (curvature 2/D) meets itself after pi/2 D of arc, so
/// nearer parts of the rod are no pair [D].
constexpr double exclusion = 1.5;
/// Pairs are looked for up to this gap, again when a node has moved by `search_slack` [D].
constexpr double search_gap = 0.8, search_slack = 0.2;
constexpr double known_gap = search_gap - 2 * search_slack;
/// Pairs nearer than this are given room in the Hessian's pattern [D].
constexpr double pattern_gap = 0.03;
/// Gap below which no iteration may bring a pair [D].
constexpr double deepest_gap = -0.15;

using Points = std::vector<Vector3>;

void place(const SegmentSamples& samples, const double* nodes, Points& points) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 4>> x(nodes);
  points.resize(samples.value.size());
  for (size_t i = 0; i < points.size(); ++i)
    points[i] = x * Eigen::Map<const Eigen::Vector4d>(samples.value[i].data());
}

/// Calls `visit(i, j, d, distance)` for the points that touch, d from j to i.
template <class Visit>
void for_touching(const SegmentSamples& a, const SegmentSamples& b, const Points& p, const Points& q,
                  const ContactLaw& law, double apart, Visit&& visit) {
  const double reach = 1 + 0.5 * law.onset, square = reach * reach;
  for (size_t i = 0; i < p.size(); ++i)
    for (size_t j = 0; j < q.size(); ++j) {
      const Vector3 d = p[i] - q[j];
      const double here = d.squaredNorm();
      if (here < square && std::abs(a.arc[i] - b.arc[j]) > apart) visit(i, j, d, std::sqrt(here));
    }
}

}  // namespace

Element<24> contact_element(const Eigen::Matrix<double, 24, 1>& x, const SegmentSamples& a,
                            const SegmentSamples& b, double apart, const ContactLaw& law,
                            Order order) {
  Element<24> out;
  thread_local Points p, q;
  place(a, x.data(), p);
  place(b, x.data() + 12, q);
  const double weight = a.spacing * b.spacing;
  for_touching(a, b, p, q, law, apart, [&](size_t i, size_t j, const Vector3& d, double distance) {
    const double gap = distance - 1;
    out.energy += weight * law.energy(gap);
    if (order == Order::energy) return;
    const Vector3 n = d / distance;
    const double slope = weight * law.slope(gap), curvature = weight * law.curvature(gap);
    double w[8];
    for (int k = 0; k < 4; ++k) w[k] = a.value[i][k], w[4 + k] = -b.value[j][k];
    for (int k = 0; k < 8; ++k) out.gradient.segment<3>(3 * k) += (slope * w[k]) * n;
    if (order == Order::gradient) return;
    // d2 gap/dp dp = (I - n n')/distance
    const Matrix3 m = (curvature - slope / distance) * n * n.transpose() +
                      (slope / distance) * Matrix3::Identity();
    for (int l = 0; l < 8; ++l)
      for (int k = 0; k < 8; ++k) out.hessian.block<3, 3>(3 * k, 3 * l) += (w[k] * w[l]) * m;
  });
  return out;
}

Contact::Contact(const Rod& rod, double spacing) : nodes_(rod.nodes()), arc_(rod.arc_length()) {
  for (int i = 0; i < rod.segments(); ++i) {
    const CurveSegment curve = curve_segment(rod, i);
    const int count = static_cast<int>(std::ceil(curve.length() / spacing - 1e-9));
    SegmentSamples samples;
    samples.spacing = curve.length() / count;
    for (int k = 0; k < count; ++k) {
      const double s = (k + 0.5) * samples.spacing;
      samples.value.push_back(curve.weights(s).value);
      samples.arc.push_back(arc_[i] + s);
    }
    samples_.push_back(std::move(samples));
  }
}

Contact::Pair Contact::pair(int a, int b) const {
  Pair out{a, b, 0, {}};
  for (int side = 0; side < 2; ++side)
    for (int k = 0; k < 4; ++k) {
      // A node beyond the end has no weight.
      const int node = std::clamp((side == 0 ? a : b) - 1 + k, 0, nodes_ - 1);
      for (int c = 0; c < 3; ++c) out.coordinates[12 * side + 3 * k + c] = Rod::position(node) + c;
    }
  return out;
}

double Contact::largest_move(const Vector& dx) const {
  double square = 0;
  for (int i = 0; i < nodes_; ++i)
    square = std::max(square, dx.segment<3>(Rod::position(i)).squaredNorm());
  return std::sqrt(square);
}

void Contact::element(const Vector& x, int i, Order order, ElementSlot& slot) const {
  const Pair& at = touching_[i];
  Eigen::Matrix<double, 24, 1> values;
  for (int k = 0; k < 24; ++k) values[k] = x[at.coordinates[k]];
  slot.set(contact_element(values, samples_[at.a], samples_[at.b], exclusion, law_, order), order);
}

double Contact::smallest_gap(const Vector& x, const Pair& at) const {
  thread_local Points p, q;
  Eigen::Matrix<double, 24, 1> values;
  for (int k = 0; k < 24; ++k) values[k] = x[at.coordinates[k]];
  place(samples_[at.a], values.data(), p), place(samples_[at.b], values.data() + 12, q);
  double square = std::numeric_limits<double>::infinity();
  for (const Vector3& here : p)
    for (const Vector3& there : q) square = std::min(square, (here - there).squaredNorm());
  return std::sqrt(square) - 1;
}

void Contact::refresh(const Vector& x) {
  if (searched_.size() == 0 || largest_move(x - searched_) > search_slack) {
    searched_ = x;
    windows_ = contact_windows(x, arc_, 1 + search_gap, exclusion);
  }
  touching_.clear(), near_.clear();
  const auto node = [&](int i) { return x.segment<3>(Rod::position(i)); };
  for (const ContactWindow& window : windows_)
    for (int b = std::max(window.first, window.segment + 1); b <= window.last; ++b) {
      const int a = window.segment;
      // The curve leaves its chord by less than an eighth of its length.
      const double lengths = (node(a + 1) - node(a)).norm() + (node(b + 1) - node(b)).norm();
      const double apart = 0.5 * (node(a) + node(a + 1) - node(b) - node(b + 1)).norm();
      const double bound = apart - 0.625 * lengths - 1;
      if (bound > known_gap) continue;
      Pair found = pair(a, b);
      found.gap = bound > pattern_gap ? bound : smallest_gap(x, found);
      near_.push_back(found);
      if (found.gap < 0.5 * law_.onset) touching_.push_back(found);
    }
}

void Contact::couplings(const std::function<void(std::span<const int>)>& couple) const {
  for (const Pair& at : near_)
    if (at.gap < pattern_gap) couple(at.coordinates);
}

double Contact::longest_step(const Vector& x, const Vector& dx) const {
  // Pairs that are not known are more than known_gap apart.
  double longest = std::min(1.0, 0.5 * (known_gap - deepest_gap) / largest_move(dx));
  Points p, q, dp, dq;
  Eigen::Matrix<double, 24, 1> values, change;
  for (const Pair& at : near_) {
    for (int k = 0; k < 24; ++k) values[k] = x[at.coordinates[k]], change[k] = dx[at.coordinates[k]];
    place(samples_[at.a], values.data(), p), place(samples_[at.b], values.data() + 12, q);
    place(samples_[at.a], change.data(), dp), place(samples_[at.b], change.data() + 12, dq);
    // Every fourth point or so is enough to see two strands approach.
    for (size_t i = p.size() / 8; i < p.size(); i += 4)
      for (size_t j = q.size() / 8; j < q.size(); j += 4) {
        const Vector3 d = p[i] - q[j];
        const double distance = d.norm(), approach = -d.dot(dp[i] - dq[j]) / distance;
        // A pair that is deeper already (a start that overlaps) may still be moved a little.
        const double room = std::max(distance - 1 - deepest_gap, 0.05);
        if (approach * longest > room) longest = room / approach;
      }
  }
  return longest;
}

std::vector<ContactPoint> Contact::points(const Vector& x) const {
  std::vector<ContactPoint> list;
  Points p, q;
  Eigen::Matrix<double, 24, 1> values;
  for (const Pair& at : touching_) {
    const SegmentSamples &a = samples_[at.a], &b = samples_[at.b];
    for (int k = 0; k < 24; ++k) values[k] = x[at.coordinates[k]];
    place(a, values.data(), p), place(b, values.data() + 12, q);
    const auto inside = [](const SegmentSamples& s, size_t i) {
      return (static_cast<double>(i) + 0.5) / static_cast<double>(s.arc.size());
    };
    for_touching(a, b, p, q, law_, exclusion, [&](size_t i, size_t j, const Vector3&, double distance) {
      list.push_back({at.a, at.b, inside(a, i), inside(b, j), distance - 1,
                      -a.spacing * b.spacing * law_.slope(distance - 1)});
    });
  }
  return list;
}

}  // namespace bight::rod1d
