#pragma once

#include <vector>

#include "rod1d/frames.h"

namespace bight::rod1d {

/// A state on other nodes of the same rod, as many as before. `arc`: undeformed arc length of the
/// nodes [D], of old and new ones. Positions are taken from the curve through the old nodes, twist
/// angles (where x has them) from those of the segments' middles, in between linearly: errors of
/// the third and the second order in the segments' lengths.
Vector remeshed(const std::vector<double>& arc, const Vector& x, const std::vector<double>& wanted);

/// Reference frames of a state on its new nodes, x_wanted: the old ones, carried to the new
/// tangents and, in between, turned about them in proportion. Turns beyond one are kept.
Frames remeshed(const std::vector<double>& arc, const Frames& frames,
                const std::vector<double>& wanted, const Vector& x_wanted);

/// Changes the angles of a remeshed state so that its twist, as a function of arc length, is that
/// of the old one. The segment `fixed` keeps its angle. Linear interpolation alone would add what
/// the frames' holonomy differs by, in every step again. A free end then turns by what the writhe
/// of the new polyline differs by; ends that are `held` keep their angles, and that is spread as
/// twist.
void keep_twist(const std::vector<double>& arc, const Vector& x, const Frames& frames,
                const std::vector<double>& wanted, const Frames& frames_wanted, int fixed,
                bool start_held, bool finish_held, Vector& x_wanted);

}  // namespace bight::rod1d
