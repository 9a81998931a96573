#include "rod1d/flattening.h"

#include <cmath>
#include <numbers>

namespace bight::rod1d {

double flattening_energy(const std::vector<RubbingPoint>& pieces, double poissons_ratio) {
  constexpr double R = 0.5;
  const double plane = 1 - poissons_ratio * poissons_ratio;  // (1 - nu^2)/E [1/E]
  double energy = 0;
  for (const RubbingPoint& piece : pieces) {
    const double q = piece.force / piece_length;
    if (q <= 0) continue;
    const double a = std::sqrt(4 * q * R * plane / std::numbers::pi);
    energy += piece_length * q * q * plane / std::numbers::pi * (2 * std::log(4 * R / a) - 0.5);
  }
  return energy;
}

}  // namespace bight::rod1d
