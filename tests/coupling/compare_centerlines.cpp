#include "coupling/compare_centerlines.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "coupling/write_csv.h"
#include "temporary_folder.h"

using namespace bight::coupling;

namespace {

// A bump of curvature about `middle`, `spacing` apart.
void write_bump(const std::filesystem::path& folder, double middle, double height, double spacing,
                double ebar = 20) {
  std::filesystem::create_directories(folder / "centerline");
  std::vector<double> s, kappa;
  for (double at = 0; at <= 40; at += spacing) {
    s.push_back(at);
    kappa.push_back(height * std::exp(-(at - middle) * (at - middle) / 8));
  }
  write_csv(folder / "centerline" / (state_name(ebar) + ".csv"), {{"s", s}, {"kappa", kappa}});
}

}  // namespace

TEST_CASE("curvature is compared about the knot's middle, wherever it sits") {
  const TemporaryFolder folder;
  write_bump(folder / "rod", 20, 0.5, 0.1);
  write_bump(folder / "solid", 23, 0.45, 0.13);
  const auto differences = compare_centerlines(folder / "rod", folder / "solid");
  REQUIRE(differences.size() == 1);
  CHECK(differences[0].ebar == 20);
  CHECK(differences[0].mean == Approx(0.1).margin(2e-3));
  CHECK(differences[0].largest_b == Approx(0.45).epsilon(1e-3));
  CHECK(curvature_text("rod", "solid", differences).find("10.0 % at ebar 20") != std::string::npos);
  CHECK(compare_centerlines(folder / "rod", folder / "absent").empty());
  for (const char* name : {"rod", "solid"}) write_bump(folder / name, 20, 0.5, 0.1, -3.5);
  const auto both = compare_centerlines(folder / "rod", folder / "solid");
  REQUIRE(both.size() == 2);
  CHECK(both[1].ebar == -3.5);
  CHECK(both[1].mean == 0);
}
