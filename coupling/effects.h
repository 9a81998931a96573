#pragma once

#include <string>
#include <vector>

#include "coupling/scene.h"

namespace bight::coupling {

/// An effect that a scene asks for, and whether each fidelity that is to run can simulate it yet.
struct AskedEffect {
  std::string name;
  std::string key;  ///< scene key that asks for it; empty when always there
  bool in_rod = true, in_solid = true;
  bool available = true;
};

/// THE place that says which effects a scene asks for and which of them can be simulated.
std::vector<AskedEffect> asked_effects(const Scene& scene);

}  // namespace bight::coupling
