#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/solid3d/bore_patch.h"
#include "tests/solid3d/clasps.h"
#include "tests/solid3d/pressed_cylinders.h"
#include "tests/solid3d/rubbing_rods.h"

using namespace bight;

// Contact of two strands against closed forms. README.md has the errors with refinement, which
// `solid_contact` of tests/benchmark prints.

namespace {

constexpr double R = 0.5, E = 2.0 / 3;  // Hertz: radius [D], E* [E]

/// Errors of the last state of crossed and of parallel cylinders.
struct HertzErrors {
  double radius, peak;
};
HertzErrors crossed(int cells) {
  const test::Pressed p = test::crossed_cylinders(cells, 0.1, 1).back();
  const double a = std::cbrt(3 * p.force * R / (4 * E)), p0 = 3 * p.force / (2 * M_PI * a * a);
  return {p.radius / a - 1, p.peak / p0 - 1};
}
HertzErrors parallel(int cells) {
  const test::Pressed p = test::parallel_cylinders(cells, 0.1, 1).back();
  const double a = std::sqrt(2 * p.force * R / (M_PI * E)), p0 = 2 * p.force / (M_PI * a);
  return {p.radius / a - 1, p.peak / p0 - 1};
}

}  // namespace

TEST_CASE("crossed cylinders touch over Hertz's patch, with his pressure") {
  const HertzErrors coarse = crossed(32), fine = crossed(60);
  CHECK(std::abs(coarse.radius) < 0.04);
  CHECK(std::abs(coarse.peak) < 0.12);
  CHECK(std::abs(fine.radius) < 0.02);
  CHECK(std::abs(fine.peak) < 0.06);
}

TEST_CASE("crossed cylinders come to Hertz with a finer mesh", "[.long]") {
  const HertzErrors fine = crossed(288);
  CHECK(std::abs(fine.radius) < 0.007);
  CHECK(std::abs(fine.peak) < 0.015);
}

TEST_CASE("parallel cylinders touch over Hertz's width, with his pressure") {
  const HertzErrors error = parallel(108);
  CHECK(std::abs(error.radius) < 0.05);
  CHECK(std::abs(error.peak) < 0.12);
}

TEST_CASE("parallel cylinders come to Hertz with a finer mesh", "[.long]") {
  const HertzErrors fine = parallel(288);
  CHECK(std::abs(fine.radius) < 0.01);
  CHECK(std::abs(fine.peak) < 0.06);
}

namespace {

void push_together(int cells, double bulk_to_shear) {
  const test::CrossedClasp clasp(cells, bulk_to_shear);
  const PathOutcome outcome = clasp.problem->go(test::CrossedClasp::pushed, 0.1);
  REQUIRE(outcome.status == PathStatus::finished);
  CHECK(outcome.cutbacks == 0);
  CHECK(outcome.iterations <= 5 * outcome.steps);
}

}  // namespace

TEST_CASE("two crossed rods are pushed together by 2 D in few iterations") {
  push_together(12, 1000);
}

TEST_CASE("two crossed rods of 48 cells a section are pushed together", "[.long]") {
  push_together(48, GENERATE(20.0, 1000.0));
}

TEST_CASE("an orthogonal clasp flattens, and presses at four places", "[.long]") {
  const test::OrthogonalClasp clasp(48);
  const PathOutcome outcome = clasp.problem->go(2.3, 0.1);
  REQUIRE(outcome.status == PathStatus::finished);
  CHECK(outcome.cutbacks == 0);
  CHECK(clasp.force() == Approx(0.0794).epsilon(0.02));
  CHECK(clasp.flattening() == Approx(0.10).margin(0.01));
  CHECK(clasp.tip_pressure() > 1.5 * clasp.middle_pressure());
  CHECK(clasp.middle_pressure() > 0);
}

TEST_CASE("a rod that is turned in a loop hardly changes the loop's force", "[.long]") {
  const std::vector<double> forces = test::turned_in_loop(12, 8);
  const auto [least, most] = std::minmax_element(forces.begin(), forces.end());
  CHECK(*least > 0.01);
  CHECK(*most / *least - 1 < 0.005);
}

TEST_CASE("a rod over a drum holds as much as its friction and thickness say", "[.long]") {
  const test::Capstan capstan(12, 0.3, 4);
  REQUIRE(capstan.problem->go(capstan.enough, 0.2).status == PathStatus::finished);
  CHECK(capstan.problem->effects().friction->sliding_share(capstan.problem->state()) > 0.99);
  CHECK(capstan.ratio() == Approx(std::exp(capstan.growth() * M_PI)).epsilon(0.01));
}

TEST_CASE("a rod on two rails slips on a slope above mu and holds on one below") {
  CHECK(test::OnRails(0.5).holds(0.495));
  CHECK_FALSE(test::OnRails(0.49).holds(0.495));
}

TEST_CASE("a rod that is pulled over two rails drags by mu") {
  CHECK(test::OnRails(0.5).drag(0.1) == Approx(0.5).epsilon(3e-3));
}

TEST_CASE("round surfaces whose meshes do not match press on each other evenly") {
  const test::PatchErrors coarse = test::patch(12, 32), fine = test::patch(32, 60);
  CHECK(coarse.pressure < 0.1);
  CHECK(coarse.rod_forces < 1e-3);
  CHECK(coarse.bore_forces < 0.04);
  CHECK(fine.pressure < 7e-3);
  CHECK(fine.rod_forces < 1e-3);
  CHECK(fine.bore_forces < 1e-3);
}
