#include "rod1d/timed_rod.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "rod1d/run_rod.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

/// A slow pull: about 0.5 mm/s of a rubber rod (wave speed 33 m/s).
RodParameters slow_pull(int segments, std::vector<double> waypoints) {
  RodParameters parameters;
  parameters.segments = segments;
  parameters.follow_knot = false;
  parameters.path.waypoints = std::move(waypoints);
  parameters.inertia = true;
  parameters.damping = 1e-3;
  parameters.speed = 1.5e-5;
  return parameters;
}

/// Largest difference of the tension at equal ebar, over the tension.
double difference(const RodResult& a, const RodResult& b) {
  double largest = 0;
  int compared = 0;
  for (const StepRow& row : a.steps)
    for (const StepRow& other : b.steps)
      if (std::abs(row.ebar - other.ebar) < 1e-9) {
        largest = std::max(largest, std::abs(row.tension / other.tension - 1));
        ++compared;
      }
  REQUIRE(compared > 3);
  return largest;
}

}  // namespace

TEST_CASE("ends move at their speed, which they take up smoothly") {
  const EndMotion ends({20, 17, 18}, 0.01, 50);
  CHECK(ends.ebar(0) == 20);
  CHECK(ends.rate(0) == 0);
  CHECK(ends.rate(150) == Approx(-0.01));
  CHECK(ends.ebar(350) == Approx(17));  // 3/0.01 + 50
  CHECK(ends.rate(350) == Approx(0).margin(1e-12));
  CHECK(ends.rate(420) == Approx(0.01));
  CHECK(ends.ebar(1000) == Approx(18));
  CHECK(ends.next(17.5, 0) < 350);
  CHECK(ends.next(17.5, 351) == Approx(350 + 75));
  for (const double t : {3.0, 20.0, 49.0, 51.0, 200.0, 330.0, 360.0, 480.0}) {
    const double h = 1e-4;
    CHECK((ends.ebar(t + h) - ends.ebar(t - h)) / (2 * h) == Approx(ends.rate(t)).epsilon(1e-5));
    CHECK(ends.ebar(ends.next(ends.ebar(t), t - h)) == Approx(ends.ebar(t)).epsilon(1e-9));
  }
}

TEST_CASE("a knot pulled slowly in time follows its equilibria") {
  RodParameters parameters = slow_pull(120, {29, 27.5});
  parameters.path.record = {27.5};
  const RodResult timed = run_rod(parameters);
  INFO(timed.outcome.reason);
  REQUIRE(timed.outcome.status == PathStatus::finished);
  CHECK(timed.effects ==
        std::vector<std::string>{"stretch", "bend", "contact", "inertia", "damping"});
  parameters.inertia = false;
  parameters.damping = 0;
  const RodResult still = run_rod(parameters);
  CHECK(difference(timed, still) < 5e-4);
  CHECK(timed.steps.back().energy == Approx(still.steps.back().energy).epsilon(1e-4));
  CHECK(timed.steps.back().time == Approx(1.5 / 1.5e-5 + 10 * 42.17));
  CHECK(timed.steps.back().max_penetration < 0.002);
  REQUIRE(timed.states.size() == 1);
  CHECK(timed.states[0].determinant == 3);
  CHECK(timed.states[0].ebar == Approx(27.5));
  for (const StepRow& row : timed.steps) CHECK(row.kinetic < 1e-6 * row.energy);
}

TEST_CASE("a slow pull in time agrees with equilibria from loose to tight", "[.long]") {
  RodParameters parameters = slow_pull(170, {29, 15});
  const RodResult timed = run_rod(parameters);
  REQUIRE(timed.outcome.status == PathStatus::finished);
  parameters.inertia = false;
  parameters.damping = 0;
  CHECK(difference(timed, run_rod(parameters)) < 4e-3);
}

TEST_CASE("a hanging knot rolls over as it is tightened, in time and through equilibria",
          "[.long]") {
  // Its centre of mass comes above the axis near ebar 23.5.
  RodParameters parameters = slow_pull(120, {25, 21});
  parameters.gravity = Vector3(0, -7.56e-5, 0);  // the paper's rod on earth
  parameters.damping = 4e-3;
  const RodResult timed = run_rod(parameters);
  INFO(timed.outcome.reason);
  REQUIRE(timed.outcome.status == PathStatus::finished);
  parameters.inertia = false;
  parameters.damping = 0;
  const RodResult still = run_rod(parameters);
  REQUIRE(still.outcome.status == PathStatus::finished);
  int snaps = 0;
  double lost = 0;
  for (const StepRow& row : still.steps) snaps += row.snapped > 0, lost += row.snapped;
  CHECK(snaps == 1);
  // In time it leaves the balance later, and loses more.
  CHECK(timed.steps.back().dissipated > lost);
  CHECK(timed.steps.back().tension == Approx(still.steps.back().tension).epsilon(2e-3));
  CHECK(timed.steps.back().energy == Approx(still.steps.back().energy).epsilon(2e-3));
}
