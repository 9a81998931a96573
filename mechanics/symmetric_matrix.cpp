#include "mechanics/symmetric_matrix.h"

#include <algorithm>

namespace bight {

std::size_t SymmetricMatrix::diagonal(int j) const {
  const auto found =
      std::lower_bound(row.begin() + column_start[j], row.begin() + column_start[j + 1], j);
  return static_cast<std::size_t>(found - row.begin());
}

Vector SymmetricMatrix::times(const Vector& u) const {
  Vector product = Vector::Zero(size());
  for (int j = 0; j < size(); ++j)
    for (int k = column_start[j]; k < column_start[j + 1]; ++k) {
      const int i = row[k];
      if (i < j) continue;
      product[i] += value[k] * u[j];
      if (i > j) product[j] += value[k] * u[i];
    }
  return product;
}

}  // namespace bight
