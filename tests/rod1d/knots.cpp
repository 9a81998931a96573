#include "rod1d/knots.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "mechanics/knot_type.h"
#include "rod1d/polyline.h"
#include "rod1d/run_rod.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

double tbar(double tension) { return tension * 16 / M_PI; }

/// Above the law of the loose knot, pi^2/(2 ebar^2), by this part of it.
double excess(const StepRow& row) {
  return tbar(row.tension) * 2 * row.ebar * row.ebar / (M_PI * M_PI) - 1;
}

RodParameters rod(double length, int segments, std::vector<double> waypoints, double max_step) {
  RodParameters parameters;
  parameters.length = length;
  parameters.segments = segments;
  parameters.path.waypoints = std::move(waypoints);
  parameters.path.max_step = max_step;
  return parameters;
}

const StepRow& at(const RodResult& result, double ebar) {
  for (const StepRow& row : result.steps)
    if (std::abs(row.ebar - ebar) < 1e-6) return row;
  FAIL("ebar " << ebar << " was not reached: " << result.outcome.reason);
  return result.steps.front();
}

}  // namespace

TEST_CASE("every knot that has a name is laid out loosely, without overlap, as that knot") {
  for (const Knot& knot : all_knots()) {
    INFO(knot.name);
    for (const double ebar : {knot.loosest, 3 * knot.loosest}) {
      const double length = 2 * ebar + 30;
      const Polyline line = knot.loose(length, ebar, static_cast<int>(10 * length));
      CHECK(knot_determinant(line) == knot.determinant);
      CHECK(smallest_distance(line, 2) > 1);
      CHECK(polyline_length(line) == Approx(length).epsilon(2e-3));
      CHECK((line.back() - line.front()).norm() == Approx(length - ebar).epsilon(1e-6));
    }
  }
  CHECK_THROWS_WITH(find_knot("granny"), Catch::Contains("granny"));
}

TEST_CASE("a loose figure-eight stays one while it is pulled") {
  RodParameters parameters = rod(110, 260, {54, 48}, 1);
  parameters.knot = "figure-eight";
  parameters.path.record = {48};
  const RodResult result = run_rod(parameters);
  INFO(result.outcome.reason);
  REQUIRE(result.outcome.status == PathStatus::finished);
  REQUIRE(result.states.size() == 1);
  CHECK(result.states[0].determinant == 5);
  for (size_t i = 1; i < result.steps.size(); ++i) {
    const StepRow &row = result.steps[i], &before = result.steps[i - 1];
    CHECK(row.max_penetration < 0.002);
    const double work = -(row.energy - before.energy) / (row.ebar - before.ebar);
    CHECK(work == Approx(0.5 * (row.tension + before.tension)).epsilon(0.005));
  }
}

TEST_CASE("the paper's rod as a figure-eight, ebar 29 to 9: whole, smooth, no snap") {
  RodParameters parameters = rod(42.17, 338, {29, 9}, 0.5);
  parameters.knot = "figure-eight";
  parameters.path.record = {29, 20, 15, 9};
  const RodResult result = run_rod(parameters);
  INFO(result.outcome.reason);
  REQUIRE(result.outcome.status == PathStatus::finished);
  CHECK(result.outcome.cutbacks == 0);
  CHECK(result.outcome.iterations < 12 * result.outcome.steps);
  REQUIRE(result.states.size() == 4);
  for (const RodState& state : result.states) {
    INFO("ebar " << state.ebar);
    CHECK(state.determinant == 5);
    // Its own mirror image when turned end for end.
    CHECK(std::abs(state.writhe) < 2e-3);
    CHECK(smallest_distance(state.nodes, 3) > 0.98);
  }
  for (size_t i = 0; i < result.steps.size(); ++i) {
    const StepRow& row = result.steps[i];
    INFO("ebar " << row.ebar);
    CHECK(row.max_penetration < 0.002);
    CHECK(row.snapped == 0);
    CHECK(row.reaction_mismatch < 1e-6);
    if (i == 0) continue;
    const StepRow& before = result.steps[i - 1];
    CHECK(row.tension > before.tension);
    const double work = -(row.energy - before.energy) / (row.ebar - before.ebar);
    CHECK(work == Approx(0.5 * (row.tension + before.tension)).epsilon(0.005));
  }
  // With 676 segments: 0.0508, 0.1361, 0.2977, 0.5340.
  CHECK(tbar(at(result, 20).tension) == Approx(0.0508).epsilon(0.005));
  CHECK(tbar(at(result, 15).tension) == Approx(0.1361).epsilon(0.005));
  CHECK(tbar(at(result, 12).tension) == Approx(0.2977).epsilon(0.005));
  CHECK(tbar(at(result, 9).tension) == Approx(0.5340).epsilon(0.005));
}

