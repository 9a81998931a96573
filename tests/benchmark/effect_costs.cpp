// What each effect costs, and that one that is left out costs nothing: the same path with and
// without it. `effect_costs` compares all, `effect_costs friction solid` those that are named.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <string>

#include "coupling/sweep.h"
#include "rod1d/run_rod.h"
#include "solid3d/run_solid.h"

using namespace bight;

namespace {

struct Cost {
  double seconds;  ///< of the processor, per Newton iteration
  int iterations, unknowns;
  double peak_MB;
  std::vector<EffectCost> effects;
  std::map<std::string, double> phases;  ///< wall seconds
};

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double peak_MB() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024;
  return 0;
}

template <class Run>
Cost measured(Run&& run) {
  std::ofstream("/proc/self/clear_refs") << "5";  // restarts the peak
  const double began = processor_seconds();
  const auto result = run();
  const double seconds = processor_seconds() - began;
  const int iterations = std::max(1, result.outcome.iterations);
  if (result.outcome.status != PathStatus::finished)
    std::printf("GAVE UP: %s\n", result.outcome.reason.c_str());
  return {seconds / iterations, iterations,    result.unknowns, peak_MB(),
          result.costs,         result.seconds};
}

rod1d::RodParameters plain_rod() {
  rod1d::RodParameters rod;
  rod.segments = 338;
  rod.path.waypoints = {28, 10};
  return rod;
}

/// A bow, which needs no contact to stay what it is.
rod1d::RodParameters bow() {
  rod1d::RodParameters rod = plain_rod();
  rod.length = 42;
  rod.path.waypoints = {10, 2};
  for (int i = 0; i <= 400; ++i) {
    const double u = 2 * M_PI * i / 400;
    rod.start.push_back({9 * (1 - std::cos(u)), 0, 32 * u / (2 * M_PI)});
  }
  return rod;
}

Cost of_rod(const rod1d::RodParameters& parameters) {
  return measured([&] { return run_rod(parameters); });
}

Cost of_solid(double friction, bool symmetry, const std::string& element) {
  rod1d::RodParameters seed;
  seed.path.waypoints = {28, 18};
  seed.path.record = {18};
  const rod1d::RodState state = run_rod(seed).states.at(0);
  const solid3d::Mesh mesh = coupling::swept_mesh({.section_elements = 12}, state);
  const auto start = coupling::sweep(mesh, state);
  solid3d::SolidParameters parameters;
  parameters.expected_tension = state.tension;
  parameters.friction = friction;
  parameters.symmetry = symmetry;
  parameters.element = element;
  parameters.checkpoint_every = 0;
  parameters.path.waypoints = {18, 16};
  return measured([&] { return run_solid(mesh, start, 18, parameters); });
}

void print(const char* name, const Cost& cost) {
  std::size_t entries = 0;
  for (const EffectCost& effect : cost.effects) entries += effect.entries;
  std::printf(
      "  %-22s %7.3f ms an iteration, %5d iterations, %6d unknowns, %8zu entries, %4.0f MB\n", name,
      1e3 * cost.seconds, cost.iterations, cost.unknowns, entries, cost.peak_MB);
  for (const EffectCost& effect : cost.effects)
    std::printf("      %-12s %7d stencils %7d unknowns %8zu entries %8.3f s %8.3f us a stencil\n",
                effect.name.c_str(), effect.stencils, effect.unknowns, effect.entries,
                effect.seconds,
                1e6 * effect.seconds / cost.iterations / std::max(1, effect.stencils));
  for (const auto& [phase, seconds] : cost.phases)
    if (phase == "analysis" || phase == "factorisation")
      std::printf("      %-12s %50.3f s\n", phase.c_str(), seconds);
  std::fflush(stdout);
}

struct Pair {
  const char* name;
  std::function<Cost()> without, with;
};

rod1d::RodParameters changed(rod1d::RodParameters rod,
                             const std::function<void(rod1d::RodParameters&)>& change) {
  change(rod);
  return rod;
}

std::vector<Pair> pairs() {
  using Rod = rod1d::RodParameters;
  const auto rod = [](const Rod& parameters) { return [=] { return of_rod(parameters); }; };
  const auto solid = [](double friction, bool symmetry, const char* element) {
    return [=] { return of_solid(friction, symmetry, element); };
  };
  const Rod plain = plain_rod();
  const auto twist = [](Rod& r) { r.twist = true; };
  const auto equal = [](Rod& r) { r.follow_knot = false, r.symmetry = false; };
  return {
      {"contact", rod(changed(bow(), [](Rod& r) { r.contact = false; })), rod(bow())},
      {"twist", rod(plain), rod(changed(plain, twist))},
      {"friction", rod(changed(plain, twist)),
       rod(changed(plain, [](Rod& r) { r.twist = true, r.friction = 0.1; }))},
      {"gravity", rod(changed(plain, equal)),
       rod(changed(plain,
                   [](Rod& r) {
                     r.follow_knot = false, r.symmetry = false, r.gravity = Vector3(0, -1e-6, 0);
                   }))},
      {"magnetic", rod(changed(plain, equal)),
       rod(changed(plain,
                   [](Rod& r) {
                     r.follow_knot = false, r.symmetry = false, r.magnetic = Vector3(0, 0, 1e-3);
                   }))},
      {"inertia",
       rod(changed(plain,
                   [](Rod& r) {
                     r.path.waypoints = {28, 27.5};
                   })),
       rod(changed(plain,
                   [](Rod& r) {
                     r.path.waypoints = {28, 27.5}, r.follow_knot = false, r.inertia = true,
                     r.speed = 1e-4, r.damping = 1e-3;
                   }))},
      {"solid", solid(0, false, "three-field"), solid(0, true, "three-field")},
      {"solid-friction", solid(0, true, "three-field"), solid(0.2, true, "three-field")},
      {"solid-hourglass", solid(0, true, "three-field"), solid(0, true, "reduced-hybrid")},
  };
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> names(arguments + 1, arguments + count);
  for (const Pair& pair : pairs()) {
    if (!names.empty() && std::ranges::count(names, pair.name) == 0) continue;
    std::printf("%s\n", pair.name);
    print("without", pair.without());
    print("with", pair.with());
  }
}
