#pragma once

#include "coupling/scene.h"
#include "mechanics/types.h"

namespace bight::coupling {

/// The tied start of a scene [D]: its knot laid out loosely, or its centerline file. Throws
/// InputError when there is no such start.
Polyline knot_start(const Scene& scene);

}  // namespace bight::coupling
