#pragma once

#include <vector>

#include "rod1d/friction_spots.h"

namespace bight::rod1d {

/// Energy that the sections of touching strands would store if they could flatten, at the contact
/// forces of a rod whose sections stay round [E D^3]: what the rod leaves out, to first order. Each
/// piece of a strand is pressed like a long cylinder by its equal, with line load q. Half width a
/// of the contact and approach d of the axes (K. L. Johnson, Contact Mechanics, 1985,
/// eqs. 4.43, 5.58),
///
///   a^2 = 2 q R/(pi E*),   E* = E/(2 (1 - nu^2)),   d = 2 q (1 - nu^2)/(pi E) (2 ln(4R/a) - 1),
///
/// so that a length l stores l q^2 (1 - nu^2)/(pi E) (2 ln(4R/a) - 1/2), the integral of d over q.
double flattening_energy(const std::vector<RubbingPoint>& pieces, double poissons_ratio);

}  // namespace bight::rod1d
