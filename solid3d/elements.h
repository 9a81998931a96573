#pragma once

#include <string_view>
#include <vector>

#include "solid3d/hex.h"

namespace bight::solid3d {

/// A hexahedron that a solid can be made of: three fields (effects/strain.h) on a quadrature, and
/// what resists the modes that the quadrature does not see (effects/hourglass.h).
struct HexElement {
  std::string_view name;
  Quadrature quadrature;
  bool hourglass;
};

/// THE list of elements.
inline const std::vector<HexElement>& hex_elements() {
  static const std::vector<HexElement> list = {
      {"three-field", Quadrature::gauss, false},   // Q1-P0
      {"reduced-hybrid", Quadrature::mean, true},  // as Abaqus' C3D8RH
  };
  return list;
}

/// Throws std::invalid_argument for a name that is not in the list.
const HexElement& hex_element(std::string_view name);

}  // namespace bight::solid3d
