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

/// Calls `visit(i, j, d, distance)` for all p[i] and q[j] nearer than `reach`, d from j to i.
/// Looking at all of a row at once is faster than being clever: it is done in vector registers.
template <class Visit>
void for_near(const Points& p, const Points& q, double reach, Visit&& visit) {
  thread_local Eigen::ArrayXd x, y, z, square;
  const auto n = static_cast<Eigen::Index>(q.size());
  x.resize(n), y.resize(n), z.resize(n), square.resize(n);
  for (Eigen::Index j = 0; j < n; ++j) x[j] = q[j].x(), y[j] = q[j].y(), z[j] = q[j].z();
  const double limit = reach * reach;
  for (size_t i = 0; i < p.size(); ++i) {
    square = (x - p[i].x()).square() + (y - p[i].y()).square() + (z - p[i].z()).square();
    if (square.minCoeff() >= limit) continue;
    for (Eigen::Index j = 0; j < n; ++j)
      if (square[j] < limit)
        visit(i, static_cast<size_t>(j), Vector3(p[i] - q[j]), std::sqrt(square[j]));
  }
}

/// The same for the points that touch, `apart` along the rod at least.
template <class Visit>
void for_touching(const SegmentSamples& a, const SegmentSamples& b, const Points& p,
                  const Points& q, const ContactLaw& law, double apart, Visit&& visit) {
  for_near(p, q, 1 + 0.5 * law.onset, [&](size_t i, size_t j, const Vector3& d, double distance) {
    if (std::abs(a.arc[i] - b.arc[j]) > apart) visit(i, j, d, distance);
  });
}

/// What presses on one point: sums over the points of the other segment.
struct PointSums {
  bool touches = false;
  Vector3 force = Vector3::Zero();
  Matrix3 stiffness = Matrix3::Zero();
  /// Stiffness by nodes of the other segment (rows) and by the entries of a 3 x 3 block.
  Eigen::Matrix<double, 4, 9> across = Eigen::Matrix<double, 4, 9>::Zero();
};

/// Adds what presses on the points of one segment to the rows of its four nodes, from `first` on.
void collect(const SegmentSamples& samples, const std::vector<PointSums>& sums, int first,
             Order order, Element<24>& out) {
  Eigen::Matrix<double, 16, 9> stiffness = Eigen::Matrix<double, 16, 9>::Zero();
  for (size_t i = 0; i < sums.size(); ++i) {
    if (!sums[i].touches) continue;
    const Eigen::Map<const Eigen::Vector4d> w(samples.value[i].data());
    for (int k = 0; k < 4; ++k) out.gradient.segment<3>(first + 3 * k) += w[k] * sums[i].force;
    if (order == Order::gradient) continue;
    const Eigen::Matrix4d ww = w * w.transpose();
    stiffness += Eigen::Map<const Eigen::Matrix<double, 16, 1>>(ww.data()) *
                 Eigen::Map<const Eigen::Matrix<double, 1, 9>>(sums[i].stiffness.data());
  }
  if (order == Order::gradient) return;
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < 4; ++l)
      for (int c = 0; c < 9; ++c)
        out.hessian(first + 3 * k + c % 3, first + 3 * l + c / 3) = stiffness(4 * l + k, c);
}

}  // namespace

Element<24> contact_element(const Eigen::Matrix<double, 24, 1>& x, const SegmentSamples& a,
                            const SegmentSamples& b, double apart, const ContactLaw& law,
                            Order order) {
  Element<24> out;
  thread_local Points p, q;
  thread_local std::vector<PointSums> sums_p, sums_q;
  place(a, x.data(), p);
  place(b, x.data() + 12, q);
  sums_p.assign(p.size(), {}), sums_q.assign(q.size(), {});
  const double weight = a.spacing * b.spacing;
  // Per pair of points: d gap/dp = n, d2 gap/dp dp = (I - n n')/distance, the opposite for q. They
  // are summed by points first, which share their nodes' weights.
  for_touching(a, b, p, q, law, apart, [&](size_t i, size_t j, const Vector3& d, double distance) {
    const double gap = distance - 1;
    out.energy += weight * law.energy(gap);
    if (order == Order::energy) return;
    const Vector3 n = d / distance;
    const double slope = weight * law.slope(gap), curvature = weight * law.curvature(gap);
    sums_p[i].touches = sums_q[j].touches = true;
    sums_p[i].force += slope * n;
    sums_q[j].force -= slope * n;
    if (order == Order::gradient) return;
    const Matrix3 m = (curvature - slope / distance) * n * n.transpose() +
                      (slope / distance) * Matrix3::Identity();
    sums_p[i].stiffness += m;
    sums_q[j].stiffness += m;
    sums_p[i].across += Eigen::Map<const Eigen::Vector4d>(b.value[j].data()) *
                        Eigen::Map<const Eigen::Matrix<double, 1, 9>>(m.data());
  });
  if (order == Order::energy) return out;
  collect(a, sums_p, 0, order, out);
  collect(b, sums_q, 12, order, out);
  if (order == Order::gradient) return out;
  Eigen::Matrix<double, 4, 36> across = Eigen::Matrix<double, 4, 36>::Zero();
  for (size_t i = 0; i < p.size(); ++i)
    if (sums_p[i].touches)
      across += Eigen::Map<const Eigen::Vector4d>(a.value[i].data()) *
                Eigen::Map<const Eigen::Matrix<double, 1, 36>>(sums_p[i].across.data());
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < 4; ++l)
      for (int c = 0; c < 9; ++c)
        out.hessian(3 * k + c % 3, 12 + 3 * l + c / 3) = -across(k, 4 * c + l);
  out.hessian.bottomLeftCorner<12, 12>() = out.hessian.topRightCorner<12, 12>().transpose();
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
  double smallest = 1 + pattern_gap;
  for_near(p, q, smallest, [&](size_t, size_t, const Vector3&, double distance) {
    smallest = std::min(smallest, distance);
  });
  return smallest - 1;
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
    for (int k = 0; k < 24; ++k)
      values[k] = x[at.coordinates[k]], change[k] = dx[at.coordinates[k]];
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
    for_touching(a, b, p, q, law_, exclusion,
                 [&](size_t i, size_t j, const Vector3&, double distance) {
                   list.push_back({at.a, at.b, inside(a, i), inside(b, j), distance - 1,
                                   -a.spacing * b.spacing * law_.slope(distance - 1)});
                 });
  }
  return list;
}

}  // namespace bight::rod1d
