#include "rod1d/figure_eight.h"

#include <cmath>
#include <numbers>

#include "rod1d/loose_start.h"
#include "rod1d/polyline.h"

namespace bight::rod1d {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double apart = 1.36;         ///< of neighbouring strands of the braid [D]
constexpr double shortest_tail = 0.8;  ///< straight, on the axis [D]
constexpr double corner_width = 0.3;   ///< over which corners are rounded [D]
constexpr double spacing = 0.1;        ///< of the points while shaping [D]

/// Height of one half-turn of two strands about each other; four make the braid.
double half_turn(double R) { return 0.83 * std::sqrt(R); }

/// Adds a strand that enters the braid at the bottom in `place` (-1 left, 0, 1 right) and returns
/// the place at which it leaves.
int add_strand(Polyline& line, int place, double height) {
  constexpr int steps = 30;
  for (int level = 0; level < 4; ++level) {
    // The left pair turns at even levels, the right pair the other way at odd ones.
    const double middle = (level % 2 == 0 ? -0.5 : 0.5) * apart, side = place * apart - middle;
    const bool turns = std::abs(side) < apart;
    const double over = level % 2 == 0 ? 1 : -1;
    for (int i = 0; i <= steps; ++i) {
      const double u = static_cast<double>(i) / steps, angle = turns ? pi * u : 0.0;
      line.push_back({middle + side * std::cos(angle), -over * side * std::sin(angle),
                      (level + u - 2) * height});
    }
    if (turns) place = static_cast<int>(std::lround((middle - side) / apart));
  }
  return place;
}

/// Adds a loop of radius R on one side, from the top of the braid round to its bottom.
void add_loop(Polyline& line, int side, double R, double half_height) {
  const double center = apart + std::sqrt(R * R - half_height * half_height);
  const double open = std::asin(half_height / R);
  constexpr int steps = 200;
  for (int i = 1; i < steps; ++i) {
    const double angle = pi - open - (2 * pi - 2 * open) * i / steps;
    line.push_back({side * (center + R * std::cos(angle)), 0, R * std::sin(angle)});
  }
}

/// The knot without tails.
Polyline shape(double R) {
  const double height = half_turn(R), top = 2 * height;
  Polyline line{{0, 0, -top - shortest_tail}};
  int place = 0;
  for (int strand = 0; strand < 3; ++strand) {
    place = add_strand(line, place, height);
    if (strand < 2) add_loop(line, place, R, top);
  }
  line.push_back({0, 0, top + shortest_tail});
  const int segments = static_cast<int>(std::ceil(polyline_length(line) / spacing));
  return smoothed(resampled(line, segments), corner_width);
}

}  // namespace

Polyline figure_eight_start(double length, double ebar, int segments) {
  return loose_start({"figure-eight", loosest_figure_eight, 3.1, shape}, length, ebar, segments);
}

}  // namespace bight::rod1d
