#pragma once

#include "mechanics/assemble.h"
#include "rod1d/effects/contact.h"
#include "rod1d/rod.h"
#include "rod1d/run_rod.h"

namespace bight::rod1d {

/// The effects of a rod, and those among them that the path has to talk to.
struct RodEffects {
  EffectList list;
  Contact* contact = nullptr;
};

/// THE list: what the parameters ask for, nothing else.
RodEffects make_effects(const Rod& rod, const RodParameters& parameters);

}  // namespace bight::rod1d
