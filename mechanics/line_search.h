#pragma once

#include <cmath>
#include <utility>

namespace bight {

/// How far above the last energy a step may end. Contact carves curved stiff valleys along very
/// soft modes (the rod rolling, the knot sliding); a search that insists on falling energy crawls
/// along them. The rise allowed decays with every iteration, so the iteration still settles.
struct EnergyBound {
  double first_rise = 0;  ///< allowed at the first iteration [energy]
  double decay = 0.8;     ///< per iteration
  double allowed(int iteration) const { return first_rise * std::pow(decay, iteration); }
};

struct LineSearchResult {
  double step = 0;    ///< accepted fraction of the direction; 0 when none was
  double energy = 0;  ///< there
  int evaluations = 0;
};

/// Halves the step from the longest admissible one until the energy is within the bound.
/// `energy_at(step)` may be infinite for an inadmissible state.
template <class EnergyAt>
LineSearchResult search(EnergyAt&& energy_at, double energy, double rise, double longest) {
  constexpr int max_halvings = 12;
  LineSearchResult result;
  double step = longest;
  for (int i = 0; i <= max_halvings; ++i, step *= 0.5) {
    const double trial = energy_at(step);
    ++result.evaluations;
    if (trial <= energy + rise) {
      result.step = step;
      result.energy = trial;
      return result;
    }
  }
  return result;
}

}  // namespace bight
