#include "rod1d/effects/contact.h"

#include <algorithm>
#include <cmath>

namespace bight::rod1d {

namespace {

/// A tube that is bent as much as it can be (curvature 2/D) meets itself after pi/2 D of arc, so
/// nearer parts of the rod are no pair [D].
constexpr double exclusion = 1.5;
/// Segments are looked for up to this gap, again when a node has moved by `search_slack` [D].
constexpr double search_gap = 0.8, search_slack = 0.2;
constexpr double known_gap = search_gap - 2 * search_slack;
/// Pairs of points are listed that are this much beyond touching, again when a node has moved by
/// half of it [D].
constexpr double list_slack = 0.05;
/// Segments nearer than this are given room in the Hessian's pattern [D].
constexpr double pattern_gap = 0.08;
/// Gap below which no iteration may bring a pair [D].
constexpr double deepest_gap = -0.15;

/// Positions of the quadrature points of a segment.
using Points = std::vector<Vector3>;

void place(const SegmentSamples& samples, const double* nodes, Points& points) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 4>> x(nodes);
  points.resize(samples.value.size());
  for (size_t i = 0; i < points.size(); ++i)
    points[i] = x * Eigen::Map<const Eigen::Vector4d>(samples.value[i].data());
}

Eigen::Matrix<double, 24, 1> gather(const Vector& x, const std::array<int, 24>& coordinates) {
  Eigen::Matrix<double, 24, 1> values;
  for (int k = 0; k < 24; ++k) values[k] = x[coordinates[k]];
  return values;
}

/// Calls `visit(pair, d, distance)` for the pairs that touch, d from j to i.
template <class Visit>
void for_touching(std::span<const PointPair> pairs, const Points& p, const Points& q,
                  const ContactLaw& law, Visit&& visit) {
  const double reach = 1 + 0.5 * law.onset, limit = reach * reach;
  for (const PointPair& at : pairs) {
    const Vector3 d = p[at.i] - q[at.j];
    const double square = d.squaredNorm();
    if (square < limit) visit(at, d, std::sqrt(square));
  }
}

using Block = Eigen::Matrix<double, 1, 9>;  ///< a 3 x 3 block, column by column

/// What presses on one point: force and stiffness.
struct PointSums {
  bool touches = false;
  Vector3 force;
  Matrix3 stiffness;

  void add(const Vector3& f, const Matrix3& k) {
    if (!touches) force.setZero(), stiffness.setZero();
    touches = true;
    force += f;
    stiffness += k;
  }
};

/// Sums over the points of one segment, spread over its four nodes by the weights w of each.
struct NodeSums {
  Eigen::Matrix<double, 3, 4> force = Eigen::Matrix<double, 3, 4>::Zero();
  Eigen::Matrix<double, 16, 9> stiffness = Eigen::Matrix<double, 16, 9>::Zero();

  void add(const std::array<double, 4>& weights, const PointSums& sums, Order order) {
    const Eigen::Map<const Eigen::Vector4d> w(weights.data());
    force += sums.force * w.transpose();
    if (order < Order::hessian) return;
    const Eigen::Matrix4d ww = w * w.transpose();
    stiffness += Eigen::Map<const Eigen::Matrix<double, 16, 1>>(ww.data()) *
                 Eigen::Map<const Block>(sums.stiffness.data());
  }
};

}  // namespace

