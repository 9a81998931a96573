#pragma once

#include <optional>
#include <vector>

#include "mechanics/path.h"
#include "solid3d/effects/friction.h"
#include "solid3d/section_motion.h"
#include "solid3d/solid_motion.h"

namespace bight::solid3d {

/// An accepted step of a solid, with all that the next ones depend on. A run goes on from its own
/// checkpoints in the same way as one that is resumed (the model is built anew), so both give the
/// same numbers, bit for bit.
struct SolidCheckpoint {
  PathProgress progress;
  std::vector<Station> history;  ///< the last accepted states, newest last
  double tension = 0;            ///< scale of the tolerances [E D^2]
  double energy = 0;             ///< [E D^3]
  double contact_stiffness = 0;  ///< [E/D]; 0 without contact
  FrictionMemory friction, whole_friction;
  std::optional<MotionState> motion;  ///< with inertia
  double wall_s = 0;                  ///< seconds that the run had taken
};

}  // namespace bight::solid3d
