#pragma once

#include <string>
#include <vector>

#include "coupling/scene.h"

namespace bight::coupling {

/// An effect that a scene can ask for, and what becomes of it.
struct KnownEffect {
  std::string name;
  std::string key;  ///< scene key that asks for it; empty when always there
  bool in_rod = true, in_solid = true;
  bool asked = true;      ///< by this scene
  bool available = true;  ///< every fidelity that is to run can simulate it
};

/// THE place that says which effects there are, which of them a scene asks for and which can be
/// simulated.
std::vector<KnownEffect> known_effects(const Scene& scene);

/// Those that the scene asks for.
std::vector<KnownEffect> asked_effects(const Scene& scene);

}  // namespace bight::coupling
