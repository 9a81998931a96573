// What the solid costs: seconds, steps, iterations and factorisations of tight overhand knots
// (L0 = 42.17 D, seeded by the rod). `solid_speed [NAME ...] [SETTING ...]` runs the named cases,
// tight12 to tight108_friction, or the short ones; `solid_speed try SECTION FROM TO STEP
// [SETTING ...]` a path of one's own, step by step. Settings: mu=0.32 knot=figure-eight step=0.5
// ratio=0.8 (axial) length=42.17 penetration=0.002 stiffness= onset= spacing=, and for
// a path of one's own whole (no symmetry) and iterations (each one).

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include "coupling/sweep.h"
#include "rod1d/run_rod.h"
#include "solid3d/run_solid.h"

using namespace bight;

namespace {

struct Case {
  std::string name;
  int section = 12;
  double from = 20, to = -10, step = 0.5;
  double friction = 0;
  std::string knot = "overhand";
  double axial_ratio = 0.8;
  double length = 350 / 8.3;  // [D]
  solid3d::SolidParameters solid = {};
  bool each_step = false, each_iteration = false;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const auto& [name, friction] : {std::pair{"", 0.0}, {"_friction", 0.32}})
    for (const int section : {12, 32, 60, 108}) {
      Case c{"tight" + std::to_string(section) + name, section};
      c.friction = friction;
      if (section == 108)
        c.step = 0.15, c.axial_ratio = 0.86;  // 480 layers; the paper's mesh has 476
      cases.push_back(c);
    }
  return cases;
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double normalised(double tension) { return tension * 16 / std::numbers::pi; }

rod1d::RodState seed(const Case& c) {
  rod1d::RodParameters p;
  p.length = c.length;
  p.knot = c.knot;
  p.from_straight = c.knot != "overhand";
  p.friction = c.friction;
  p.twist = c.friction > 0;
  p.path.waypoints = {std::max(28.0, c.from), c.from};
  p.path.record = {c.from};
  rod1d::RodState found;
  rod1d::RodObserver observer;
  observer.on_record = [&](const rod1d::RodState& state) { found = state; };
  const auto result = rod1d::run_rod(p, observer);
  if (!result.outcome.reason.empty()) std::printf("  rod: %s\n", result.outcome.reason.c_str());
  return found;
}

void run(Case c) {
  std::printf("%s: %s knot, section of %d cells, axial ratio %g, ebar %g -> %g, mu = %g\n",
              c.name.c_str(), c.knot.c_str(), c.section, c.axial_ratio, c.from, c.to, c.friction);
  const rod1d::RodState rod = seed(c);
  if (rod.nodes.empty()) return;
  const auto mesh =
      coupling::swept_mesh({.section_elements = c.section, .axial_ratio = c.axial_ratio}, rod);
  const auto start = coupling::sweep(mesh, rod);
  c.solid.friction = c.friction;
  c.solid.expected_tension = rod.tension;
  c.solid.rubs = rod.rubs;
  c.solid.path.waypoints = {c.from, c.to};
  c.solid.path.max_step = c.step;
  for (const double ebar : {10.0, 0.0, -10.0})
    if (ebar < c.from && ebar >= c.to) c.solid.path.record.push_back(ebar);
  c.solid.checkpoint_every = 0;

  solid3d::SolidObserver observer;
  double worst = 0;
  int cuts = 0;
  observer.on_step = [&](const StepRow& row) {
    worst = std::max(worst, row.max_penetration);
    cuts += row.cutbacks;
    if (c.each_step)
      std::printf(
          "  %8.3f  T %.6f  it %3d cut %d %s pen %.4f pairs %d J %.3f mis %.1e"
          " diss %.3e turn %.3f  %.1f s\n",
          row.ebar, normalised(row.tension), row.newton_iterations, row.cutbacks,
          row.cut_reason.c_str(), row.max_penetration, row.contact_pairs, row.min_jacobian,
          row.reaction_mismatch, row.dissipated, row.end_turn, row.wall_s);
    std::fflush(stdout);
  };
  if (c.each_iteration)
    observer.on_iteration = [](const NewtonMonitor& m) {
      std::printf("      %2d  E %.10g  residual %.2e  decrement %.2e  step %.3f  shift %.1e\n",
                  m.iteration, m.energy, m.residual, m.decrement, m.step, m.shift);
    };
  const double cpu = cpu_seconds(), wall = wall_seconds();
  const auto result = run_solid(mesh, start, c.from, c.solid, observer);
  const PathOutcome& o = result.outcome;
  std::printf("  %s%s\n",
              o.status == PathStatus::finished ? "finished" : "GAVE UP: ", o.reason.c_str());
  const int start_iterations = result.steps.empty() ? 0 : result.steps.front().newton_iterations;
  std::printf(
      "  CPU %.1f s, wall %.1f s, unknowns %d%s, steps %d, iterations %d (%.1f a step, %d in the "
      "start), factorisations %d (%.1f), cuts %d, penetration %.4f\n",
      cpu_seconds() - cpu, wall_seconds() - wall, result.unknowns,
      result.symmetric ? " (one half)" : "", o.steps, o.iterations,
      static_cast<double>(o.iterations) / std::max(1, o.steps), start_iterations, o.factorisations,
      static_cast<double>(o.factorisations) / std::max(1, o.steps), cuts, worst);
  for (const StepRow& row : result.steps)
    for (const double ebar : {10.0, 0.0, -10.0})
      if (std::abs(row.ebar - ebar) < 1e-9)
        std::printf("  Tbar(%g) = %.5f\n", ebar, normalised(row.tension));
  for (const auto& [phase, seconds] : result.seconds)
    std::printf("  %-14s %.2f s\n", phase.c_str(), seconds);
  std::fflush(stdout);
}

/// Changes a case as a word of the command line says.
void set(Case& c, const std::string& word) {
  const auto value = [&] { return word.substr(word.find('=') + 1); };
  if (word == "whole")
    c.solid.symmetry = false;
  else if (word == "iterations")
    c.each_iteration = true;
  else if (word.starts_with("mu="))
    c.friction = std::stod(value());
  else if (word.starts_with("knot="))
    c.knot = value();
  else if (word.starts_with("length="))
    c.length = std::stod(value());
  else if (word.starts_with("step="))
    c.step = std::stod(value());
  else if (word.starts_with("penetration="))
    c.solid.penetration = std::stod(value());
  else if (word.starts_with("stiffness="))
    c.solid.contact_stiffness = std::stod(value());
  else if (word.starts_with("onset="))
    c.solid.contact_onset = std::stod(value());
  else if (word.starts_with("spacing="))
    c.solid.sample_spacing = std::stod(value());
  else if (word.starts_with("ratio="))
    c.axial_ratio = std::stod(value());
  else
    std::printf("unknown word %s\n", word.c_str());
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  if (!words.empty() && words[0] == "try") {
    Case c{"try", std::stoi(words.at(1)), std::stod(words.at(2)), std::stod(words.at(3)),
           std::stod(words.at(4))};
    c.each_step = true;
    for (size_t i = 5; i < words.size(); ++i) set(c, words[i]);
    run(c);
    return 0;
  }
  std::vector<std::string> names, settings;
  for (const std::string& word : words)
    (word.find('=') == std::string::npos ? names : settings).push_back(word);
  for (Case c : all_cases()) {
    if (names.empty() ? c.section != 12 : std::ranges::find(names, c.name) == names.end()) continue;
    for (const std::string& word : settings) set(c, word);
    run(c);
  }
}
