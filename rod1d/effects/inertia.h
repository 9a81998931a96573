#pragma once

#include "rod1d/rod.h"

namespace bight::rod1d {

/// Inertia of the rod, by coordinates: every node carries rho A times half the length on either
/// side, every segment turns about its tangent with rho J l, J = pi D^4/32   [rho D^3, rho D^5].
///
/// The angles are counted from frames that are carried along without spin, so their rate is the
/// spin of the section. Turning of a section about its diameters is left out: it is smaller than
/// the motion of the centerline by (D/wave length)^2.
inline Vector lumped_mass(const Rod& rod, bool twist) {
  Vector mass = Vector::Zero(3 * rod.nodes() + (twist ? rod.segments() : 0));
  for (int i = 0; i < rod.segments(); ++i) {
    const double half = 0.5 * rod.mass_per_length * rod.rest_length[i];
    for (const int node : {i, i + 1}) mass.segment<3>(Rod::position(node)).array() += half;
    if (twist) mass[rod.angle(i)] = rod.spin_inertia * rod.rest_length[i];
  }
  return mass;
}

}  // namespace bight::rod1d
