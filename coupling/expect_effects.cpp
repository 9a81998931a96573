#include "coupling/expect_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string_view>

#include "mechanics/assemble.h"
#include "rod1d/effects.h"
#include "rod1d/grip.h"
#include "solid3d/effects.h"
#include "solid3d/effects/grip.h"

namespace bight::coupling {
namespace {

// Seconds that a stencil takes in a Newton iteration, and how many there are in a tight overhand
// knot of effects whose stencils depend on the state; measured by tests/benchmark/effect_costs.cpp
// on one core. Only their ratios count.
struct Measured {
  std::string_view effect;
  double seconds;
  double touching = 0;  // stencils: of a rod per segment, of a solid per sample spacing^2/D^2
};
constexpr Measured of_rod[] = {{"stretch", 3e-6},       {"bend", 4.3e-6},   {"twist", 12e-6},
                               {"gravity", 0.7e-6},     {"magnetic", 3e-6}, {"contact", 16e-6, 2},
                               {"friction", 54e-6, 0.1}};
constexpr Measured of_solid[] = {{"strain", 26e-6},
                                 {"hourglass", 8e-6},
                                 {"gravity", 0.7e-6},
                                 {"contact", 160e-6, 3.5},
                                 {"friction", 51e-6, 3.5}};
constexpr Measured of_quadratic[] = {
    {"strain", 220e-6}, {"gravity", 0.7e-6}, {"contact", 160e-6, 3.5}, {"friction", 51e-6, 3.5}};
constexpr double rod_solve = 3.6e-6;  // per unknown
constexpr double large_block = 200;   // of a factorisation, which is slower with smaller ones
constexpr double flops = 1e10;        // per second, with large ones

// Shares of the time, and `solving` as that of the equations.
void finish(std::vector<ExpectedCost>& costs, double solving) {
  costs.push_back({"equations", 0, 0, false, solving});
  double sum = 0;
  for (const ExpectedCost& cost : costs) sum += cost.share;
  for (ExpectedCost& cost : costs) cost.share /= sum;
}

// No stencils of their own: masses of the nodes, on the diagonal of the equations.
void add_motion(std::vector<ExpectedCost>& costs, bool inertia, double damping) {
  if (inertia) costs.emplace_back("inertia");
  if (damping > 0) costs.emplace_back("damping");
}

std::vector<ExpectedCost> expected(const Assembler& assembler, std::span<const Measured> measured,
                                   double touching) {
  std::vector<ExpectedCost> costs;
  for (const EffectCost& cost : assembler.costs()) {
    ExpectedCost& row = costs.emplace_back(cost.name, cost.unknowns, cost.stencils);
    const auto found = std::ranges::find(measured, cost.name, &Measured::effect);
    if (found == measured.end()) continue;
    row.rough = found->touching > 0;
    if (row.rough) row.stencils = static_cast<int>(found->touching * touching);
    row.share = found->seconds * row.stencils;
  }
  return costs;
}

}  // namespace

std::vector<ExpectedCost> expected_rod(const Scene& scene) {
  rod1d::RodParameters parameters = rod_parameters(scene);
  rod1d::Rod rod =
      rod1d::uniform_rod(parameters.length, parameters.segments, parameters.poissons_ratio);
  bend_naturally(rod, parameters.natural_curvature, parameters.natural_twist);
  const rod1d::Frames source;
  const rod1d::RodEffects effects = make_effects(rod, parameters, source);
  const auto held = held_coordinates(rod, parameters.twist, parameters.finish_turns);
  const Unknowns unknowns(rod.blocks(parameters.twist), static_cast<int>(held.size()), held);
  auto costs = expected(Assembler(unknowns, effects.list), of_rod, parameters.segments);
  add_motion(costs, parameters.inertia, parameters.damping);
  finish(costs, rod_solve * unknowns.size());
  return costs;
}

std::vector<ExpectedCost> expected_solid(const Scene& scene, const solid3d::Mesh& mesh) {
  const solid3d::SolidParameters parameters = solid_parameters(scene);
  const solid3d::Grip grip{parameters.finish_turns};
  const int internal = grip.coordinates(mesh);
  const solid3d::SolidEffects effects = make_effects(mesh, parameters, internal);
  const Unknowns unknowns = grip.unknowns(mesh, internal + effects.strain->internals());
  const double spacing = parameters.sample_spacing;
  const bool quadratic = mesh.degree() == 2;
  auto costs = expected(Assembler(unknowns, effects.list),
                        quadratic ? std::span<const Measured>(of_quadratic) : of_solid,
                        1 / (spacing * spacing));
  add_motion(costs, parameters.inertia, parameters.damping);
  // A layer couples with the next, of b unknowns each: 7/3 b^3, and contact about doubles that. Of
  // quadratic cells three couple at once: 19/3 and 7/3 b^3 in turn.
  const double b = 3.0 * mesh.points_per_layer(), slow = std::min(1.0, b / large_block);
  finish(costs, mesh.layers() * (quadratic ? 13.0 : 7.0) / 3 * b * b * b *
                    (parameters.contact ? 2 : 1) / (flops * slow * slow));
  return costs;
}

std::string costs_text(const std::vector<ExpectedCost>& costs) {
  std::string text;
  for (const ExpectedCost& cost : costs) {
    const std::string stencils =
        cost.stencils == 0
            ? ""
            : fmt::format("{}{} stencils", cost.rough ? "about " : "", cost.stencils);
    const std::string unknowns =
        cost.unknowns == 0 ? "" : fmt::format("{} unknowns", cost.unknowns);
    text += fmt::format(
        "         {:<12} {:>20} {:>16} {:>16}\n", cost.name, stencils, unknowns,
        cost.share < 0.005 ? "little time" : fmt::format("{:.0f} % of the time", 100 * cost.share));
  }
  return text;
}

}  // namespace bight::coupling
