#include "tests/solid3d/straight_rod.h"

#include <catch2/catch.hpp>

#include "solid3d/elements.h"

using namespace bight;
using namespace bight::solid3d;

namespace {

void check_rod(const test::RodOf& rod, double tolerance) {
  CAPTURE(rod.element, rod.cells, rod.bulk_to_shear);
  const test::RodErrors error = test::rod_errors(rod);
  CHECK(std::abs(error.B) < tolerance);
  CHECK(std::abs(error.EA) < tolerance);
  CHECK(std::abs(error.C) < tolerance);
}

}  // namespace

TEST_CASE("a straight rod of 32 cells bends, stretches and twists as B, EA and C to 1 %") {
  // A quadratic one with 5.
  for (const HexElement& element : hex_elements())
    check_rod({.cells = element.degree == 1 ? 32 : 5, .element = std::string(element.name)}, 0.01);
}

TEST_CASE("no ratio of bulk and shear modulus locks a straight rod") {
  for (const HexElement& element : hex_elements())
    for (const double ratio : {5.0, 1e5})
      check_rod({.cells = element.degree == 1 ? 12 : 5,
                 .element = std::string(element.name),
                 .bulk_to_shear = ratio},
                0.02);
}

TEST_CASE("a straight rod of 108 cells does so to 0.3 %", "[long]") {
  for (const HexElement& element : hex_elements())
    check_rod({.cells = element.degree == 1 ? 108 : 12, .element = std::string(element.name)},
              0.003);
}
