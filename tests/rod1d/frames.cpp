#include "rod1d/frames.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "rod1d/measure.h"
#include "rod1d/overhand.h"
#include "rod1d/solid_angle.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

Rod rod_of(int segments) {
  Rod rod;
  rod.rest_length.assign(segments, 1);
  return rod;
}

/// A closed curve in space: node n is node 0, and the last segment repeats the first.
Vector ring(const Rod& rod, double height, double phase) {
  const int n = rod.segments() - 1;
  Vector x = Vector::Zero(3 * rod.nodes() + rod.segments());
  for (int i = 0; i < rod.nodes(); ++i) {
    const double a = 2 * M_PI * i / n;
    x.segment<3>(3 * i) =
        Vector3((2 + std::cos(3 * a)) * std::cos(2 * a), (2 + std::cos(3 * a)) * std::sin(2 * a),
                height * std::sin(3 * a) + 0.2 * std::sin(a + phase));
  }
  return x;
}

/// Angle about the tangent between a reference frame and the same frame carried from its neighbour.
double angle_between(const Frames& frames, int i) {
  const Vector3 moved = transported(frames.normal[i - 1], frames.tangent[i - 1], frames.tangent[i]);
  const Vector3 across = frames.tangent[i].cross(moved);
  return std::atan2(frames.normal[i].dot(across), frames.normal[i].dot(moved));
}

}  // namespace

TEST_CASE("the octant of the sphere has the area pi/2, a small triangle that of the plane") {
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY(), z = Vector3::UnitZ();
  CHECK(solid_angle(x, y, z) == Approx(M_PI / 2));
  CHECK(SolidAngle(x, z, y).value == Approx(-M_PI / 2));
  const double h = 1e-3;
  CHECK(solid_angle(z, (z + h * x).normalized(), (z + h * y).normalized()) ==
        Approx(h * h / 2).epsilon(1e-5));
}

TEST_CASE("twist of carried frames is the angle between them, whatever the way") {
  const Rod rod = rod_of(60);
  const Frames source = twist_free_frames(rod, ring(rod, 1, 0));
  Frames stepwise = source;
  for (int k = 1; k <= 20; ++k) stepwise = carried_frames(rod, stepwise, ring(rod, 1, 0.05 * k));
  const Frames direct = carried_frames(rod, source, ring(rod, 1, 1));
  double largest = 0;
  for (int i = 1; i < rod.segments(); ++i) {
    for (const Frames* frames : std::initializer_list<const Frames*>{&stepwise, &direct})
      CHECK(std::remainder(angle_between(*frames, i) - frames->twist[i], 2 * M_PI) ==
            Approx(0).margin(1e-9));
    largest = std::max(largest, std::abs(direct.twist[i]));
  }
  CHECK(largest > 0.009);
}

TEST_CASE("twist + writhe = link while a closed rod is moved") {
  // Calugareanu 1959, White 1969. No angle is moved, so the material frames are the reference
  // frames, and the link keeps its value. The last segment repeats the first.
  const auto link = [](int segments, double* moved) {
    const Rod rod = rod_of(segments);
    Vector x = ring(rod, 1, 0);
    Frames frames = twist_free_frames(rod, x);
    const auto both = [&] {
      const Polyline line = nodes_of(rod, x);
      const double wr = writhe(Polyline(line.begin(), line.end() - 1));
      return Vector2(total_twist(rod, frames, x), wr);
    };
    const Vector2 before = both();
    for (int k = 1; k <= 40; ++k) {
      x = ring(rod, 1 - 0.015 * k, 0.1 * k);
      frames = carried_frames(rod, frames, x);
    }
    const Vector2 after = both();
    *moved = after[1] - before[1];
    return after.sum() - before.sum();
  };
  double moved = 0;
  const double coarse = link(121, &moved), fine = link(241, &moved);
  CHECK(std::abs(moved) > 0.1);
  CHECK(std::abs(fine) < 0.01 * std::abs(moved));
  CHECK(std::abs(fine) < 0.3 * std::abs(coarse) + 1e-9);
}
