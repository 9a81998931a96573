#include "rod1d/knot_mesh.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "rod1d/overhand.h"
#include "rod1d/polyline.h"

using namespace bight;
using namespace bight::rod1d;

TEST_CASE("nodes are spread as wished, densest where strands are near each other") {
  const double length = 312.5;
  const int points = 3000;
  const Polyline line = overhand_start(length, 100, points);
  std::vector<double> arc;
  for (int i = 0; i <= points; ++i) arc.push_back(length * i / points);
  const std::vector<double> wished = wished_lengths(arc, line);
  for (int i = 1; i <= points; ++i)
    REQUIRE(std::abs(wished[i] - wished[i - 1]) < 0.151 * (arc[i] - arc[i - 1]));
  CHECK(wished.front() == Approx(0.1));
  CHECK(wished.back() == Approx(0.1));
  CHECK(*std::max_element(wished.begin(), wished.end()) > 2);

  const std::vector<double> nodes = spread_nodes(arc, wished, 300);
  REQUIRE(nodes.size() == 301);
  CHECK(nodes.front() == 0);
  CHECK(nodes.back() == length);
  // Every segment holds the same number of wished ones.
  std::vector<double> held_by(300, 0.0);
  for (int i = 0; i < 300; ++i)
    for (int k = 0; k < 100; ++k) {
      const double s = nodes[i] + (nodes[i + 1] - nodes[i]) * (k + 0.5) / 100;
      held_by[i] +=
          0.01 * (nodes[i + 1] - nodes[i]) / wished[static_cast<size_t>(s / length * points + 0.5)];
    }
  CHECK(*std::max_element(held_by.begin(), held_by.end()) <
        1.05 * *std::min_element(held_by.begin(), held_by.end()));

  const std::vector<double> held = spread_nodes(arc, wished, 300, 150, 150.0);
  CHECK(held[150] == 150.0);
  CHECK(std::is_sorted(held.begin(), held.end()));
}

TEST_CASE("points of a curve are found between its nodes, to third order") {
  const auto error = [](int n) {
    std::vector<double> arc, wanted;
    Polyline circle;
    for (int i = 0; i <= n; ++i) {
      arc.push_back(2.0 * i / n);
      circle.push_back({std::cos(arc.back()), std::sin(arc.back()), 0.3 * arc.back()});
    }
    for (int i = 0; i <= 90; ++i) wanted.push_back(0.5 + i / 90.0);
    double largest = 0;
    const Polyline points = points_at(arc, circle, wanted);
    for (size_t i = 0; i < wanted.size(); ++i)
      largest = std::max(
          largest,
          (points[i] - Vector3(std::cos(wanted[i]), std::sin(wanted[i]), 0.3 * wanted[i])).norm());
    return largest;
  };
  CHECK(error(20) < 1e-4);
  CHECK(error(40) < error(20) / 7);
}
