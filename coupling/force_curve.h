#pragma once

#include <optional>
#include <string>
#include <vector>

namespace bight::coupling {

/// Tbar against ebar along a path, in the order in which it was visited.
struct ForceCurve {
  std::string name;
  std::vector<double> ebar, force;
  std::vector<double> spread = {};  ///< of a measurement: half the width of its band; may be empty
};

/// Cuts a curve where ebar turns back by more than 2 % of its range; points of a leg that do not
/// advance (noise of a measurement) are left out.
std::vector<ForceCurve> legs(const ForceCurve& curve);

/// Spread of one leg at ebar, the same way; nothing where it has none.
std::optional<double> spread_at(const ForceCurve& leg, double ebar);

/// Tbar of one leg at ebar: monotone cubic (Fritsch and Carlson 1980), nothing outside the leg.
std::optional<double> force_at(const ForceCurve& leg, double ebar);

/// Loose-knot law (Audoly, Clauvelin, Neukirch, PRL 99, 164301, 2007):
/// Tbar = pi^2/(2 ebar^2) +- 0.492 mu pi^1.5/ebar^1.5, + while tightening. Nothing for ebar <= 0.
std::optional<double> loose_knot_law(double ebar, double friction, bool tightening);

}  // namespace bight::coupling
