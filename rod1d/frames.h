#pragma once

#include <vector>

#include "rod1d/rod.h"

namespace bight::rod1d {

/// Reference frames of the segments at one state: what twist is counted from.
///
/// A material frame is the reference frame turned about the tangent by the segment's angle. While
/// the rod moves, each reference frame is carried along without spin about its tangent
/// (time-parallel; Bergou et al., Discrete Viscous Threads, ACM Trans. Graph. 29, 116, 2010), from
/// the state at which a step begins: the source. Forces do not depend on how the frames were
/// carried, since the angles are unknowns.
struct Frames {
  Polyline tangent, normal;   ///< t and d1 of each segment, unit vectors
  std::vector<double> twist;  ///< at the nodes: turn of frame i against frame i - 1 [rad]; ends: 0

  Vector3 binormal(int segment) const { return tangent[segment].cross(normal[segment]); }
  /// Director d1 of a material frame.
  Vector3 director(int segment, double angle) const {
    return std::cos(angle) * normal[segment] + std::sin(angle) * binormal(segment);
  }
};

/// Unit vector `v` across `from`, carried to `to` by the smallest rotation (unit tangents).
Vector3 transported(const Vector3& v, const Vector3& from, const Vector3& to);

/// Frames without twist (Bishop, Am. Math. Mon. 82, 246, 1975), carried along the rod from its
/// start.
Frames twist_free_frames(const Rod& rod, const Vector& x);

/// The frames of `source` carried to the state x. Their twist grows continuously, by the area
/// between the tangents before and after, so it is not confined to one turn.
Frames carried_frames(const Rod& rod, const Frames& source, const Vector& x);

/// Angle of the material frames against twist-free ones from the start [rad], by segment.
std::vector<double> twist_angles(const Rod& rod, const Frames& frames, const Vector& x);

/// Twist of the material frames over the whole rod, in turns.
double total_twist(const Rod& rod, const Frames& frames, const Vector& x);

}  // namespace bight::rod1d
