#pragma once

#include "mechanics/types.h"

namespace bight::rod1d {

/// Smallest ebar at which figure_eight_start() can tie its loose knot.
constexpr double loosest_figure_eight = 54;

/// A loose figure-eight knot without overlap, as overhand_start() makes overhand knots. Three
/// strands side by side are braided (over the left, under the right, twice: sigma1 sigma2^-1 sigma1
/// sigma2^-1); a loop on either side closes the outer strands, the ends are those of the middle
/// one.
Polyline figure_eight_start(double length, double ebar, int segments);

}  // namespace bight::rod1d
