#include "rod1d/tie.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "mechanics/knot_type.h"
#include "rod1d/knots.h"
#include "rod1d/polyline.h"

using namespace bight;
using namespace bight::rod1d;

TEST_CASE("a straight rod is tied: open at first, the knot at last, strands outside each other") {
  const Knot& knot = GENERATE(from_range(all_knots()));
  INFO(knot.name);
  std::vector<std::string> steps;
  std::vector<RodState> states;
  const Polyline line =
      tied(tie_protocol(knot.name), 60, 35, [&](std::string_view step, const RodState& state) {
        if (steps.empty() || steps.back() != step) steps.emplace_back(step);
        states.push_back(state);
        // Before the ends go through there is no knot; 0 where the lines on which they leave meet.
        if (step == "straight" || step == "bend") CHECK(state.determinant <= 1);
        if (step == "release") CHECK(state.determinant == knot.determinant);
      });
  CHECK(steps == std::vector<std::string>{"straight", "bend", "thread", "release"});
  const size_t last = states.front().nodes.size() - 1;
  const TwoFold symmetry(tie_protocol(knot.name).symmetry, static_cast<int>(last));
  for (size_t i = 0; i < states.size(); ++i) {
    INFO("state " << i);
    CHECK(smallest_distance(states[i].nodes, 2) > 0.96);
    for (const double stretch : states[i].stretch) CHECK(std::abs(stretch - 1) < 0.2);
    for (size_t k = 0; k <= last; ++k)
      CHECK((symmetry.image(states[i].nodes[k]) - states[i].nodes[last - k]).norm() < 1e-9);
    // What an end does in one increment is less than what would take it across a strand unseen.
    if (i > 0)
      CHECK((states[i].nodes.back() - states[i - 1].nodes.back()).norm() <
            0.2 * polyline_length(line));
  }
  for (const double kappa : states.front().curvature) CHECK(kappa == Approx(0).margin(1e-9));
  CHECK(states.back().ebar == Approx(35).epsilon(1e-3));

  CHECK(knot_determinant(line) == knot.determinant);
  CHECK(polyline_length(line) == Approx(60).epsilon(0.01));
  const Vector3 chord = line.back() - line.front();
  CHECK(chord.norm() == Approx(60 - 35).epsilon(1e-6));
  // The tails leave along the chord.
  CHECK((line.back() - line[line.size() - 2]).normalized().dot(chord.normalized()) == Approx(1));
  CHECK((line[1] - line[0]).normalized().dot(chord.normalized()) == Approx(1));
}

TEST_CASE("knots that are tied from straight and laid out loosely are the same") {
  RodParameters parameters;
  parameters.knot = GENERATE("overhand", "figure-eight");
  parameters.segments = 200;
  parameters.path.waypoints = {29, 27};
  INFO(parameters.knot);
  const RodResult loose = run_rod(parameters);
  parameters.from_straight = true;
  int seen = 0;
  RodObserver observer;
  observer.on_tie = [&](const RodState&) { ++seen; };
  const RodResult tied = run_rod(parameters, observer);
  REQUIRE(loose.outcome.status == PathStatus::finished);
  REQUIRE(tied.outcome.status == PathStatus::finished);
  CHECK(seen > 20);
  CHECK(tied.steps.back().energy == Approx(loose.steps.back().energy).epsilon(1e-3));
  CHECK(tied.steps.back().tension == Approx(loose.steps.back().tension).epsilon(5e-3));
}

TEST_CASE("a rod shorter than its loop is cut from one that was tied from straight") {
  RodParameters parameters;
  parameters.length = 15.66;
  parameters.segments = 160;
  parameters.path.waypoints = {9.58};
  parameters.from_straight = true;
  const RodResult result = run_rod(parameters);
  INFO(result.outcome.reason);
  REQUIRE(result.outcome.status == PathStatus::finished);
  CHECK(result.steps.back().tension * 16 / M_PI == Approx(0.3442).epsilon(0.02));
}

TEST_CASE("what cannot be tied from straight is refused in words") {
  CHECK_THROWS_WITH(tie_protocol("granny"), Catch::Contains("granny"));
  const TieProtocol& overhand = tie_protocol("overhand");
  CHECK_THROWS_WITH(tied(overhand, 60, 20), Catch::Contains("too small"));
  CHECK_THROWS_WITH(tied(overhand, 400, 200), Catch::Contains("too large"));
  CHECK_THROWS_WITH(tied(overhand, 40, 35), Catch::Contains("too short"));
}
