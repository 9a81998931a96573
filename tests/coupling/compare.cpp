#include "coupling/compare.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "coupling/errors.h"
#include "coupling/read_curves.h"
#include "coupling/read_measured.h"
#include "temporary_folder.h"

using namespace bight::coupling;

namespace {

ForceCurve sampled(const std::string& name, double step, double (*force)(double), double from = 20,
                   double to = 5) {
  ForceCurve curve{name, {}, {}, {}};
  for (double ebar = from; ebar >= to - 1e-9; ebar -= step) {
    curve.ebar.push_back(ebar);
    curve.force.push_back(force(ebar));
  }
  return curve;
}

double law(double ebar) { return *loose_knot_law(ebar, 0, true); }

}  // namespace

TEST_CASE("the loose-knot law has its published values") {
  CHECK(*loose_knot_law(10, 0, true) == Approx(M_PI * M_PI / 200));
  CHECK(*loose_knot_law(100, 0.32, true) - *loose_knot_law(100, 0.32, false) ==
        Approx(2 * 0.492 * 0.32 * std::pow(M_PI, 1.5) / 1000));
  CHECK_FALSE(loose_knot_law(0, 0, true));
}

TEST_CASE("values between steps are found to a small part of a percent") {
  const ForceCurve curve = sampled("rod", 0.5, law);
  for (double ebar = 19.9; ebar > 5; ebar -= 0.37)
    CHECK(*force_at(curve, ebar) == Approx(law(ebar)).epsilon(1e-3));
  CHECK_FALSE(force_at(curve, 20.1));
  CHECK_FALSE(force_at(curve, 4.9));
}

TEST_CASE("curves part where their difference stays above a level") {
  const ForceCurve rod = sampled("rod", 0.5, law);
  const ForceCurve solid =
      sampled("solid", 0.3, [](double e) { return law(e) * (1 - 0.01 * (20 - e)); });
  const Comparison comparison = compare({rod, solid}, 0);
  CHECK(*parted_at(comparison, 1, 0.02) == Approx(18).margin(0.05));
  CHECK(*parted_at(comparison, 1, 0.05) == Approx(15).margin(0.05));
  CHECK(*parted_at(comparison, 1, 0.10) == Approx(10).margin(0.05));
  CHECK_FALSE(parted_at(comparison, 1, 0.2));
  // The solid is softer.
  for (const auto& row : comparison.rows)
    if (const auto difference = row.difference(1))
      CHECK(*difference == Approx(-0.01 * (20 - row.ebar)).margin(1e-3));
  CHECK(comparison_text(comparison).find("5 % from ebar 15.0") != std::string::npos);
}

TEST_CASE("tightening and loosening are compared apart") {
  ForceCurve loop = sampled("loop", 0.5, law);
  ForceCurve back = sampled("loop", 0.5, [](double e) { return 0.5 * law(e); });
  loop.ebar.insert(loop.ebar.end(), back.ebar.rbegin() + 1, back.ebar.rend());
  loop.force.insert(loop.force.end(), back.force.rbegin() + 1, back.force.rend());
  CHECK(legs(loop).size() == 2);
  const Comparison comparison = compare({loop, sampled("rod", 0.5, law)}, 0);
  for (const auto& row : comparison.rows) {
    if (row.tightening)
      CHECK(std::abs(*row.difference(1)) < 1e-12);
    else
      CHECK_FALSE(row.force[1]);
  }
}

TEST_CASE("noise of a measurement is not a turn") {
  ForceCurve curve = sampled("measured", 0.5, law);
  for (size_t i = 1; i < curve.ebar.size(); i += 3) curve.ebar[i] += 0.6;
  CHECK(legs(curve).size() == 1);
}

