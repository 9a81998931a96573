#pragma once

#include <span>

#include "mechanics/assemble.h"
#include "solid3d/effects/contact.h"
#include "solid3d/effects/friction.h"
#include "solid3d/effects/hourglass.h"
#include "solid3d/effects/strain.h"
#include "solid3d/run_solid.h"

namespace bight::solid3d {

/// The effects of a solid, as the parameters ask for: one line per effect in effects.cpp. An effect
/// that is not asked for is not built.
struct SolidEffects {
  EffectList list;
  Strain* strain = nullptr;        ///< in the list
  Hourglass* hourglass = nullptr;  ///< in the list; null for elements that need none
  Contact* contact = nullptr;      ///< in the list; null without contact
  Friction* friction = nullptr;    ///< in the list; null without friction
};

/// `first_layer`: energy only of the rod beyond it, where the rest is its image (one strand).
SolidEffects make_effects(std::span<const Mesh> strands, const SolidParameters& parameters,
                          int internal_begin, int first_layer = 0);
inline SolidEffects make_effects(const Mesh& mesh, const SolidParameters& parameters,
                                 int internal_begin, int first_layer = 0) {
  return make_effects(std::span(&mesh, 1), parameters, internal_begin, first_layer);
}

}  // namespace bight::solid3d
