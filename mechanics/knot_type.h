#pragma once

#include "mechanics/types.h"

namespace bight {

/// Determinant |Alexander polynomial at t = -1| of the knot that an open centerline makes when its
/// ends are led far away along their tangents and joined there: 1 unknot, 3 trefoil (overhand),
/// 5 figure-eight, 15 ... Always odd; 0 when the centerline meets itself, so that there is no
/// answer. Exact below 10^9. A sweep over sorted segments: about n log n for n nodes.
int knot_determinant(const Polyline& centerline);

}  // namespace bight
