#pragma once

#include <vector>

#include "solid3d/contact_surface.h"

namespace bight::solid3d {

/// For every patch, the patches of other stretches of the surface whose boxes come within `reach`
/// [D]. Patches closer than `exclusion` [D] along an undeformed strand are neighbours, not
/// contacts.
std::vector<std::vector<int>> near_patches(const ContactSurface& surface, const Vector& x,
                                           double reach, double exclusion);

}  // namespace bight::solid3d
