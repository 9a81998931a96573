#pragma once

#include "mechanics/types.h"

namespace bight {

/// Damping in proportion to mass (Rayleigh's alpha), of motion against the surroundings:
///
///   force -alpha M v,   power lost alpha v . M v   [E D^3 per D sqrt(rho/E)]
///
/// alpha: [1/(D sqrt(rho/E))]. A vibration of angular frequency w decays as exp(-alpha t/2), at
/// the fraction alpha/(2 w) of critical damping.
struct Damping {
  double alpha = 0;
  double power(const Vector& mass, const Vector& v) const {
    return alpha * v.cwiseAbs2().dot(mass);
  }
};

}  // namespace bight
