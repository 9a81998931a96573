#pragma once

#include "solid3d/section_motion.h"

namespace bight::solid3d {

/// Guess for `ebar` from the last two accepted states (newest last) of a rod that slides through
/// its knot. Where strands press on each other they dent and bend, over a length of one or two
/// cells, and that place stays nearly at rest in space while the rod moves on by about a cell in a
/// step: what a section goes through now, its neighbour went through before. No extrapolation
/// section by section can foresee this.
///
/// So every section is given the place, the shape and the internal coordinates found now where it
/// will come to lie on the present centerline, with the change which that place on the centerline
/// (not this section) has seen last. How far each one gets is taken from `x`, another guess, which
/// is kept near the ends. Internal coordinates of the cells begin at `internal_begin`.
Vector travelling_guess(const Mesh& mesh, const std::vector<Station>& states, double ebar, Vector x,
                        int internal_begin);

/// Guess for the first step from a state, where nothing has moved before, and where the tangent,
/// nearly singular for a knot that slides, foretells nothing: every section slides along the
/// present centerline, those at the ends as far as in `ends` (the state with its grips moved),
/// those between them in proportion, and takes over the shape and the internal coordinates found
/// there, thinner as it is stretched, 1/sqrt(stretch).
Vector sliding_guess(const Mesh& mesh, const Vector& state, Vector ends, int internal_begin);

}  // namespace bight::solid3d
