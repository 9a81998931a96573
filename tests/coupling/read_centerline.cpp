#include "coupling/read_centerline.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "coupling/errors.h"
#include "temporary_folder.h"

using namespace bight;
using namespace bight::coupling;

namespace {

std::string arc(const std::string& header, const char* format, double radius = 0.1) {
  std::string text = header;
  for (int i = 0; i <= 20; ++i) {
    char line[200];
    std::snprintf(line, sizeof line, format, radius * std::cos(0.1 * i), radius * std::sin(0.1 * i),
                  0.25 * i);
    text += line;
  }
  return text;
}

}  // namespace

TEST_CASE("a centerline is read from CSV with and without header, and from blanks") {
  const TemporaryFolder folder;
  for (const auto& text :
       {arc("", "%.12g,%.12g,%.12g\n"), arc("# scan\nx,y,z\n", "%.12g,%.12g,%.12g\n"),
        arc("", "%.12g  %.12g %.12g 0.5\n")}) {
    const Polyline line = read_centerline(folder.write("scan", text));
    REQUIRE(line.size() == 21);
    CHECK(line[20].x() == Approx(0.1 * std::cos(2.0)));
    CHECK(line[20].z() == Approx(5));
  }
  const Polyline swapped =
      read_centerline(folder.write("scan", arc("y,x,z\n", "%.12g,%.12g,%.12g\n")));
  CHECK(swapped[0].y() == Approx(0.1));
}

TEST_CASE("a centerline is aligned without being bent") {
  const TemporaryFolder folder;
  Polyline line = read_centerline(folder.write("scan", arc("", "%.12g,%.12g,%.12g\n")));
  const double length = arc_length(line), reach = (line.back() - line.front()).norm();
  align_with_z(line);
  CHECK(line.front().norm() < 1e-15);
  CHECK((line.back() - Vector3(0, 0, reach)).norm() < 1e-12);
  CHECK(arc_length(line) == Approx(length).epsilon(1e-12));
}

TEST_CASE("repeated, crowded and missing points are made up for") {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i <= 200; ++i) {  // a helix; a gap of 18 points, a crowd, repeated points
    if (i > 100 && i < 119) continue;
    for (int copy = 0; copy < (i % 7 == 0 ? 3 : 1); ++copy) {
      const double t = 0.03 * (i + (i > 40 && i < 60 ? 1e-4 * copy : 0));
      text += fmt::format("{:.12g},{:.12g},{:.12g}\n", std::cos(t), std::sin(t), 0.3 * t);
    }
  }
  const Polyline line = read_centerline(folder.write("scan", text));
  CHECK(line.size() < 200);
  const Polyline even = evenly_spaced(line, 0.01, 500);
  REQUIRE(even.size() == 501);
  const double length = 6 * std::hypot(1, 0.3);
  CHECK(arc_length(even) == Approx(length).epsilon(1e-3));
  for (size_t i = 1; i < even.size(); ++i)
    CHECK((even[i] - even[i - 1]).norm() == Approx(length / 500).epsilon(0.02));
  for (const Vector3& p : even) CHECK(std::hypot(p.x(), p.y()) == Approx(1).epsilon(0.005));
}

TEST_CASE("what is no open curve is refused with file and line") {
  const TemporaryFolder folder;
  const auto text = GENERATE(std::string("x,y,z\n"), std::string("0,0,0\n0,0,1\n"),
                             arc("", "%.1f,%.1f\n"), arc("", "%.12g,%.12g,nan\n"),
                             arc("", "%.12g,%.12g,hello\n"), arc("a,b,c\n", "%.12g,%.12g,%.12g\n"),
                             arc("", "0,0,0\n"), arc("", "%.12g,%.12g,0\n") + "0,0,1\n0.1,0,0\n");
  CAPTURE(text);
  CHECK_THROWS_AS(read_centerline(folder.write("scan", text)), InputError);
}
