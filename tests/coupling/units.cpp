#include "coupling/units.h"

#include <catch2/catch.hpp>

#include "coupling/errors.h"

using namespace bight::coupling;

TEST_CASE("quantities are read with their unit") {
  CHECK(parse_quantity("8.3 mm", "m") == Approx(0.0083).epsilon(1e-14));
  CHECK(parse_quantity("1.25 MPa", "Pa") == Approx(1.25e6).epsilon(1e-14));
  CHECK(parse_quantity("+0.5mm/s", "m/s") == Approx(5e-4).epsilon(1e-14));
  CHECK(parse_quantity("1.16 g/cm3", "kg/m^3") == Approx(1160).epsilon(1e-12));
  CHECK(parse_quantity("1 N/mm^2", "Pa") == Approx(1e6).epsilon(1e-12));
}

TEST_CASE("a quantity in the unit asked for keeps its last digit") {
  CHECK(parse_quantity("0.0083 m", "m") == 0.0083);
  CHECK(parse_quantity("1160.1 kg/m^3", "kg/m^3") == 1160.1);
  CHECK(parse_quantity("350 mm", "m") == 0.35);
  CHECK(parse_quantity("1.25 MPa", "Pa") == 1.25e6);
}

TEST_CASE("what is no quantity is refused") {
  const auto text = GENERATE("8.3", "8,3 mm", "mm", "", "8.3 kg", "8.3 mm 5", "8.3 Mpaa", "nan m",
                             "inf m", "8.3 mm since 2000", "0x10 m");
  CAPTURE(text);
  CHECK_THROWS_AS(parse_quantity(text, "m"), InputError);
}

TEST_CASE("Tbar = 1 of the paper's rod is 16.9 N") {
  const Scales scales{0.0083, 1.25e6};
  CHECK(16.9 / scales.force() * normalised_force(1) == Approx(1).epsilon(2e-3));
}
