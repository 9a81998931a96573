#pragma once

#include <algorithm>
#include <cmath>

namespace bight {

/// A path of frictionless equilibria that not even steps this short in ebar can follow has come to
/// a fold: behind it the knot snaps.
constexpr double fold_step = 0.01;

/// A frictionless equilibrium of a path.
struct Equilibrium {
  double ebar = 0, energy = 0, tension = 0;
};

/// Energy that a step has lost, beyond what the ends' work explains: dE = -T debar, with T between
/// its values before and behind. Zero where that is within the error of the mesh.
inline double energy_lost(const Equilibrium& from, const Equilibrium& to) {
  constexpr double share_of_work = 0.05, share_of_energy = 2e-3;
  const double step = from.ebar - to.ebar;
  const double least = from.energy + std::min(from.tension * step, to.tension * step);
  const double lost = least - to.energy;
  const double error =
      share_of_work * std::abs(from.tension * step) + share_of_energy * from.energy;
  return lost > error ? lost : 0;
}

}  // namespace bight
