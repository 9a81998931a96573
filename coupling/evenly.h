#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace bight::coupling {

/// At most `most` of the numbers 0 ... count - 1, evenly spaced, with both ends (of one the first).
inline std::vector<size_t> evenly(size_t count, size_t most) {
  std::vector<size_t> chosen;
  if (count <= most)
    for (size_t i = 0; i < count; ++i) chosen.push_back(i);
  else
    for (size_t k = 0; k < most; ++k)
      chosen.push_back(k * (count - 1) / std::max<size_t>(1, most - 1));
  return chosen;
}

}  // namespace bight::coupling
