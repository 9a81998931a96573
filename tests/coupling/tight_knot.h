#pragma once

#include <vector>

#include "coupling/sweep.h"
#include "rod1d/overhand.h"
#include "rod1d/run_rod.h"
#include "solid3d/run_solid.h"

/// The paper's rod in a tight overhand knot, by the rod and by a coarse solid from there on.
namespace bight::test {

inline constexpr double length = 350 / 8.3, seed_ebar = 20;
inline constexpr double tight_bound =
    0.002;  ///< of the overlap: makes contact stiffen on the way [D]

inline rod1d::RodState rod_at(double ebar, double of_length = length) {
  rod1d::RodParameters parameters;
  parameters.length = of_length;
  if (of_length == length) parameters.start = rod1d::overhand_start(length, 30, 340);
  parameters.path.waypoints = {of_length == length ? 30 : ebar, ebar};
  parameters.path.record = {ebar};
  return rod1d::run_rod(parameters).states.at(0);
}

inline const rod1d::RodState& seed() {
  static const rod1d::RodState state = rod_at(seed_ebar);
  return state;
}

inline solid3d::SolidResult tighten(double to, std::vector<solid3d::SolidState>* states = nullptr,
                                    bool symmetry = true, double friction = 0, int cells = 12,
                                    int degree = 1) {
  const solid3d::Mesh mesh = coupling::swept_mesh(
      {.section_elements = cells, .degree = degree, .axial_ratio = 1.0}, seed());
  solid3d::SolidParameters parameters;
  parameters.element = degree == 1 ? "three-field" : "quadratic";
  parameters.expected_tension = seed().tension;
  parameters.path.waypoints = {seed_ebar, to};
  parameters.path.record = {seed_ebar, to};
  parameters.symmetry = symmetry;
  parameters.penetration = tight_bound;
  parameters.friction = friction;
  solid3d::SolidObserver observer;
  if (states) observer.on_record = [=](const auto& state) { states->push_back(state); };
  return solid3d::run_solid(mesh, coupling::sweep(mesh, seed()), seed_ebar, parameters, observer);
}

}  // namespace bight::test
