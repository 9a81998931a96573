#pragma once

#include "coupling/scene.h"
#include "mechanics/types.h"

namespace bight::coupling {

/// The tied start of a scene from its centerline file [D]; nothing for a knot that the rod is to
/// tie. Throws InputError when there is no such start.
Polyline knot_start(const Scene& scene);

/// Determinant of the scene's knot. Throws InputError for a centerline whose strands run through
/// each other, or that the rod's segments cannot follow.
int checked_determinant(const Scene& scene);

}  // namespace bight::coupling