TEST_CASE("measured files are read by the names of their columns") {
  const TemporaryFolder folder;
  const auto file = folder.write("measured.csv", "force_normalised;Ebar\n0,5;20\n1,25;10,5\n");
  const auto curves = read_curves(file);
  REQUIRE(curves.size() == 1);
  CHECK(curves[0].name == "measured");
  CHECK(curves[0].ebar == std::vector<double>{20, 10.5});
  CHECK(curves[0].force == std::vector<double>{0.5, 1.25});
  CHECK_THROWS_AS(read_curves(folder.write("a.csv", "ebar,force\n1,2\n")), InputError);
  CHECK_THROWS_AS(read_curves(folder.write("b.csv", "ebar,force_normalised\n1,x\n")), InputError);
  CHECK_THROWS_AS(read_curves(folder.write("c.csv", "ebar,force_normalised\n1\n")), InputError);
  CHECK_THROWS_AS(read_curves(folder / "absent"), InputError);
}

TEST_CASE("a measurement in the units of the laboratory is laid on the rod's") {
  const TemporaryFolder folder;
  const Scales scales{8.3e-3, 1.25e6};
  const auto file = folder.write(
      "pull.csv", "\"force [mN]\";Temperature;Shortening (mm);spread_N\n1691;20;83;0,1691\n");
  const ForceCurve curve = read_measured(file, scales);
  CHECK(curve.ebar[0] == Approx(10));
  // Tbar = 1 is 4 B/D^2, B = pi E D^4/64.
  const double unit = 4 * M_PI * 1.25e6 * std::pow(8.3e-3, 2) / 64;
  CHECK(curve.force[0] == Approx(1.691 / unit));
  CHECK(curve.spread[0] == Approx(0.1691 / unit));
  // A spread without a unit is in that of the force.
  const auto same =
      read_measured(folder.write("a.csv", "ebar,force_mN,spread\n9,200,10\n"), scales);
  CHECK(same.spread[0] == Approx(0.01 / unit));

  const auto refused = [&](const std::string& text, const std::optional<Scales>& with) {
    try {
      read_measured(folder.write("bad.csv", text), with);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto says = [](const std::string& message) { return Catch::Contains(message); };
  CHECK_THAT(refused("ebar,force_N\n9,1\n", {}), says("give a results folder before the file"));
  CHECK_THAT(refused("ebar,force [m]\n9,1\n", scales), says("column force [m]"));
  CHECK_THAT(refused("ebar,force\n9,1\n", scales), says("nor force with a unit, as in force [N]"));
  CHECK_THAT(refused("shortness,force_N\n9,1\n", scales), says("there are: shortness, force_N"));
  CHECK_THAT(refused("ebar,force_N,spread\n9,1,-1\n", scales), says("bad.csv:2: a spread"));
}

TEST_CASE("the scales of a result are read from its scene, whatever else that names") {
  const TemporaryFolder folder;
  CHECK_FALSE(read_scales(folder.path()));
  folder.write("scene.toml",
               "[rod]\ndiameter = 0.0083\n[material]\nyoungs_modulus = 1250000\n"
               "[knot]\ncenterline = \"/gone/scan.csv\"\n");
  const auto scales = read_scales(folder.path());
  REQUIRE(scales);
  CHECK(scales->diameter == 0.0083);
  CHECK(scales->youngs_modulus == 1.25e6);
}

TEST_CASE("how much of a curve lies inside the spread of a measurement is said") {
  ForceCurve measured = sampled("measured", 1, law);
  for (const double force : measured.force) measured.spread.push_back(0.1 * force);
  // Off by 1 % more with each step: up to 10 % at ebar 10.
  const ForceCurve rod =
      sampled("rod", 1, [](double e) { return law(e) * (1 + 0.01001 * (20 - e)); });
  const Comparison comparison = compare({rod, measured}, 0);
  CHECK(comparison.has_spread(1));
  CHECK_FALSE(comparison.has_spread(0));
  CHECK(*comparison.within_spread(0, 1) == Approx(10 / 16.));
  CHECK_FALSE(comparison.within_spread(1, 0));
  CHECK(comparison_text(comparison).find("rod lies inside the spread of measured at 62 %") !=
        std::string::npos);
  const TemporaryFolder folder;
  write_comparison(folder / "compare.csv", comparison);
  CHECK(text_of(folder / "compare.csv")
            .starts_with("ebar,tightening,rod,measured,loose_knot_law,measured_difference,measured_"
                         "spread\n20,1,"));
}
