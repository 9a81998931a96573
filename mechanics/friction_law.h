#pragma once

#include <cmath>

#include "mechanics/effect.h"

namespace bight {

/// Relative motion of two surfaces at which sticking gives way [D].
constexpr double largest_elastic_slip = 0.002;

/// How two places of a rod's skin stick to each other: what friction hands from one model of a knot
/// to the next.
struct Rub {
  double s_a, s_b;       ///< undeformed arc lengths of their sections [D]
  Vector3 elastic_slip;  ///< of a against b, largest_elastic_slip long where they slide [D]
};

/// Coulomb friction with elastic stick, as a convex incremental potential of the slip s >= 0 since
/// the sample last slid, at a normal force N that is frozen during a solve:
///
///   force t(s) = k s (s <= c),  mu N (s > c),  c = mu N / k
///
/// Simo and Laursen, Comput. Struct. 42, 97 (1992), return map, written as a potential so that the
/// tangent stays symmetric. k is the elastic stick stiffness.
struct FrictionLaw {
  double stick_stiffness = 1;  ///< k: force per slip
  double limit = 0;            ///< mu N: largest tangential force

  /// The law at a largest force mu N, with elastic slip up to largest_elastic_slip.
  static FrictionLaw with_limit(double limit) { return {limit / largest_elastic_slip, limit}; }

  double elastic_slip() const { return limit / stick_stiffness; }
  bool slides(double s) const { return s > elastic_slip(); }

  /// Integral of t: k s^2/2 in stick, mu N (s - c/2) in slip.
  double energy(double s) const {
    return slides(s) ? limit * (s - 0.5 * elastic_slip()) : 0.5 * stick_stiffness * s * s;
  }
  /// t(s).
  double slope(double s) const { return slides(s) ? limit : stick_stiffness * s; }
  /// t(s)/s, finite at zero slip.
  double slope_over_slip(double s) const { return slides(s) ? limit / s : stick_stiffness; }
  /// dt/ds.
  double curvature(double s) const { return slides(s) ? 0.0 : stick_stiffness; }
  /// Work lost when a sample has slid to s: mu N (s - c).
  double dissipated(double s) const { return slides(s) ? limit * (s - elastic_slip()) : 0.0; }
};

/// Friction at one place as a function of its slip s, two components in the tangent plane [D]:
///
///   W = law(|s|)   [E D^3]
inline Element<2> friction_element(const Vector2& s, const FrictionLaw& law) {
  Element<2> out;
  const double size = s.norm(), over = law.slope_over_slip(size);
  out.energy = law.energy(size);
  out.gradient = over * s;
  out.hessian = over * Eigen::Matrix2d::Identity();
  if (size > 0) {
    const Vector2 d = s / size;
    out.hessian += (law.curvature(size) - over) * d * d.transpose();
  }
  return out;
}

}  // namespace bight
