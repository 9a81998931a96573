#include "coupling/effects.h"

namespace bight::coupling {

std::vector<AskedEffect> asked_effects(const Scene& scene) {
  std::vector<AskedEffect> effects = {
      {"stretch", "", true, false},
      {"bend", "", true, false},
      {"strain", "", false, true},
  };
  if (scene.contact) effects.push_back({"contact", "effects.contact"});
  if (scene.friction > 0)
    effects.push_back({"friction", "effects.friction"});
  if (scene.twist) effects.push_back({"twist", "effects.twist", true, false});
  return effects;
}

}  // namespace bight::coupling