void contact_element(const Eigen::Matrix<double, 24, 1>& x, const SegmentSamples& a,
                     const SegmentSamples& b, std::span<const PointPair> pairs,
                     const ContactLaw& law, Order order, ElementSlot& slot) {
  thread_local Points p, q;
  thread_local std::vector<PointSums> on_q;
  place(a, x.data(), p);
  place(b, x.data() + 12, q);
  const double weight = a.spacing * b.spacing;
  if (order == Order::energy) {
    for_touching(pairs, p, q, law, [&](const PointPair&, const Vector3&, double distance) {
      slot.energy += weight * law.energy(distance - 1);
    });
    return;
  }

  // Per pair of points: d gap/dp = n, d2 gap/dp dp = (I - n n')/distance, the opposite for q. They
  // are summed by points first, which share their nodes' weights; `across` by the point i on a, by
  // nodes of b (rows) and the entries of a block.
  on_q.resize(std::max(on_q.size(), q.size()));
  for (size_t j = 0; j < q.size(); ++j) on_q[j].touches = false;
  NodeSums on_a, on_b;
  PointSums on_p;
  Eigen::Matrix<double, 4, 9> across_p;
  Eigen::Matrix<double, 4, 36> across = Eigen::Matrix<double, 4, 36>::Zero();
  int current = -1;
  const auto leave_point = [&] {
    if (current < 0) return;
    on_a.add(a.value[current], on_p, order);
    if (order == Order::hessian)
      across += Eigen::Map<const Eigen::Vector4d>(a.value[current].data()) *
                Eigen::Map<const Eigen::Matrix<double, 1, 36>>(across_p.data());
  };
  for_touching(pairs, p, q, law, [&](const PointPair& at, const Vector3& d, double distance) {
    if (at.i != current) {
      leave_point();
      current = at.i;
      on_p.touches = false;
      across_p.setZero();
    }
    const double gap = distance - 1;
    slot.energy += weight * law.energy(gap);
    const Vector3 n = d / distance;
    const double slope = weight * law.slope(gap), curvature = weight * law.curvature(gap);
    const Matrix3 m = (curvature - slope / distance) * n * n.transpose() +
                      (slope / distance) * Matrix3::Identity();
    on_p.add(slope * n, m);
    on_q[at.j].add(-slope * n, m);
    across_p +=
        Eigen::Map<const Eigen::Vector4d>(b.value[at.j].data()) * Eigen::Map<const Block>(m.data());
  });
  slot.empty = current < 0;
  if (slot.empty) return;
  leave_point();
  for (size_t j = 0; j < q.size(); ++j)
    if (on_q[j].touches) on_b.add(b.value[j], on_q[j], order);

  Eigen::Map<Eigen::Matrix<double, 3, 8>> gradient(slot.gradient);
  gradient.leftCols<4>() = on_a.force;
  gradient.rightCols<4>() = on_b.force;
  if (order == Order::gradient) return;
  Eigen::Map<Eigen::Matrix<double, 24, 24>> hessian(slot.hessian);
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < 4; ++l)
      for (int c = 0; c < 9; ++c) {
        const int row = 3 * k + c % 3, column = 3 * l + c / 3;
        hessian(row, column) = on_a.stiffness(4 * l + k, c);
        hessian(12 + row, 12 + column) = on_b.stiffness(4 * l + k, c);
        hessian(row, 12 + column) = hessian(12 + column, row) = -across(k, 4 * c + l);
      }
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

void Contact::set_law(const ContactLaw& law) {
  if (law.onset != law_.onset) listed_at_.resize(0);
  law_ = law;
}

Contact::Stencil Contact::stencil(int a, int b) const {
  Stencil out;
  for (int side = 0; side < 2; ++side)
    for (int k = 0; k < 4; ++k) {
      // A node beyond the end has no weight.
      const int node = std::clamp((side == 0 ? a : b) - 1 + k, 0, nodes_ - 1);
      for (int c = 0; c < 3; ++c) out[12 * side + 3 * k + c] = Rod::position(node) + c;
    }
  return out;
}

double Contact::largest_move(const Vector& dx) const {
  return std::sqrt(
      Eigen::Map<const Eigen::Matrix3Xd>(dx.data(), 3, nodes_).colwise().squaredNorm().maxCoeff());
}

void Contact::element(const Vector& x, int i, Order order, ElementSlot& slot) const {
  const SegmentPair& at = listed_[i];
  contact_element(gather(x, at.coordinates), samples_[at.a], samples_[at.b], pairs_of(at), law_,
                  order, slot);
}

template <class Visit>
void Contact::for_near_segments(const Vector& x, double gap, Visit&& visit) const {
  const auto node = [&](int i) { return x.segment<3>(Rod::position(i)); };
  const auto length = [&](int i) { return (node(i + 1) - node(i)).norm(); };
  for (const ContactWindow& window : windows_) {
    const int a = window.segment;
    const double length_a = length(a);
    for (int b = std::max(window.first, a + 1); b <= window.last; ++b) {
      // The curve leaves its chord by less than an eighth of its length.
      const double limit = 2 * (gap + 1 + 0.625 * (length_a + length(b)));
      if ((node(a) + node(a + 1) - node(b) - node(b + 1)).squaredNorm() < limit * limit)
        visit(a, b);
    }
  }
}

