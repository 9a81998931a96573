#pragma once

#include "solid3d/contact_surface.h"

namespace bight::solid3d {

/// Pairs of triangles of the strands' skins that cut each other, with the skins drawn in by
/// `inward` [D]: none where strands overlap by less than twice that. A check of the state that
/// shares nothing with contact: no neighbours are left out, no sides are told apart, and CGAL's
/// predicates are exact. Triangles are as large as a 32nd of the circumference and lie inside the
/// skin of a round section, by 0.0024 D at most.
int skin_crossings(const ContactSurface& surface, const Vector& x, double inward);

}  // namespace bight::solid3d