TEST_CASE("the paper's rod as a figure-eight with mu = 0.32, ebar 29 to 9", "[.long]") {
  RodParameters parameters = rod(42.17, 338, {29, 9}, 0.5);
  parameters.knot = "figure-eight";
  parameters.friction = 0.32;
  parameters.twist = true;
  parameters.path.record = {29, 20, 15, 9};
  const RodResult result = run_rod(parameters);
  INFO(result.outcome.reason);
  REQUIRE(result.outcome.status == PathStatus::finished);
  for (const RodState& state : result.states) CHECK(state.determinant == 5);
  for (const StepRow& row : result.steps) CHECK(row.max_penetration < 0.002);
  CHECK(tbar(at(result, 20).tension) == Approx(0.0915).epsilon(0.02));
  CHECK(tbar(at(result, 9).tension) == Approx(0.706).epsilon(0.02));
}

TEST_CASE("a rod too short for a loose knot is cut from a longer one") {
  const RodResult result = run_rod(rod(15.66, 160, {9.58, 9}, 0.5));
  INFO(result.outcome.reason);
  REQUIRE(result.outcome.status == PathStatus::finished);
  CHECK(result.steps.front().ebar == 9.58);
  CHECK(result.steps.front().snapped == 0);
  CHECK(tbar(result.steps.front().tension) == Approx(0.3442).epsilon(0.02));
  CHECK(result.steps.front().max_penetration < 0.002);
}

TEST_CASE("steps of five in ebar end where small ones do") {
  const RodResult result = run_rod(rod(42.17, 240, {30, 9}, 5));
  INFO(result.outcome.reason);
  REQUIRE(result.outcome.status == PathStatus::finished);
  CHECK(tbar(result.steps.back().tension) == Approx(0.2163).epsilon(0.005));
  for (const StepRow& row : result.steps) CHECK(row.snapped == 0);
  // The tails stretch by T/EA; inside the tight knot contact carries a part of the tension.
  const StepRow& last = result.steps.back();
  const double straight = 42.17 * tbar(last.tension) / 4;
  CHECK(last.ebar_unstretched - last.ebar < straight);
  CHECK(last.ebar_unstretched - last.ebar > 0.8 * straight);
}

TEST_CASE("the paper's loose rod lies 11 to 13 % above the loose-knot law at ebar 200") {
  const RodResult result = run_rod(rod(266.6, 400, {200}, 1));
  REQUIRE(result.outcome.status == PathStatus::finished);
  CHECK(excess(result.steps.front()) > 0.11);
  CHECK(excess(result.steps.front()) < 0.13);
}

TEST_CASE("long tails: the excess over the loose-knot law falls about as 1/sqrt(ebar)", "[.long]") {
  const RodResult result = run_rod(rod(2400, 800, {800, 400, 200}, 20));
  INFO(result.outcome.reason);
  REQUIRE(result.outcome.status == PathStatus::finished);
  const double e200 = excess(at(result, 200)), e400 = excess(at(result, 400)),
               e800 = excess(at(result, 800));
  INFO("excess at 200, 400, 800: " << e200 << " " << e400 << " " << e800);
  CHECK(e800 < 0.08);
  CHECK(e200 / e400 == Approx(std::sqrt(2.0)).epsilon(0.15));
  CHECK(e400 / e800 == Approx(std::sqrt(2.0)).epsilon(0.15));
}

