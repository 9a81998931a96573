#pragma once

#include "mechanics/types.h"

namespace bight::rod1d {

/// Smallest ebar at which overhand_start() can tie its loose knot.
constexpr double loosest_overhand = 26;

/// A loose overhand knot without overlap, as a start to relax: `segments` + 1 points at equal
/// distances along a line of the given length [D], ends on the z axis and tangent to it, ends
/// `length` - ebar apart. Both ends of a loop run through one another's braid of three half-turns.
/// Throws std::invalid_argument where the length cannot hold that ebar.
Polyline overhand_start(double length, double ebar, int segments);

}  // namespace bight::rod1d
