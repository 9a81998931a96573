#include "rod1d/effects/contact.h"

#include <algorithm>
#include <cmath>

#include "rod1d/touching_points.h"

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
constexpr double list_slack = 0.02;
/// Segments nearer than this are given room in the Hessian's pattern [D].
constexpr double pattern_gap = 0.03;
/// Gap below which no iteration may bring a pair [D].
constexpr double deepest_gap = -0.15;

Eigen::Matrix<double, 24, 1> gather(const Vector& x, const std::array<int, 24>& coordinates) {
  Eigen::Matrix<double, 24, 1> values;
  for (int k = 0; k < 24; ++k) values[k] = x[coordinates[k]];
  return values;
}

}  // namespace

Contact::Contact(const Rod& rod, double spacing)
    : nodes_(rod.nodes()),
      rest_length_(rod.rest_length),
      spacing_(spacing),
      samples_(rod.segments()),
      arc_(rod.arc_length()) {}

/// Quadrature points are made where they are needed: most of a long rod is by itself.
void Contact::make_samples(int k) {
  if (samples_[k].size() > 0) return;
  const CurveSegment curve = curve_segment(rest_length_, k);
  const int count = static_cast<int>(std::ceil(curve.length() / spacing_ - 1e-9));
  samples_[k] = SegmentSamples(curve, count, arc_[k]);
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
  contact_element(gather(x, at.coordinates), samples_[at.a], samples_[at.b], runs_of(at), law_,
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

/// The quadrature points of a segment, and a ball that holds them.
struct Contact::Placed {
  Points points;
  Vector3 middle = Vector3::Zero();
  double radius = -1;  ///< negative: not placed
};

void Contact::place_segment(const Vector& x, int k, Placed& placed) const {
  const auto values = gather(x, stencil(k, k));
  place(samples_[k], values.data(), placed.points);
  const Points& p = placed.points;
  placed.middle = 0.5 * (p.row(0) + p.row(p.rows() - 1));
  placed.radius =
      std::sqrt((p.rowwise() - placed.middle.transpose()).rowwise().squaredNorm().maxCoeff());
}

void Contact::list_runs(const Vector& x) {
  listed_at_ = x;
  listed_.clear(), runs_.clear();
  const double list_gap = 0.5 * law_.onset + list_slack, reach = 1 + list_gap;
  std::vector<Placed> placed(samples_.size());
  Eigen::ArrayXd square;
  double least = reach * reach;
  for_near_segments(x, list_gap, [&](int a, int b) {
    Placed &on_a = placed[a], &on_b = placed[b];
    if (on_a.radius < 0) place_segment(x, a, on_a);
    if (on_b.radius < 0) place_segment(x, b, on_b);
    const auto within = [](const Vector3& d, double limit) {
      return d.squaredNorm() < limit * limit;
    };
    if (!within(on_a.middle - on_b.middle, on_a.radius + on_b.radius + reach)) return;
    SegmentPair found{a, b, runs_.size(), 0, stencil(a, b)};
    const Eigen::ArrayXd &arc_a = samples_[a].arc, &arc_b = samples_[b].arc;
    const int n = static_cast<int>(arc_b.size());
    square.resize(n);
    for (int i = 0; i < static_cast<int>(arc_a.size()); ++i) {
      const Vector3 p = on_a.points.row(i);
      if (!within(p - on_b.middle, on_b.radius + reach)) continue;
      squares_to(p, on_b.points, 0, square.head(n));
      int first = 0, last = n - 1;
      while (first < n && arc_b[first] - arc_a[i] <= exclusion) ++first;
      while (first < n && square[first] >= reach * reach) ++first;
      if (first == n) continue;
      while (square[last] >= reach * reach) --last;
      runs_.push_back({i, first, last});
      least = std::min(least, square.segment(first, last - first + 1).minCoeff());
    }
    found.end = runs_.size();
    if (found.end > found.begin) listed_.push_back(found);
  });
  deepest_ = std::sqrt(least) - 1;
}

void Contact::refresh(const Vector& x) {
  if (searched_.size() == 0 || largest_move(x - searched_) > search_slack) {
    searched_ = x;
    windows_ = contact_windows(x, arc_, 1 + search_gap, exclusion);
    for (const ContactWindow& window : windows_)
      for (int k = window.first; k <= window.last; ++k) make_samples(k);
    listed_at_.resize(0);
  }
  if (listed_at_.size() == 0 || largest_move(x - listed_at_) > 0.5 * list_slack) list_runs(x);
}

void Contact::couplings(const std::function<void(std::span<const int>)>& couple) const {
  for_pattern_segments([&](int a, int b) { couple(stencil(a, b)); });
}

void Contact::for_pattern_segments(const std::function<void(int, int)>& visit) const {
  for_near_segments(listed_at_, pattern_gap, visit);
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
    for (auto i = p.rows() / 8; i < p.rows(); i += 4)
      for (auto j = q.rows() / 8; j < q.rows(); j += 4) {
        const Vector3 d = p.row(i) - q.row(j);
        const double distance = d.norm(),
                     approach = -d.dot(Vector3(dp.row(i) - dq.row(j))) / distance;
        // A pair that is deeper already (a start that overlaps) may still be moved a little.
        const double room = std::max(distance - 1 - deepest_gap, 0.05);
        if (approach * longest > room) longest = room / approach;
      }
  });
  return longest;
}

std::vector<ContactPoint> Contact::points(const Vector& x) const {
  std::vector<ContactPoint> list;
  for (const SegmentPair& at : listed_) {
    const SegmentSamples &a = samples_[at.a], &b = samples_[at.b];
    for_touching(runs_of(at), gather(x, at.coordinates).data(), a, b, law_,
                 [&](int i, int j, const Vector3& d, double distance) {
                   list.push_back({at.a, at.b, (i + 0.5) / a.size(), (j + 0.5) / b.size(), a.arc[i],
                                   b.arc[j], d / distance, distance - 1,
                                   -a.spacing * b.spacing * law_.slope(distance - 1),
                                   a.spacing * b.spacing * law_.curvature(distance - 1)});
                 });
  }
  return list;
}

std::pair<int, double> Contact::touching(const Vector& x) const {
  int count = 0;
  double smallest = 1;
  for (const SegmentPair& at : listed_)
    for_touching(runs_of(at), gather(x, at.coordinates).data(), samples_[at.a], samples_[at.b],
                 law_, [&](int, int, const Vector3&, double distance) {
                   ++count;
                   smallest = std::min(smallest, distance);
                 });
  return {count, 1 - smallest};
}

}  // namespace bight::rod1d
