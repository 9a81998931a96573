#pragma once

#include <string>
#include <vector>

#include "coupling/keys.h"

namespace bight::coupling {

/// A key of the scene and the values that a study gives it, as they are written behind --set.
struct Dimension {
  const Key* key;
  std::vector<std::string> values;

  bool resolution() const;  ///< finer and coarser runs of the same problem
  /// Size with which errors fall, in a unit of its own: h of a count is its inverse.
  double size(size_t value) const;
};

/// One run of a study: which value of each dimension it takes.
struct GridPoint {
  std::vector<size_t> at;
  std::vector<std::string> settings;  ///< "key=value", as behind --set
  std::string name;                   ///< of its folder: the settings
};

/// Reads "key=value,value" (values as in TOML, or plain text parted by commas); a later line of the
/// same key replaces an earlier one. Throws InputError that names what cannot be read.
std::vector<Dimension> read_grid(const std::vector<std::string>& lines);

/// Every combination, the last dimension running fastest.
std::vector<GridPoint> product(const std::vector<Dimension>& grid);

}  // namespace bight::coupling
