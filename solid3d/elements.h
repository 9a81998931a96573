#pragma once

#include <string_view>
#include <vector>

#include "solid3d/hex_reference.h"

namespace bight::solid3d {

/// A hexahedron that a solid can be made of: three fields (effects/strain.h) on a quadrature, and
/// what resists the modes that the quadrature does not see (effects/hourglass.h). Sections are made
/// of its degree.
struct HexElement {
  std::string_view name;
  int degree;
  Quadrature quadrature;
  bool hourglass;
};

/// THE list of elements.
inline const std::vector<HexElement>& hex_elements() {
  static const std::vector<HexElement> list = {
      {"three-field", 1, Quadrature::gauss, false},   // Q1-P0
      {"reduced-hybrid", 1, Quadrature::mean, true},  // as Abaqus' C3D8RH
      {"quadratic", 2, Quadrature::gauss, false},     // Q2-P1
  };
  return list;
}

/// Throws std::invalid_argument for a name that is not in the list.
const HexElement& hex_element(std::string_view name);

}  // namespace bight::solid3d
