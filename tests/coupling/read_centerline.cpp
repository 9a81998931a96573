#include "coupling/read_centerline.h"

#include <catch2/catch.hpp>

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

TEST_CASE("what is no open curve is refused with file and line") {
  const TemporaryFolder folder;
  const auto text = GENERATE(std::string("x,y,z\n"), std::string("0,0,0\n0,0,1\n"),
                             arc("", "%.1f,%.1f\n"), arc("", "%.12g,%.12g,nan\n"),
                             arc("", "%.12g,%.12g,hello\n"), arc("a,b,c\n", "%.12g,%.12g,%.12g\n"),
                             arc("", "0,0,0\n"), arc("", "%.12g,%.12g,0\n") + "0,0,1\n0.1,0,0\n");
  CAPTURE(text);
  CHECK_THROWS_AS(read_centerline(folder.write("scan", text)), InputError);
}
