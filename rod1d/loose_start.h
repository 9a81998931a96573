#pragma once

#include <string>

#include "rod1d/polyline.h"

namespace bight::rod1d {

/// A family of tied centerlines of radius R [D], and what its start is good for.
struct LooseKnot {
  std::string name;  ///< as in "an overhand"
  double loosest;    ///< smallest ebar of a start
  double smallest;   ///< radius where the strands would touch [D]
  Polyline (*shape)(double R);
};

/// The member of the family that shortens the rod by ebar, with tails along z that make it `length`
/// [D] long, cut into segments. Throws std::invalid_argument where ebar is too small or the rod too
/// short.
Polyline loose_start(const LooseKnot& knot, double length, double ebar, int segments);

}  // namespace bight::rod1d
