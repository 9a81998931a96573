#pragma once

namespace bight {

/// Normal contact as a function of the gap g between two surfaces (negative: overlap).
///
///   force f(g) = 0 (g >= w/2),  k (w/2 - g)^2 / (2 w) (|g| < w/2),  -k g (g <= -w/2)
///
/// A linear penalty whose kink is rounded over a width w, so that the energy is C2: the quadratic
/// onset keeps Newton from chattering when samples touch or part. Per sample, times its weight.
struct ContactLaw {
  double stiffness = 1;  ///< k: force per overlap (per length for a rod, per area for a solid)
  double onset = 0.005;  ///< w: width of the rounded kink [D]

  /// Energy [k D^2]: minus the integral of f.
  double energy(double g) const {
    const double p = 0.5 * onset - g;
    if (p <= 0) return 0;
    if (p < onset) return stiffness * p * p * p / (6 * onset);
    return 0.5 * stiffness * (g * g + onset * onset / 12);
  }
  /// d energy / d gap = -f(g), never positive.
  double slope(double g) const {
    const double p = 0.5 * onset - g;
    if (p <= 0) return 0;
    if (p < onset) return -0.5 * stiffness * p * p / onset;
    return stiffness * g;
  }
  /// d^2 energy / d gap^2, never negative.
  double curvature(double g) const {
    const double p = 0.5 * onset - g;
    if (p <= 0) return 0;
    if (p < onset) return stiffness * p / onset;
    return stiffness;
  }
  bool touches(double g) const { return g < 0.5 * onset; }
};

}  // namespace bight
