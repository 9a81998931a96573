#pragma once

#include <cstddef>
#include <vector>

#include "mechanics/types.h"

namespace bight {

/// A symmetric sparse matrix by compressed columns: the lower triangle, rows ascending. Entries
/// above the diagonal may be present (whole diagonal blocks) and are ignored.
struct SymmetricMatrix {
  std::vector<int> column_start;
  std::vector<int> row;
  std::vector<double> value;
  int size() const { return static_cast<int>(column_start.size()) - 1; }

  /// Where the entry (j, j) is in `value`.
  std::size_t diagonal(int j) const;
  Vector times(const Vector& u) const;
};

}  // namespace bight
