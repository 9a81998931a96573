#pragma once

#include <span>

#include "mechanics/contact_law.h"
#include "mechanics/effect.h"
#include "rod1d/curve.h"

namespace bight::rod1d {

/// Quadrature points of one segment, a row each: weights of its four nodes in the point, and the
/// undeformed arc length from the start of the rod to it [D].
struct SegmentSamples {
  SegmentSamples() = default;
  /// `count` points in the middles of equal parts of a segment that begins at `arc`.
  SegmentSamples(const CurveSegment& curve, int count, double begin);

  Eigen::Matrix<double, Eigen::Dynamic, 4> value;
  Eigen::ArrayXd arc;
  double spacing = 0;  ///< undeformed arc length that each stands for [D]
  int size() const { return static_cast<int>(value.rows()); }
};

/// A quadrature point i of one segment, and those of another from `first` to `last`.
struct PointRun {
  int i, first, last;
};

/// Contact between two segments of the round tube, as a double integral over their centerlines:
///
///   W = sum over s, t of ds dt law(|p(s) - q(t)| - 1)   [E D^3]
///
/// by the midpoint rule. Unlike the distance to a nearest point, which ceases to be smooth where
/// one strand winds around the other with curvature 1/D (every point of the bend is nearest then,
/// as in a tight knot), this is as smooth as the law, and needs no projection. The law is of short
/// range, so that along a line of contact only points within sqrt(2 onset) of each other count.
/// `runs` hold all that touch. x: four nodes of either segment.
void contact_element(const Eigen::Matrix<double, 24, 1>& x, const SegmentSamples& a,
                     const SegmentSamples& b, std::span<const PointRun> runs, const ContactLaw& law,
                     Order order, ElementSlot& slot);

}  // namespace bight::rod1d
