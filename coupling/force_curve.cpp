#include "coupling/force_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bight::coupling {
namespace {

double slope(const ForceCurve& leg, size_t i) {
  return (leg.force[i + 1] - leg.force[i]) / (leg.ebar[i + 1] - leg.ebar[i]);
}

// Slope at a point: the harmonic mean of its neighbours', 0 at an extremum (keeps the cubic monotone).
double slope_at(const ForceCurve& leg, size_t i) {
  const size_t last = leg.ebar.size() - 1;
  if (i == 0) return slope(leg, 0);
  if (i == last) return slope(leg, last - 1);
  const double before = slope(leg, i - 1), after = slope(leg, i);
  if (before * after <= 0) return 0;
  const double h0 = std::abs(leg.ebar[i] - leg.ebar[i - 1]);
  const double h1 = std::abs(leg.ebar[i + 1] - leg.ebar[i]);
  return 3 * (h0 + h1) / ((2 * h1 + h0) / before + (h1 + 2 * h0) / after);
}

}  // namespace

std::vector<ForceCurve> legs(const ForceCurve& curve) {
  std::vector<ForceCurve> result;
  if (curve.ebar.empty()) return result;
  const auto [low, high] = std::ranges::minmax(curve.ebar);
  const double turn = 0.02 * (high - low);
  result.push_back({curve.name, {curve.ebar[0]}, {curve.force[0]}});
  double direction = 0;  // of the current leg, once known
  for (size_t i = 1; i < curve.ebar.size(); ++i) {
    const double ahead = curve.ebar[i] - result.back().ebar.back();
    if (ahead == 0) continue;
    if (direction == 0) direction = ahead;
    if (direction * ahead < 0) {
      if (std::abs(ahead) <= turn) continue;
      const double from = result.back().ebar.back(), force = result.back().force.back();
      result.push_back({curve.name, {from}, {force}});
      direction = ahead;
    }
    result.back().ebar.push_back(curve.ebar[i]);
    result.back().force.push_back(curve.force[i]);
  }
  return result;
}

std::optional<double> force_at(const ForceCurve& leg, double ebar) {
  const size_t points = leg.ebar.size();
  for (size_t i = 0; i < points; ++i)
    if (leg.ebar[i] == ebar) return leg.force[i];
  for (size_t i = 0; i + 1 < points; ++i) {
    if ((ebar - leg.ebar[i]) * (ebar - leg.ebar[i + 1]) > 0) continue;
    const double h = leg.ebar[i + 1] - leg.ebar[i], t = (ebar - leg.ebar[i]) / h;
    const double m0 = h * slope_at(leg, i), m1 = h * slope_at(leg, i + 1);
    return leg.force[i] * (1 + 2 * t) * (1 - t) * (1 - t) + m0 * t * (1 - t) * (1 - t) +
           leg.force[i + 1] * t * t * (3 - 2 * t) + m1 * t * t * (t - 1);
  }
  return std::nullopt;
}

std::optional<double> loose_knot_law(double ebar, double friction, bool tightening) {
  if (ebar <= 0) return std::nullopt;
  constexpr double pi = std::numbers::pi;
  const double frictional = 0.492 * friction * std::pow(pi / ebar, 1.5);
  return pi * pi / (2 * ebar * ebar) + (tightening ? frictional : -frictional);
}

}  // namespace bight::coupling