void Contact::list_pairs(const Vector& x) {
  listed_at_ = x;
  listed_.clear(), pairs_.clear();
  deepest_ = known_gap;
  const double list_gap = 0.5 * law_.onset + list_slack, reach = 1 + list_gap;
  Points p, q;
  for_near_segments(x, list_gap, [&](int a, int b) {
    const SegmentSamples &of_a = samples_[a], &of_b = samples_[b];
    SegmentPair found{a, b, pairs_.size(), 0, stencil(a, b)};
    const auto values = gather(x, found.coordinates);
    place(of_a, values.data(), p), place(of_b, values.data() + 12, q);
    // So much nearer at most is the next point; and all of b is in a ball about its middle.
    double longest = 0;
    for (size_t j = 1; j < q.size(); ++j)
      longest = std::max(longest, (q[j] - q[j - 1]).squaredNorm());
    longest = std::sqrt(longest);
    const double skip = 1 / std::max(longest, 1e-6);
    const int n = static_cast<int>(q.size());
    const Vector3 middle = q[n / 2];
    const double around = reach + longest * (n / 2 + 1);
    for (int i = 0; i < static_cast<int>(p.size()); ++i)
      for (int j = (p[i] - middle).squaredNorm() < around * around ? 0 : n; j < n;) {
        const double distance = (p[i] - q[j]).norm();
        if (distance < reach) {
          if (of_b.arc[j] - of_a.arc[i] > exclusion) {
            pairs_.push_back({i, j});
            deepest_ = std::min(deepest_, distance - 1);
          }
          ++j;
        } else {
          j += 1 + static_cast<int>(std::min((distance - reach) * skip, 1e6));
        }
      }
    found.end = pairs_.size();
    if (found.end > found.begin) listed_.push_back(found);
  });
}

void Contact::refresh(const Vector& x) {
  if (searched_.size() == 0 || largest_move(x - searched_) > search_slack) {
    searched_ = x;
    windows_ = contact_windows(x, arc_, 1 + search_gap, exclusion);
    listed_at_.resize(0);
  }
  if (listed_at_.size() == 0 || largest_move(x - listed_at_) > 0.5 * list_slack) list_pairs(x);
}

void Contact::couplings(const std::function<void(std::span<const int>)>& couple) const {
  for_near_segments(listed_at_, pattern_gap, [&](int a, int b) { couple(stencil(a, b)); });
}

double Contact::longest_step(const Vector& x, const Vector& dx) const {
  const double move = largest_move(dx);
  // Most steps are too short for any pair to get near the deepest gap.
  if (2 * move + list_slack < deepest_ - deepest_gap) return 1;
  // Pairs that are not known are more than known_gap apart.
  double longest = std::min(1.0, 0.5 * (known_gap - deepest_gap) / move);
  Points p, q, dp, dq;
  for_near_segments(x, known_gap, [&](int a, int b) {
    const Stencil coordinates = stencil(a, b);
    const auto values = gather(x, coordinates), change = gather(dx, coordinates);
    place(samples_[a], values.data(), p), place(samples_[b], values.data() + 12, q);
    place(samples_[a], change.data(), dp), place(samples_[b], change.data() + 12, dq);
    // Every fourth point or so is enough to see two strands approach.
    for (size_t i = p.size() / 8; i < p.size(); i += 4)
      for (size_t j = q.size() / 8; j < q.size(); j += 4) {
        const Vector3 d = p[i] - q[j];
        const double distance = d.norm(), approach = -d.dot(dp[i] - dq[j]) / distance;
        // A pair that is deeper already (a start that overlaps) may still be moved a little.
        const double room = std::max(distance - 1 - deepest_gap, 0.05);
        if (approach * longest > room) longest = room / approach;
      }
  });
  return longest;
}

std::vector<ContactPoint> Contact::points(const Vector& x) const {
  std::vector<ContactPoint> list;
  Points p, q;
  for (const SegmentPair& at : listed_) {
    const SegmentSamples &a = samples_[at.a], &b = samples_[at.b];
    const auto values = gather(x, at.coordinates);
    place(a, values.data(), p), place(b, values.data() + 12, q);
    const auto inside = [](const SegmentSamples& s, int i) {
      return (i + 0.5) / static_cast<double>(s.arc.size());
    };
    for_touching(pairs_of(at), p, q, law_,
                 [&](const PointPair& pair, const Vector3& d, double distance) {
                   list.push_back({at.a, at.b, inside(a, pair.i), inside(b, pair.j), a.arc[pair.i],
                                   b.arc[pair.j], d / distance, distance - 1,
                                   -a.spacing * b.spacing * law_.slope(distance - 1)});
                 });
  }
  return list;
}

}  // namespace bight::rod1d
