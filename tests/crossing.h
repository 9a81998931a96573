#pragma once

namespace bight::test {

/// Where in (0, 1) the cubic through two values and their slopes (by time, h apart) crosses zero:
/// the values have opposite signs.
inline double crossing(double q0, double v0, double q1, double v1, double h) {
  double low = 0, high = 1;
  for (int k = 0; k < 60; ++k) {
    const double u = 0.5 * (low + high), w = 1 - u;
    const double value =
        w * w * (1 + 2 * u) * q0 + u * u * (3 - 2 * u) * q1 + u * w * h * (w * v0 - u * v1);
    ((value < 0) == (q0 < 0) ? low : high) = u;
  }
  return low;
}

}  // namespace bight::test
