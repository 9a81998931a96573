#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "rod1d/contact_element.h"

namespace bight::rod1d {

/// Positions of the quadrature points of a segment, a row each.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// nodes: the four around the segment.
inline void place(const SegmentSamples& samples, const double* nodes, Points& points) {
  points.noalias() =
      samples.value.lazyProduct(Eigen::Map<const Eigen::Matrix<double, 3, 4>>(nodes).transpose());
}

/// Squares of the distances of the rows of q from `first` on to p.
template <class Squares>
void squares_to(const Vector3& p, const Points& q, int first, Squares&& out) {
  const auto n = out.size();
  out = (q.col(0).segment(first, n).array() - p.x()).square() +
        (q.col(1).segment(first, n).array() - p.y()).square() +
        (q.col(2).segment(first, n).array() - p.z()).square();
}

/// Calls `visit(i, j, d, distance)` for the points that touch, d from j to i. x: nodes of a, b.
template <class Visit>
void for_touching(std::span<const PointRun> runs, const double* x, const SegmentSamples& a,
                  const SegmentSamples& b, const ContactLaw& law, Visit&& visit) {
  thread_local Points p, q;
  thread_local Eigen::ArrayXd square;
  place(a, x, p);
  place(b, x + 12, q);
  square.resize(std::max<Eigen::Index>(square.size(), b.size()));
  const double reach = 1 + 0.5 * law.onset, limit = reach * reach;
  for (const PointRun& run : runs) {
    const int n = run.last - run.first + 1;
    const Vector3 from = p.row(run.i);
    squares_to(from, q, run.first, square.head(n));
    for (int k = 0; k < n; ++k)
      if (square[k] < limit)
        visit(run.i, run.first + k, Vector3(from - q.row(run.first + k).transpose()),
              std::sqrt(square[k]));
  }
}

}  // namespace bight::rod1d
