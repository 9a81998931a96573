#include "rod1d/overhand.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "mechanics/knot_type.h"
#include "rod1d/measure.h"
#include "rod1d/polyline.h"

using namespace bight;
using namespace bight::rod1d;

TEST_CASE("the overhand start is a trefoil without overlap, of the length and ebar asked for") {
  struct Case {
    double length, ebar;
  };
  const auto c = GENERATE(Case{42.17, 26}, Case{42.17, 30}, Case{266.6, 200}, Case{312.5, 225});
  const Polyline line = overhand_start(c.length, c.ebar, static_cast<int>(6 * c.length));
  CHECK(polyline_length(line) == Approx(c.length).epsilon(2e-3));
  CHECK((line.back() - line.front()).norm() == Approx(c.length - c.ebar).epsilon(1e-6));
  CHECK(line.front().head<2>().norm() == 0);
  CHECK(line.back().head<2>().norm() == 0);
  CHECK(knot_determinant(line) == 3);
  CHECK(smallest_distance(line, 2) > 1);
}

TEST_CASE("a rod that is too short for the knot is refused") {
  CHECK_THROWS_AS(overhand_start(30, 28, 100), std::invalid_argument);
  CHECK_THROWS_AS(overhand_start(100, 10, 100), std::invalid_argument);
}

TEST_CASE("writhe: none in the plane, opposite for the mirror image, the same for any mesh") {
  Polyline flat;
  for (int i = 0; i <= 60; ++i) flat.push_back({0.3 * i, std::sin(0.3 * i), 0});
  CHECK(writhe(flat) == Approx(0).margin(1e-12));
  const Polyline knot = overhand_start(42.17, 28, 400);
  Polyline mirror = knot;
  for (Vector3& p : mirror) p.x() = -p.x();
  const double value = writhe(knot);
  CHECK(std::abs(value) > 2);
  CHECK(writhe(mirror) == Approx(-value));
  CHECK(writhe(overhand_start(42.17, 28, 800)) == Approx(value).epsilon(2e-3));
}

TEST_CASE("writhe of a helix: 1 - sin(pitch angle) for every turn") {
  // Fuller, PNAS 68, 815 (1971); the difference of two lengths is free of what the ends do.
  const double rise = 0.8, angle = std::atan(rise);  // per radian, radius 1
  const auto helix = [&](int turns) {
    Polyline line;
    for (int i = 0; i <= 40 * turns; ++i) {
      const double phase = 2 * M_PI * i / 40;
      line.push_back({std::cos(phase), std::sin(phase), rise * phase});
    }
    return line;
  };
  const double difference = writhe(helix(30)) - writhe(helix(15));
  CHECK(std::abs(difference) == Approx(15 * (1 - std::sin(angle))).epsilon(0.01));
}
