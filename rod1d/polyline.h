#pragma once

#include "mechanics/types.h"

namespace bight::rod1d {

double polyline_length(const Polyline& line);

/// `segments` + 1 points at equal distances along the line.
Polyline resampled(const Polyline& line, int segments);

/// Rounds corners by repeated averaging of neighbours, over about `width` (a standard deviation);
/// the ends stay. The line should have equal segments, shorter than the width.
Polyline smoothed(Polyline line, double width);

/// Moved and turned so that the chord between the ends lies on the z axis, its middle at 0.
Polyline chord_on_axis(const Polyline& line);

/// Smallest distance between segments whose midpoints are more than `apart` from each other along
/// the line.
double smallest_distance(const Polyline& line, double apart);

}  // namespace bight::rod1d
