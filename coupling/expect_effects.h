#pragma once

#include <string>
#include <vector>

#include "coupling/scene.h"
#include "solid3d/mesh.h"

namespace bight::coupling {

/// What an effect is expected to cost in a run, before anything was run.
struct ExpectedCost {
  std::string name;
  int unknowns = 0;  ///< that no effect before it depends on
  int stencils = 0;
  bool rough = false;  ///< stencils depend on the state: their number in a tight knot
  double share = 0;    ///< of the time
};

/// The effects that the models will build for a scene, and at last the system of equations.
std::vector<ExpectedCost> expected_rod(const Scene& scene);
std::vector<ExpectedCost> expected_solid(const Scene& scene, const solid3d::Mesh& mesh);

/// A line for each.
std::string costs_text(const std::vector<ExpectedCost>& costs);

}  // namespace bight::coupling
