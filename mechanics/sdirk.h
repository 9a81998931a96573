#pragma once

#include <arkode/arkode_butcher.h>

namespace bight {

/// Alexander's SDIRK of three stages, of third order, stiffly accurate and L-stable (SIAM J. Numer.
/// Anal. 14, 1006 (1977), theorem 5); the error estimate of second order leaves out the last one.
/// To be freed with ARKodeButcherTable_Free.
inline ARKodeButcherTable sdirk() {
  const double g = 0.43586652150845899942, half = 0.5 * (1 - g);
  const double b1 = -0.25 * (6 * g * g - 16 * g + 1), b2 = 0.25 * (6 * g * g - 20 * g + 5);
  double c[] = {g, 0.5 * (1 + g), 1};
  double A[] = {g, 0, 0, half, g, 0, b1, b2, g};
  double b[] = {b1, b2, g};
  const double d2 = (0.5 - g) / half;
  double d[] = {1 - d2, d2, 0};
  return ARKodeButcherTable_Create(3, 3, 2, c, A, b, d);
}

}  // namespace bight
