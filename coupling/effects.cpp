#include "coupling/effects.h"

#include "solid3d/elements.h"

namespace bight::coupling {

std::vector<AskedEffect> asked_effects(const Scene& scene) {
  std::vector<AskedEffect> effects = {
      {"stretch", "", true, false},
      {"bend", "", true, false},
      {"strain", "", false, true},
  };
  if (solid3d::hex_element(scene.element).hourglass)
    effects.push_back({"hourglass", "solid3d.element", false, true});
  if (scene.contact) effects.push_back({"contact", "effects.contact"});
  if (scene.friction > 0) effects.push_back({"friction", "effects.friction"});
  if (scene.twist) effects.push_back({"twist", "effects.twist", true, false});
  const bool rod_alone = !scene.solid;
  if (scene.natural_curvature != 0)
    effects.push_back({"natural curvature", "rod.natural_curvature", true, false, rod_alone});
  if (scene.natural_twist != 0)
    effects.push_back({"natural twist", "rod.natural_twist", true, false, rod_alone});
  if (scene.gravity != Vector3::Zero())
    effects.push_back({"gravity", "effects.gravity", true, false, rod_alone});
  if (scene.inertia) effects.push_back({"inertia", "effects.inertia", true, false, rod_alone});
  if (scene.damping > 0) effects.push_back({"damping", "effects.damping", true, false, rod_alone});
  return effects;
}

}  // namespace bight::coupling
