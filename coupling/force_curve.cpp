#include "coupling/force_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bight::coupling {
namespace {

double slope(const ForceCurve& leg, size_t i) {
  return (leg.force[i + 1] - leg.force[i]) / (leg.ebar[i + 1] - leg.ebar[i]);
}

// Slope at the first of three points through which a parabola runs; not beyond three times the
// slope of the first interval, nor against it (Fritsch and Butland 1984).
double end_slope(double h0, double h1, double slope0, double slope1) {
  const double m = ((2 * h0 + h1) * slope0 - h0 * slope1) / (h0 + h1);
  if (m * slope0 <= 0) return 0;
  return std::abs(m) > 3 * std::abs(slope0) ? 3 * slope0 : m;
}

// Slope at a point: the harmonic mean of its neighbours', 0 at an extremum: the cubic stays
// monotone.
double slope_at(const ForceCurve& leg, size_t i) {
  const size_t last = leg.ebar.size() - 1;
  if (last == 1) return slope(leg, 0);
  const auto width = [&](size_t k) { return std::abs(leg.ebar[k + 1] - leg.ebar[k]); };
  if (i == 0) return end_slope(width(0), width(1), slope(leg, 0), slope(leg, 1));
  if (i == last)
    return end_slope(width(last - 1), width(last - 2), slope(leg, last - 1), slope(leg, last - 2));
  const double before = slope(leg, i - 1), after = slope(leg, i);
  const double h0 = width(i - 1), h1 = width(i);
  if (before * after <= 0) return 0;
  return 3 * (h0 + h1) / ((2 * h1 + h0) / before + (h1 + 2 * h0) / after);
}

// First point, points where ebar turns back by more than 2 % of its range, last extreme point.
std::vector<size_t> turns(const std::vector<double>& ebar) {
  if (ebar.empty()) return {};
  const auto [low, high] = std::ranges::minmax(ebar);
  const double turn = 0.02 * (high - low);
  std::vector<size_t> result = {0};
  double direction = 0;  // unknown until ebar has gone further than noise
  size_t furthest = 0;
  for (size_t i = 1; i < ebar.size(); ++i) {
    const double ahead = ebar[i] - ebar[furthest];
    if (direction == 0 && std::abs(ahead) > turn) direction = ahead;
    if (direction * ahead > 0) {
      furthest = i;
    } else if (direction != 0 && std::abs(ahead) > turn) {
      result.push_back(furthest);
      furthest = i;
      direction = ahead;
    }
  }
  result.push_back(furthest);
  return result;
}

}  // namespace

std::vector<ForceCurve> legs(const ForceCurve& curve) {
  std::vector<ForceCurve> result;
  const std::vector<size_t> ends = turns(curve.ebar);
  for (size_t k = 0; k + 1 < ends.size(); ++k) {
    const double direction = curve.ebar[ends[k + 1]] - curve.ebar[ends[k]];
    ForceCurve leg{curve.name, {}, {}, {}};
    const auto take = [&](size_t i) {
      leg.ebar.push_back(curve.ebar[i]);
      leg.force.push_back(curve.force[i]);
      if (!curve.spread.empty()) leg.spread.push_back(curve.spread[i]);
    };
    take(ends[k]);
    for (size_t i = ends[k] + 1; i <= ends[k + 1]; ++i) {
      if ((curve.ebar[i] - leg.ebar.back()) * direction <= 0) continue;
      take(i);
    }
    result.push_back(std::move(leg));
  }
  if (curve.ebar.size() == 1) result.push_back(curve);
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

std::optional<double> spread_at(const ForceCurve& leg, double ebar) {
  if (leg.spread.empty()) return std::nullopt;
  return force_at({leg.name, leg.ebar, leg.spread, {}}, ebar);
}

std::optional<double> loose_knot_law(double ebar, double friction, bool tightening) {
  if (ebar <= 0) return std::nullopt;
  constexpr double pi = std::numbers::pi;
  const double frictional = 0.492 * friction * std::pow(pi / ebar, 1.5);
  return pi * pi / (2 * ebar * ebar) + (tightening ? frictional : -frictional);
}

}  // namespace bight::coupling
