#pragma once

#include <cmath>

namespace bight {

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

}  // namespace bight
