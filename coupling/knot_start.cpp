#include "coupling/knot_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/errors.h"
#include "coupling/read_centerline.h"
#include "mechanics/knot_type.h"
#include "rod1d/knots.h"

namespace bight::coupling {
namespace {

// A file's length may differ this much from rod.length; the rod takes up the difference as it
// relaxes.
constexpr double length_tolerance = 0.02;
// Points of a file nearer than this are noise, and of the start that is made of them, per diameter.
constexpr double shortest = 0.05, start_points = 10;

Polyline from_file(const Scene& scene) {
  const Polyline points = read_centerline(scene.centerline);
  const int parts = static_cast<int>(std::ceil(start_points * scene.slenderness()));
  Polyline line = evenly_spaced(points, shortest * scene.diameter, parts);
  const double length = arc_length(line);
  if (std::abs(length / scene.length - 1) > length_tolerance)
    throw InputError(fmt::format("{} is {:.6g} m long, but rod.length is {:.6g} m",
                                 scene.centerline.string(), length, scene.length));
  if (knot_determinant(line) != knot_determinant(points))
    throw InputError(scene.centerline.string() +
                     ": the points are too far apart to tell the knot; straight lines and a spline "
                     "between them make different ones");
  align_with_z(line);
  for (Vector3& point : line) point *= scene.slenderness() / length;
  return line;
}

}  // namespace

Polyline knot_start(const Scene& scene) {
  if (!scene.centerline.empty()) return from_file(scene);
  return {};
}

int checked_determinant(const Scene& scene) {
  if (scene.centerline.empty()) return rod1d::find_knot(scene.knot).determinant;
  rod1d::RodParameters rod;
  rod.length = scene.slenderness();
  rod.contact = scene.contact;
  rod.segments = scene.segments;
  rod.follow_knot = scene.follow_knot;
  rod.start = knot_start(scene);
  try {
    return check_start(rod);
  } catch (const std::invalid_argument& error) {
    throw InputError(scene.centerline.string() + ": " + error.what());
  }
}

}  // namespace bight::coupling
