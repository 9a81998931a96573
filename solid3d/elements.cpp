#include "solid3d/elements.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace bight::solid3d {

const HexElement& hex_element(std::string_view name) {
  const auto found = std::ranges::find(hex_elements(), name, &HexElement::name);
  if (found == hex_elements().end())
    throw std::invalid_argument("no element is called " + std::string(name));
  return *found;
}

}  // namespace bight::solid3d
