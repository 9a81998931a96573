// Scenes whose knot comes from a centerline file.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "coupling/errors.h"
#include "coupling/expect.h"
#include "coupling/scene.h"
#include "rod1d/knots.h"
#include "small_scene.h"
#include "temporary_folder.h"

using namespace bight::coupling;

namespace {

// Rows x,y,z [m] of a loose knot, tied into the small scene's rod, made longer for it.
const std::string longer = "rod.length=0.7";
std::string scan(const char* knot, int segments = 300) {
  std::string rows = "x,y,z\n";
  for (const bight::Vector3& p : bight::rod1d::find_knot(knot).loose(0.7 / 0.0083, 56, segments))
    rows += fmt::format("{:.9g},{:.9g},{:.9g}\n", 0.0083 * p.x(), 0.0083 * p.y(), 0.0083 * p.z());
  return rows;
}

std::string about_scan(const std::string& rows, std::vector<std::string> overrides) {
  const TemporaryFolder folder;
  folder.write("scan.csv", rows);
  overrides.push_back("knot.centerline=" + (folder / "scan.csv").string());
  try {
    return expectations(read_scene(folder.write("scene.toml", small_scene), overrides));
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("the knot of a centerline file is known before anything runs") {
  using Catch::Contains;
  CHECK_THAT(about_scan(scan("overhand"), {longer}),
             Contains("knot   scan.csv, determinant 3, that of the overhand"));
  CHECK_THAT(about_scan(scan("figure-eight"), {longer}),
             Contains("knot   scan.csv, determinant 5, that of the figure-eight"));
  std::string bent = "x,y,z\n";
  for (int i = 0; i <= 100; ++i)
    bent += fmt::format("{:.9g},0,{:.9g}\n", 0.07 * std::sin(0.0314159 * i), 0.0031 * i);
  CHECK_THAT(about_scan(bent, {"path.ebar=[3, 2]", "rod.length=0.3444"}),
             Contains("determinant is 1"));
}

TEST_CASE("a centerline whose strands run through each other is refused, a slight overlap is not") {
  using Catch::Contains;
  // A thicker rod on the same line. Strands of the line are about 1.2 of its diameters apart.
  const auto thick = [](double times) {
    return std::vector<std::string>{fmt::format("rod.diameter={} mm", 8.3 * times), longer,
                                    "path.ebar=[8, 5]", "rod1d.segments=300"};
  };
  const std::string refused = about_scan(scan("overhand"), thick(2.6));
  CHECK_THAT(refused, Contains("knot.centerline") && Contains("overlap by"));
  CHECK(std::ranges::count(refused, '\n') == 0);
  CHECK_THAT(about_scan(scan("overhand"), thick(1.3)), Contains("determinant 3"));
}

TEST_CASE("points that are too far apart for their knot are refused, as are too few segments") {
  using Catch::Contains;
  CHECK_THAT(about_scan(scan("figure-eight", 19), {"rod.length=0.659"}), Contains("too far apart"));
  CHECK_THAT(about_scan(scan("figure-eight"), {longer, "rod1d.segments=5"}),
             Contains("5 segments"));
}
