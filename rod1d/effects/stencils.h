#pragma once

#include <array>
#include <span>
#include <vector>

#include "mechanics/effect.h"

namespace bight::rod1d {

/// Coordinates of the stencils of an effect whose stencils never change: N per stencil.
template <int N>
class Stencils {
 public:
  void add(const std::array<int, N>& coordinates) { list_.push_back(coordinates); }
  int size() const { return static_cast<int>(list_.size()); }
  const std::array<int, N>& operator[](int i) const { return list_[i]; }

  /// The values of x that a stencil reads.
  Eigen::Matrix<double, N, 1> gather(const Vector& x, int i) const {
    Eigen::Matrix<double, N, 1> values;
    for (int k = 0; k < N; ++k) values[k] = x[list_[i][k]];
    return values;
  }

 private:
  std::vector<std::array<int, N>> list_;
};

}  // namespace bight::rod1d
