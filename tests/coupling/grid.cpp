#include "coupling/grid.h"

#include <catch2/catch.hpp>

#include "coupling/errors.h"

using namespace bight::coupling;

TEST_CASE("a line of the grid is a key and its values") {
  const auto grid = read_grid({"rod1d.segments = 85, 170", "path.ebar=[30, 20],[30, 10]",
                               "rod.diameter=8.3 mm, 9 mm", "fidelities=rod,[\"rod\", \"solid\"]"});
  REQUIRE(grid.size() == 4);
  CHECK(grid[0].key->path == "rod1d.segments");
  CHECK(grid[0].values == std::vector<std::string>{"85", "170"});
  CHECK(grid[1].values == std::vector<std::string>{"[30, 20]", "[30, 10]"});
  CHECK(grid[2].values == std::vector<std::string>{"8.3 mm", "9 mm"});
  CHECK(read_grid({"effects.friction=0,0.32"})[0].values == std::vector<std::string>{"0", "0.32"});
  CHECK(read_grid({"rod1d.segments=85,170", "path.max_step=1", "rod1d.segments=60"})[0].values ==
        std::vector<std::string>{"60"});
}

TEST_CASE("the size of a value falls as the run gets finer") {
  const auto grid =
      read_grid({"rod1d.segments=1_00,400", "solid3d.section_elements=12,108",
                 "path.max_step=0.5,1", "effects.friction=0,0.3", "rod1d.symmetry=true,false"});
  CHECK(grid[0].size(0) / grid[0].size(1) == Approx(4));
  CHECK(grid[1].size(0) / grid[1].size(1) == Approx(3));
  CHECK(grid[2].size(0) / grid[2].size(1) == Approx(0.5));
  CHECK(grid[2].resolution());
  CHECK_FALSE(grid[3].resolution());
  CHECK_FALSE(grid[4].resolution());
}

TEST_CASE("what cannot be read in a grid is said") {
  const auto said = [](const std::string& line, const std::string& what) {
    CHECK_THROWS_WITH(product(read_grid({line})), Catch::Contains(what));
    CHECK_THROWS_AS(product(read_grid({line})), InputError);
  };
  said("rod1d.segmets=85", "nearest is rod1d.segments");
  said("rod1d.segments", "key.path=value");
  said("=3", "key.path=value");
  said("rod1d.segments=", "no values");
  said("rod1d.segments=85,,170", "empty value");
  said("rod1d.segments=85,170,85", "85 is there twice");
  said("rod.diameter=8 mm,8_mm", "two runs");
  said("study.extrapolate=rod1d.segments", "does not vary");
}

TEST_CASE("the runs are the product, named by their settings") {
  const auto points = product(
      read_grid({"effects.friction=0,0.32", "rod1d.segments=85,170,340", "rod.length=1 m"}));
  REQUIRE(points.size() == 6);
  CHECK(points[0].name == "effects.friction=0,rod1d.segments=85,rod.length=1_m");
  CHECK(points[5].name == "effects.friction=0.32,rod1d.segments=340,rod.length=1_m");
  CHECK(points[4].at == std::vector<size_t>{1, 1, 0});
  CHECK(points[1].settings ==
        std::vector<std::string>{"effects.friction=0", "rod1d.segments=170", "rod.length=1 m"});
}
