#pragma once

#include <vector>

#include "mechanics/types.h"

namespace bight::rod1d {

/// A run of neighbouring segments, first to last, that one segment may touch.
struct ContactWindow {
  int segment, first, last;
};

/// For every segment of the polyline the runs of segments that come within `reach` of it, from
/// midpoint to midpoint less half of both lengths. Left out are pairs whose arc length distance,
/// by `arc` at the nodes, is below `exclusion` throughout, and stretches that are nearly straight.
/// A tree of boxes over the arc: about n log n.
std::vector<ContactWindow> contact_windows(const Vector& x, const std::vector<double>& arc,
                                           double reach, double exclusion);

}  // namespace bight::rod1d
