#include "rod1d/contact_pairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace bight::rod1d {

namespace {

constexpr int leaf_size = 8;
/// Turning below which no two points of a stretch of rod can touch, with room for moves until the
/// next search: the chord is longer than 0.87 of the length [rad].
constexpr double least_turn = 1;

/// Boxes over runs of segments, halved down to leaves; node k has the children 2k + 1 and 2k + 2.
class ArcTree {
 public:
  ArcTree(const Vector& x, const std::vector<double>& arc, double reach, double exclusion)
      : x_(x), arc_(arc), reach_(reach), exclusion_(exclusion) {
    turned_.assign(arc.size(), 0.0);
    for (size_t i = 1; i + 1 < arc.size(); ++i) {
      const Vector3 e0 = node(static_cast<int>(i)) - node(static_cast<int>(i) - 1);
      const Vector3 e1 = node(static_cast<int>(i) + 1) - node(static_cast<int>(i));
      turned_[i] = turned_[i - 1] + std::atan2(e0.cross(e1).norm(), e0.dot(e1));
    }
    turned_.back() = turned_[arc.size() - 2];
    grow(0, 0, static_cast<int>(arc.size()) - 1);
  }

  void meet(size_t a, size_t b, std::vector<std::pair<int, int>>& pairs) const {
    const Box &A = boxes_[a], &B = boxes_[b];
    const double apart = std::max((A.low - B.high).maxCoeff(), (B.low - A.high).maxCoeff());
    if (apart > reach_ || !may_meet(A.begin, B.end - 1)) return;
    const bool leaf_a = is_leaf(A), leaf_b = is_leaf(B);
    if (leaf_a && leaf_b) {
      for (int i = A.begin; i < A.end; ++i)
        for (int j = std::max(i + 1, B.begin); j < B.end; ++j)
          if (near(i, j)) pairs.emplace_back(i, j), pairs.emplace_back(j, i);
    } else if (a == b) {
      meet(2 * a + 1, 2 * a + 1, pairs);
      meet(2 * a + 1, 2 * a + 2, pairs);
      meet(2 * a + 2, 2 * a + 2, pairs);
    } else if (leaf_b || (!leaf_a && A.end - A.begin >= B.end - B.begin)) {
      meet(2 * a + 1, b, pairs);
      meet(2 * a + 2, b, pairs);
    } else {
      meet(a, 2 * b + 1, pairs);
      meet(a, 2 * b + 2, pairs);
    }
  }

 private:
  struct Box {
    int begin = 0, end = 0;
    Vector3 low, high;
  };
  static bool is_leaf(const Box& box) { return box.end - box.begin <= leaf_size; }
  Vector3 node(int i) const { return x_.segment<3>(3 * i); }

  void grow(size_t k, int begin, int end) {
    if (k >= boxes_.size()) boxes_.resize(k + 1);
    boxes_[k].begin = begin, boxes_[k].end = end;
    Vector3 low = node(begin), high = low;
    if (!is_leaf(boxes_[k])) {
      const int middle = (begin + end) / 2;
      grow(2 * k + 1, begin, middle);
      grow(2 * k + 2, middle, end);
      low = boxes_[2 * k + 1].low.cwiseMin(boxes_[2 * k + 2].low);
      high = boxes_[2 * k + 1].high.cwiseMax(boxes_[2 * k + 2].high);
    } else {
      for (int i = begin; i <= end; ++i) low = low.cwiseMin(node(i)), high = high.cwiseMax(node(i));
    }
    boxes_[k].low = low, boxes_[k].high = high;
  }

  /// Segments i to j are long enough, and turn enough, for i and j to be near each other. A curve
  /// of length s that turns by less than a has a chord longer than s cos(a/2) (Schur).
  bool may_meet(int i, int j) const {
    return arc_[j + 1] - arc_[i] >= exclusion_ && turned_[j] - turned_[i] >= least_turn;
  }

  bool near(int i, int j) const {
    if (!may_meet(i, j)) return false;
    const double half_lengths =
        0.5 * ((node(i + 1) - node(i)).norm() + (node(j + 1) - node(j)).norm());
    const double limit = reach_ + half_lengths;
    return (node(i) + node(i + 1) - node(j) - node(j + 1)).squaredNorm() < 4 * limit * limit;
  }

  const Vector& x_;
  const std::vector<double>& arc_;
  double reach_, exclusion_;
  std::vector<double> turned_;  ///< sum of the angles at the nodes up to each [rad]
  std::vector<Box> boxes_;
};

}  // namespace

std::vector<ContactWindow> contact_windows(const Vector& x, const std::vector<double>& arc,
                                           double reach, double exclusion) {
  std::vector<std::pair<int, int>> pairs;
  ArcTree(x, arc, reach, exclusion).meet(0, 0, pairs);
  std::sort(pairs.begin(), pairs.end());
  std::vector<ContactWindow> windows;
  for (const auto& [i, j] : pairs) {
    if (!windows.empty() && windows.back().segment == i && windows.back().last + 1 == j)
      ++windows.back().last;
    else
      windows.push_back({i, j, j});
  }
  return windows;
}

}  // namespace bight::rod1d
