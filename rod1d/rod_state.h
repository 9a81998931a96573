#pragma once

#include "rod1d/effects/contact.h"
#include "rod1d/frames.h"
#include "rod1d/run_rod.h"

namespace bight::rod1d {

/// What can be seen of a rod at x: all of a RodState but ebar, tension and energies. `frames` are
/// empty without twist, `contact` is null without contact and else was refreshed at x.
RodState seen(const Rod& rod, const Vector& x, const Frames& frames, const Contact* contact);

}  // namespace bight::rod1d