TEST_CASE("301 nodes from ebar 225 to 0 lie below the dynamic peers, within their spread",
          "[.long]") {
  const RodResult result = run_rod(rod(312.5, 300, {225, 0}, 1));
  INFO(result.outcome.reason);
  REQUIRE(result.outcome.status == PathStatus::finished);
  struct Peer {
    double ebar, tbar;
  };
  for (const Peer& peer : {Peer{100, 0.00066}, Peer{75, 0.00119}, Peer{50, 0.00298},
                           Peer{40, 0.00505}, Peer{30, 0.00902}, Peer{25, 0.0142}}) {
    INFO("ebar " << peer.ebar << ": " << tbar(at(result, peer.ebar).tension));
    // They pull at finite speed and hover outside D: at 40 they lie 6.6 % above. Two of them agree
    // within 1 to 2 %, so a static solution lies at most that much above them.
    CHECK(tbar(at(result, peer.ebar).tension) == Approx(peer.tbar).epsilon(0.07));
    CHECK(tbar(at(result, peer.ebar).tension) < 1.02 * peer.tbar);
  }
  for (size_t i = 1; i < result.steps.size(); ++i) {
    const StepRow &row = result.steps[i], &before = result.steps[i - 1];
    INFO("ebar " << row.ebar);
    CHECK(row.tension > before.tension);
    CHECK(row.max_penetration < 0.002);
    CHECK(row.reaction_mismatch < 1e-5);
    CHECK(row.snapped == 0);
  }
}

TEST_CASE("301 nodes, mu = 0.3: with the peers' friction, of centerlines, the peers' tension",
          "[.long]") {
  RodParameters parameters = rod(312.5, 300, {225, 30}, 1);
  parameters.friction = 0.3;
  parameters.twist = true;
  parameters.finish_turns = false;
  const RodResult surfaces = run_rod(parameters);
  parameters.friction_at_surface = false;
  const RodResult centerlines = run_rod(parameters);
  for (const RodResult* result : {&surfaces, &centerlines}) {
    INFO(result->outcome.reason);
    REQUIRE(result->outcome.status == PathStatus::finished);
  }
  for (const auto& [ebar, peer] :
       {std::pair{100, 0.0027}, {75, 0.0047}, {50, 0.0104}, {40, 0.0173}, {30, 0.0309}}) {
    const double tension = tbar(at(centerlines, ebar).tension);
    INFO("ebar " << ebar << ": " << tension << ", " << tbar(at(surfaces, ebar).tension));
    CHECK(tension == Approx(peer).epsilon(0.12));
    // Surfaces rub less: strands that may spin give way.
    CHECK(at(surfaces, ebar).tension < at(centerlines, ebar).tension);
  }
}

TEST_CASE("equal segments of D/2, D/4 and D/8 and nodes that follow agree in tension", "[.long]") {
  const double ebar = GENERATE(200.0, 100.0, 50.0, 25.0, 12.0);
  const double length = ebar < 30 ? 42.17 : 266.6;
  std::vector<double> tension;
  for (const double per_diameter : {2, 4, 8}) {
    RodParameters parameters =
        rod(length, 2 * static_cast<int>(0.5 * per_diameter * length), {ebar}, 0.5);
    parameters.follow_knot = false;
    const RodResult result = run_rod(parameters);
    INFO(per_diameter << " per D: " << result.outcome.reason);
    REQUIRE(result.outcome.status == PathStatus::finished);
    tension.push_back(result.steps.back().tension);
  }
  for (const int segments : {300, 600})
    tension.push_back(run_rod(rod(length, segments, {ebar}, 0.5)).steps.back().tension);
  INFO("ebar " << ebar << ": Tbar D/2 " << tbar(tension[0]) << ", D/4 " << tbar(tension[1])
               << ", D/8 " << tbar(tension[2]) << ", following 300 " << tbar(tension[3]) << ", 600 "
               << tbar(tension[4]));
  for (const double t : tension) CHECK(t == Approx(tension[2]).epsilon(0.01));
}
