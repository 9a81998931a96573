#pragma once

#include <vector>

#include "mechanics/types.h"

namespace bight::rod1d {

/// Where the nodes of a rod lie: short segments where strands are near each other, long ones where
/// the rod is by itself. Without friction and inertia an equilibrium remembers no material points,
/// so that the nodes may follow the knot along the rod: relative to the knot they hardly move.

/// Segment length wished for at the points of a centerline [D], by their undeformed arc length:
///
///   h = 0.3 + 0.12 gap,  0.1 <= h <= 0.07/kappa,  |dh/ds| <= 0.15,  h = 0.1 at both ends
///
/// The ends' segments are gripped, and straight: long ones would shorten the rod that is free to
/// bend. gap: to the nearest strand that has come back, which means that its distance is below 0.6
/// of the arc length between. kappa: curvature. About n^2 for n points.
std::vector<double> wished_lengths(const std::vector<double>& arc, const Polyline& line);

/// Arc lengths of `segments` + 1 nodes from the first to the last of `arc`, whose segments are in
/// proportion to the lengths wished for. Node `fixed`, if not negative, is put at `fixed_arc`.
std::vector<double> spread_nodes(const std::vector<double>& arc, const std::vector<double>& wished,
                                 int segments, int fixed = -1, double fixed_arc = 0);

/// Points of a centerline with nodes at `arc` that lie at `wanted`, by the curve through the nodes.
Polyline points_at(const std::vector<double>& arc, const Polyline& line,
                   const std::vector<double>& wanted);

}  // namespace bight::rod1d
