#include "mechanics/knot_type.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

using namespace bight;

namespace {

/// A closed curve on [0, 2 pi], opened where it starts, its ends led outwards.
Polyline opened(const std::function<Vector3(double)>& curve, int nodes) {
  const double gap = 0.01;
  Polyline line{10 * curve(gap)};
  for (int i = 0; i <= nodes; ++i) line.push_back(curve(gap + (2 * M_PI - 2 * gap) * i / nodes));
  line.push_back(10 * curve(-gap));
  return line;
}

Vector3 torus_knot(int p, int q, double t) {
  const double r = 2 + std::cos(q * t);
  return {r * std::cos(p * t), r * std::sin(p * t), std::sin(q * t)};
}

Vector3 figure_eight(double t) {
  const double r = 2 + std::cos(2 * t);
  return {r * std::cos(3 * t), r * std::sin(3 * t), std::sin(4 * t)};
}

}  // namespace

TEST_CASE("a straight or coiled line is no knot") {
  Polyline straight, coil;
  for (int i = 0; i <= 50; ++i) straight.push_back({0, 0, 0.3 * i});
  for (int i = 0; i <= 400; ++i) coil.push_back({std::cos(0.1 * i), std::sin(0.1 * i), 0.01 * i});
  CHECK(knot_determinant(straight) == 1);
  CHECK(knot_determinant(coil) == 1);
}

TEST_CASE("determinants of the first knots") {
  const int nodes = GENERATE(60, 101, 500, 5000);
  CHECK(knot_determinant(opened([](double t) { return torus_knot(2, 3, t); }, nodes)) == 3);
  CHECK(knot_determinant(opened([](double t) { return torus_knot(3, 2, t); }, nodes)) == 3);
  CHECK(knot_determinant(opened(figure_eight, nodes)) == 5);
  CHECK(knot_determinant(opened([](double t) { return torus_knot(2, 5, t); }, nodes)) == 5);
  CHECK(knot_determinant(opened([](double t) { return torus_knot(2, 7, t); }, nodes)) == 7);
}

TEST_CASE("the determinant does not depend on size and orientation") {
  const Polyline knot = opened(figure_eight, 200);
  const Eigen::AngleAxisd turn(1.234, Vector3(1, -2, 0.5).normalized());
  for (const double size : {1e-3, 1.0, 1e4}) {
    Polyline moved;
    for (const Vector3& p : knot) moved.push_back(size * (turn * p) + Vector3(3, 4, 5));
    CHECK(knot_determinant(moved) == 5);
    CHECK(knot_determinant({moved.rbegin(), moved.rend()}) == 5);
  }
}

TEST_CASE("a planar line that runs through itself has no knot type") {
  CHECK(knot_determinant({{0, 0, 0}, {0, 0, 5}, {0, 2, 5}, {0, 2, 1}, {0, -2, 1}, {0, -2, 8}}) ==
        0);
}
