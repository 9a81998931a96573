#pragma once

#include "coupling/scene.h"
#include "mechanics/types.h"

namespace bight::coupling {

/// The tied start of a scene [D]: its knot laid out at the first waypoint, or its centerline file.
Polyline knot_start(const Scene& scene);

}  // namespace bight::coupling
