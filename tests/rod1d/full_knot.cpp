// The limit of an inextensible rod: the knot is full, and no force tightens it further.

#include <catch2/catch.hpp>
#include <string>

#include "rod1d/run_rod.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

/// ebar at infinite force: linear in 1/T through the last two steps. With 100 times the stretching
/// stiffness of its section the rod still stretches when T is of the order of E D^2; ebar without
/// that elongation is the geometry's.
double full_ebar(const std::string& knot, int segments) {
  RodParameters parameters;
  parameters.knot = knot;
  parameters.segments = segments;
  parameters.stretch_stiffness_factor = 100;
  const double last = knot == "overhand" ? 9 : 12.5;
  parameters.path.waypoints = {29, last};
  const RodResult result = run_rod(parameters);
  INFO(result.outcome.reason);
  REQUIRE(result.outcome.status == PathStatus::finished);
  const StepRow &a = result.steps[result.steps.size() - 2], &b = result.steps.back();
  // It does diverge: the force of the last step is hundreds of times that of a loose knot.
  CHECK(b.tension > 500 * result.steps.front().tension);
  CHECK(b.max_penetration < 0.002);
  const double p = 1 / a.tension, q = 1 / b.tension;
  return (p * b.ebar_unstretched - q * a.ebar_unstretched) / (p - q);
}

}  // namespace

TEST_CASE("an almost inextensible knot is full at an ebar of its own", "[long]") {
  // Strands overlap by 0.15 % D, which shrinks the knot by as much: 0.015 and 0.02 of ebar.
  for (const int segments : {240, 340}) {
    CAPTURE(segments);
    CHECK(full_ebar("overhand", segments) == Approx(10.09).margin(0.02));
    CHECK(full_ebar("figure-eight", segments) == Approx(13.71).margin(0.02));
  }
}
