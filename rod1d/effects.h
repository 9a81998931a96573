#pragma once

#include "mechanics/assemble.h"
#include "rod1d/effects/contact.h"
#include "rod1d/effects/friction.h"
#include "rod1d/frames.h"
#include "rod1d/rod.h"
#include "rod1d/run_rod.h"

namespace bight::rod1d {

/// The effects of a rod, and those among them that the path has to talk to.
struct RodEffects {
  EffectList list;
  Contact* contact = nullptr;
  Friction* friction = nullptr;
};

/// THE list: what the parameters ask for, nothing else. `source`: frames that twist is counted
/// from; they are read at every evaluation and may change between solves.
RodEffects make_effects(const Rod& rod, const RodParameters& parameters, const Frames& source);

}  // namespace bight::rod1d
