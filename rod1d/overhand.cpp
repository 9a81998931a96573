#include "rod1d/overhand.h"

#include <cmath>
#include <numbers>

#include "rod1d/loose_start.h"
#include "rod1d/polyline.h"

namespace bight::rod1d {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double braid_radius = 0.68;  ///< of each strand about the z axis [D]
constexpr double shortest_tail = 0.8;  ///< straight, on the axis [D]
constexpr double corner_width = 0.3;   ///< over which corners are rounded [D]
constexpr double spacing = 0.1;        ///< of the points while shaping [D]

/// Half the height of the braid around which a loop of radius R closes: grows as sqrt(R), as in the
/// matched asymptotic solution of Audoly et al. 2007.
double half_braid(double R) { return 1.25 * std::sqrt(R); }
/// Height over which a tail comes from the axis to the braid: the loop must have left by then.
double lead(double R) { return 0.75 * std::sqrt(R); }

/// The knot without tails, from axis to axis: into the braid on the -x side, three half-turns,
/// round the loop on the +x side, three half-turns, out on the -x side.
Polyline shape(double R) {
  const double b = half_braid(R), r = braid_radius, top = b + lead(R);
  Polyline line{{0, 0, -top - shortest_tail}, {0, 0, -top}};
  const auto braid = [&](double phase) {
    const int steps = 60;
    for (int i = 0; i <= steps; ++i) {
      const double u = static_cast<double>(i) / steps, angle = phase + 3 * pi * u;
      line.push_back({r * std::cos(angle), r * std::sin(angle), b * (2 * u - 1)});
    }
  };
  braid(pi);
  const double center = r + std::sqrt(R * R - b * b), open = std::asin(b / R);
  const int steps = 200;
  for (int i = 1; i < steps; ++i) {
    const double angle = pi - open - (2 * pi - 2 * open) * i / steps;
    line.push_back({center + R * std::cos(angle), 0, R * std::sin(angle)});
  }
  braid(2 * pi);
  line.insert(line.end(), {Vector3(0, 0, top), Vector3(0, 0, top + shortest_tail)});
  const int segments = static_cast<int>(std::ceil(polyline_length(line) / spacing));
  return smoothed(resampled(line, segments), corner_width);
}

}  // namespace

Polyline overhand_start(double length, double ebar, int segments) {
  return loose_start({"overhand", loosest_overhand, 2.2, shape}, length, ebar, segments);
}

}  // namespace bight::rod1d
