#pragma once

#include "coupling/scene.h"
#include "coupling/values.h"

namespace bight::coupling {

/// What no single key can tell: do the values fit each other? Adds problems, and warnings to the
/// scene for what is possible but hardly meant.
void check_scene(Scene& scene, const Values& values, Problems& problems);

}  // namespace bight::coupling
