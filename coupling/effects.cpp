#include "coupling/effects.h"

#include "solid3d/elements.h"

namespace bight::coupling {

std::vector<KnownEffect> known_effects(const Scene& scene) {
  const bool rod_alone = !scene.solid, weighs = scene.gravity != Vector3::Zero();
  const bool magnetic = scene.magnetic_field != Vector3::Zero();
  const bool hourglass = solid3d::hex_element(scene.element).hourglass;
  // name, key, in the rod, in the solid, asked for, available
  return {
      {"stretch", "", true, false},
      {"bend", "", true, false},
      {"strain", "", false, true},
      {"hourglass", "solid3d.element", false, true, hourglass},
      {"contact", "effects.contact", true, true, scene.contact},
      {"friction", "effects.friction", true, true, scene.friction > 0},
      {"twist", "effects.twist", true, false, scene.twist},
      {"natural curvature", "rod.natural_curvature", true, false, scene.natural_curvature != 0,
       rod_alone},
      {"natural twist", "rod.natural_twist", true, false, scene.natural_twist != 0, rod_alone},
      {"gravity", "effects.gravity", true, true, weighs},
      {"magnetic", "effects.magnetic_field", true, false, magnetic, rod_alone},
      {"inertia", "effects.inertia", true, true, scene.inertia},
      {"damping", "effects.damping", true, true, scene.damping > 0},
  };
}

std::vector<KnownEffect> asked_effects(const Scene& scene) {
  std::vector<KnownEffect> effects = known_effects(scene);
  std::erase_if(effects, [](const KnownEffect& effect) { return !effect.asked; });
  return effects;
}

}  // namespace bight::coupling
