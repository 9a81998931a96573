#pragma once

#include <string_view>
#include <vector>

#include "mechanics/types.h"

namespace bight::rod1d {

/// A knot that can be laid out loosely by name.
struct Knot {
  std::string_view name;
  int determinant;  ///< of the closed centerline
  double loosest;   ///< smallest ebar at which `loose` can lay it out
  Polyline (*loose)(double length, double ebar, int segments);
};

/// THE list.
const std::vector<Knot>& all_knots();

/// Throws std::invalid_argument for a name that is not in the list.
const Knot& find_knot(std::string_view name);

}  // namespace bight::rod1d
