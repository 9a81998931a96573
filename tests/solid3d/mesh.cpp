#include "solid3d/mesh.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>

#include "solid3d/hex_reference.h"

using namespace bight;
using namespace bight::solid3d;

TEST_CASE("a section has about the cells that were asked for and the second moment of a disc") {
  for (const auto& [asked, made] : std::vector<std::pair<int, int>>{
           {12, 12}, {21, 21}, {32, 32}, {60, 60}, {108, 108}, {100, 96}}) {
    const Section section = make_section(asked);
    CAPTURE(asked);
    CHECK(section.quads.size() == static_cast<size_t>(made));
    CHECK(section.second_moment() == Approx(std::numbers::pi / 64).epsilon(1e-12));
    CHECK(section.area() == Approx(std::numbers::pi / 4).epsilon(0.003));
    Vector2 centre = Vector2::Zero();
    for (int p : section.centre) centre += section.points[p];
    CHECK(centre.norm() < 1e-15);
    double sum = 0;
    for (const auto& q : section.quads) {
      double area = 0;
      for (int i = 0; i < 4; ++i) {
        const Vector2 &a = section.points[q[i]], &b = section.points[q[(i + 1) % 4]];
        area += 0.5 * (a.x() * b.y() - b.x() * a.y());
      }
      CHECK(area > 0.3 * section.area() / made);
      sum += area;
    }
    CHECK(sum == Approx(section.area()).epsilon(1e-12));
  }
}

TEST_CASE("a quadratic section has round sides and the grid of one cut into four") {
  for (const int asked : {5, 12, 21, 32}) {
    CAPTURE(asked);
    const Section section = make_section(asked, 2);
    REQUIRE(section.cells() == asked);
    CHECK(section.quads.size() == static_cast<size_t>(4 * asked));
    CHECK(section.second_moment() == Approx(std::numbers::pi / 64).epsilon(1e-12));
    CHECK(section.area() == Approx(std::numbers::pi / 4).epsilon(1e-3));
    REQUIRE(section.centre.size() == 1);
    CHECK(section.points[section.centre[0]].norm() < 1e-15);
    const double radius = section.points[section.rim[0]].norm();
    const size_t sides = section.rim.size();
    for (size_t i = 0; i < sides; ++i) {
      const Vector2 &a = section.points[section.rim[i]],
                    &b = section.points[section.rim[(i + 1) % sides]];
      CHECK(a.norm() == Approx(radius));
      CHECK((b - a).norm() == Approx(2 * radius * std::sin(std::numbers::pi / sides)));
    }
    for (int c = 0; c < section.cells(); ++c) {
      const std::vector<int> grid = section.cell(c);
      for (int quarter = 0; quarter < 4; ++quarter) {
        const int first = quarter % 2 + 3 * (quarter / 2);
        std::array<int, 4> corners = {grid[first], grid[first + 1], grid[first + 4],
                                      grid[first + 3]};
        CHECK(std::is_permutation(
            corners.begin(), corners.end(),
            section.quads[4 * c + (quarter < 2 ? quarter : 5 - quarter)].begin()));
      }
    }
  }
}

TEST_CASE("a quadratic cell fills two layers, and its volume is that of the rod") {
  const Mesh mesh = make_mesh(make_section(5, 2), {0, 0.4, 1});
  CHECK(mesh.s == std::vector<double>{0, 0.2, 0.4, 0.7, 1});
  REQUIRE(mesh.cells.size() == 10);
  CHECK(mesh.cells_before(2) == 5);
  const HexMesh all = mesh.hexahedra();
  double volume = 0;
  for (const HexCell& cell : all.cells) {
    const auto reference = hex_reference<2>(cell_nodes<2>(all, cell));
    volume += reference.volume;
    Eigen::Matrix4d gram = Eigen::Matrix4d::Zero();
    for (int q = 0; q < reference.points; ++q)
      gram += reference.weight[q] / reference.volume * reference.mode[q] *
              reference.mode[q].transpose();
    CHECK((gram - Eigen::Matrix4d::Identity()).norm() < 1e-12);
  }
  CHECK(volume == Approx(mesh.section.area()).epsilon(1e-12));
}

TEST_CASE("graded layers are fine in the knot, coarse in the tails, and end exactly") {
  // The second knot takes an odd number of fine layers, were it not for the one in the middle.
  const double begin = GENERATE(12.0, 12.07), end = 40 - begin;
  const TailEnds ends = GENERATE(TailEnds::coarse, TailEnds::fine);
  const auto s = graded_layers(40, 0.1, 0.4, begin, end, ends);
  CHECK(s.front() == 0);
  CHECK(s.back() == 40);
  double finest = 1, coarsest = 0;
  for (size_t i = 1; i < s.size(); ++i) {
    const double h = s[i] - s[i - 1], middle = 0.5 * (s[i] + s[i - 1]);
    CHECK(h > 0);
    if (middle > begin && middle < end) CHECK(h <= 0.1 + 1e-12);
    finest = std::min(finest, h);
    coarsest = std::max(coarsest, h);
    CHECK(h + (s[s.size() - i - 1] - s[s.size() - i]) == Approx(0).margin(1e-9));  // symmetric
  }
  for (size_t i = 1; s[i + 1] < begin; ++i) CHECK(s[i] - s[i - 1] < 1.13 * (s[i + 1] - s[i]));
  CHECK(coarsest <= 0.4);
  CHECK(coarsest > 0.3);
  if (ends == TailEnds::fine) CHECK(s[1] <= 0.1 + 1e-12);
  if (ends == TailEnds::coarse) CHECK(s[1] > 0.3);
  CHECK(s.size() % 2 == 1);
}
