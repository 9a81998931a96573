#pragma once

#include <vector>

#include "mechanics/unknowns.h"
#include "rod1d/rod.h"

namespace bight::rod1d {

/// Both ends are gripped on the z axis: the first two and the last two nodes are held, so that the
/// rod leaves its grips along the axis (clamped). The grips move apart alike, z = 0 halfway.
///
/// `twist`: the angles of the first segment and, unless the finish may turn about the axis, of the
/// last one are held as well.
std::vector<bool> held_coordinates(const Rod& rod, bool twist, bool finish_turns);

/// Moves the gripped nodes to the end-to-end distance `length` [D].
void place_grips(const Rod& rod, double length, Vector& x);

/// Forces that pull the grips apart, from the gradient of the energy at an equilibrium [E D^2], and
/// the torque about the pulling axis that turns the finish [E D^3], zero where it is free or twist
/// is not simulated.
struct GripForces {
  double start = 0, finish = 0, torque = 0;
  double tension() const { return 0.5 * (start + finish); }
};
GripForces grip_forces(const Rod& rod, const Vector& gradient);

}  // namespace bight::rod1d
