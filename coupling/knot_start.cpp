#include "coupling/knot_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/errors.h"
#include "coupling/read_centerline.h"

namespace bight::coupling {
namespace {

// A file's length may differ this much from rod.length; the rod takes up the difference as it
// relaxes.
constexpr double length_tolerance = 0.02;

Polyline from_file(const Scene& scene) {
  Polyline line = read_centerline(scene.centerline);
  const double length = arc_length(line);
  if (std::abs(length / scene.length - 1) > length_tolerance)
    throw InputError(fmt::format("{} is {:.6g} m long, but rod.length is {:.6g} m",
                                 scene.centerline.string(), length, scene.length));
  align_with_z(line);
  for (Vector3& point : line) point *= scene.slenderness() / length;
  return line;
}

}  // namespace

Polyline knot_start(const Scene& scene) {
  if (!scene.centerline.empty()) return from_file(scene);
  return {};
}

}  // namespace bight::coupling
