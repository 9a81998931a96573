// The tight knot of quadratic cells, against itself and against linear ones.
#include <catch2/catch.hpp>

#include "solid3d/transfer.h"
#include "tests/coupling/tight_knot.h"

using namespace bight;
using namespace bight::coupling;
using namespace bight::test;

TEST_CASE("a knot of quadratic cells is tightened, and found again on finer ones") {
  std::vector<solid3d::SolidState> states;
  const auto half = tighten(19.5, &states, true, 0, 5, 2);
  REQUIRE(half.outcome.status == PathStatus::finished);
  REQUIRE(half.symmetric);
  const StepRow& row = half.steps.back();
  CHECK(row.reaction_mismatch < 1e-6);
  CHECK(row.residual < 1e-6);
  for (const auto& state : states) CHECK(state.determinant == 3);

  const SweepOptions five{.section_elements = 5, .degree = 2, .axial_ratio = 1.0};
  SweepOptions twelve = five;
  twelve.section_elements = 12;
  const solid3d::Mesh coarse = swept_mesh(five, seed()), fine = swept_mesh(twelve, seed());
  solid3d::SolidParameters parameters;
  parameters.element = "quadratic";
  parameters.expected_tension = row.tension;
  parameters.penetration = tight_bound;
  parameters.path.waypoints = {19.5};
  const auto found = solid3d::run_solid(
      fine, solid3d::transferred(coarse, states.back().nodes, fine), 19.5, parameters);
  REQUIRE(found.outcome.status == PathStatus::finished);
  CHECK(found.symmetric);
  CHECK(found.outcome.iterations <= 20);
  CHECK(found.steps[0].tension == Approx(row.tension).epsilon(0.03));
}

TEST_CASE(
    "quadratic cells: half a knot is the whole, as tight as of linear cells, held by friction",
    "[.long][long]") {
  const auto half = tighten(19, nullptr, true, 0, 5, 2);
  const auto whole = tighten(19, nullptr, false, 0, 5, 2);
  const auto rough = tighten(19, nullptr, true, 0.1, 5, 2);
  const auto linear = tighten(19, nullptr, true, 0, 32);
  for (const auto* result : {&half, &whole, &rough, &linear})
    REQUIRE(result->outcome.status == PathStatus::finished);
  const double tension = half.steps.back().tension;
  CHECK(tension == Approx(whole.steps.back().tension).epsilon(1e-3));
  CHECK(tension == Approx(linear.steps.back().tension).epsilon(0.03));
  CHECK(rough.steps.back().tension > 1.2 * tension);
  CHECK(rough.steps.back().dissipated > 0);
}
