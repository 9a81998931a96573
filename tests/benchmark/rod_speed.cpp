// What the rod costs: CPU seconds, steps, iterations and factorisations of the cases that a user
// waits for, on one thread. `rod_speed` runs all of them, `rod_speed NAME ...` those,
// `rod_speed try ...` a path of one's own.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "rod1d/run_rod.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

struct Case {
  std::string name, what;
  RodParameters parameters;
};

RodParameters rod(double length, int segments, double from, double to, double max_step,
                  double record_every) {
  RodParameters p;
  p.length = length;
  p.segments = segments;
  p.path.waypoints = {from, to};
  p.path.max_step = max_step;
  if (record_every > 0)
    for (double ebar = from; ebar >= to; ebar -= record_every) p.path.record.push_back(ebar);
  return p;
}

void rub(RodParameters& p, double friction) {
  p.friction = friction;
  p.twist = true;
}

std::vector<Case> all_cases() {
  std::vector<Case> cases = {
      {"n1", "L0 = 312.5 D, 300 segments, ebar 225 -> 0, every 1 recorded",
       rod(312.5, 300, 225, 0, 1, 1)},
      {"tight", "L0 = 42.17 D, 338 segments, ebar 30 -> 9", rod(42.17, 338, 30, 9, 0.5, 0)},
      {"main", "L0 = 42.17 D, 338 segments, ebar 30 -> 0", rod(42.17, 338, 30, 0, 0.5, 0)},
      {"loose", "L0 = 266.6 D, 400 segments, ebar 200 -> 50", rod(266.6, 400, 200, 50, 2, 0)},
      {"long", "L0 = 2400 D, 400 segments, ebar 800 -> 200", rod(2400, 400, 800, 200, 20, 0)},
  };
  cases.push_back({"n1_friction", "the same, mu = 0.3, both ends clamped", cases[0].parameters});
  rub(cases.back().parameters, 0.3);
  cases.back().parameters.finish_turns = false;
  cases.push_back({"tight_friction", "L0 = 42.17 D, 338 segments, ebar 30 -> 9, mu = 0.32",
                   cases[1].parameters});
  rub(cases.back().parameters, 0.32);
  for (const int segments : {300, 3000, 30000}) {
    cases.push_back(
        {"linear" + std::to_string(segments),
         "L0 = 312.5 D, ebar 100 -> 95, " + std::to_string(segments) + " equal segments",
         rod(312.5, segments, 100, 95, 1, 0)});
    cases.back().parameters.follow_knot = false;
  }
  return cases;
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void run(const Case& c, bool each_step) {
  std::printf("%s: %s\n", c.name.c_str(), c.what.c_str());
  const double began = cpu_seconds();
  double path_began = began;
  RodObserver observer;
  observer.on_step = [&, first = true](const StepRow& row) mutable {
    if (first) path_began = cpu_seconds();
    first = false;
    if (each_step)
      std::printf("  %9.4f  T %.6g  it %3d  cut %d  pen %.5f  pairs %d  %s\n", row.ebar,
                  row.tension * 16 / M_PI, row.newton_iterations, row.cutbacks, row.max_penetration,
                  row.contact_pairs, row.snapped > 0 ? "SNAP" : row.cut_reason.c_str());
  };
  const RodResult result = run_rod(c.parameters, observer);
  const double ended = cpu_seconds();
  const PathOutcome& o = result.outcome;
  std::printf("  %s%s\n",
              o.status == PathStatus::finished ? "finished" : "GAVE UP: ", o.reason.c_str());
  std::printf("  seconds %.3f (tie %.3f), steps %d, iterations %d, factorisations %d, cuts %d\n",
              ended - began, path_began - began, o.steps, o.iterations, o.factorisations,
              o.cutbacks);
  std::printf("  ms per iteration %.3f, last ebar %g, Tbar %.6g\n",
              1e3 * (ended - path_began) / std::max(1, o.iterations),
              result.steps.empty() ? NAN : result.steps.back().ebar,
              result.steps.empty() ? NAN : result.steps.back().tension * 16 / M_PI);
  for (const auto& [phase, seconds] : result.seconds)
    std::printf("  %-14s %.3f s\n", phase.c_str(), seconds);
  std::fflush(stdout);
}

/// try LENGTH SEGMENTS FROM TO STEP [KNOT] [straight] [uniform] [whole] [clamped] [mu=0.3]: one path of one's
/// own, step by step.
Case own_case(const std::vector<std::string>& words) {
  const auto number = [&](size_t i) { return std::stod(words.at(i)); };
  Case c{"try", "a path of one's own",
         rod(number(1), std::stoi(words.at(2)), number(3), number(4), number(5), 0)};
  for (size_t i = 6; i < words.size(); ++i) {
    if (words[i] == "uniform")
      c.parameters.follow_knot = false;
    else if (words[i] == "clamped")
      c.parameters.finish_turns = false, c.parameters.twist = true;
    else if (words[i] == "straight")
      c.parameters.from_straight = true;
    else if (words[i] == "whole")
      c.parameters.symmetry = false;
    else if (words[i].starts_with("mu="))
      rub(c.parameters, std::stod(words[i].substr(3)));
    else
      c.parameters.knot = words[i];
  }
  return c;
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  if (!words.empty() && words[0] == "try") {
    run(own_case(words), true);
    return 0;
  }
  for (const Case& c : all_cases())
    if (words.empty() || std::count(words.begin(), words.end(), c.name) > 0) run(c, false);
}
