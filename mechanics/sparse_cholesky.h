#pragma once

#include <cstddef>
#include <memory>

#include "mechanics/symmetric_matrix.h"

namespace bight {

/// Natural: keep the order of the unknowns (a rod without contact is banded along its length).
/// Minimum degree: AMD on the pattern (a rod's contact couples far parts of it), quickly found.
/// Dissection: arms of the pattern (mechanics/arms.h) from their ends, METIS on the rest (a solid).
enum class Ordering { natural, minimum_degree, dissection };

/// Sparse Cholesky factorisation of a symmetric positive definite matrix: CHOLMOD's door. Small or
/// narrow matrices are CHOLMOD's from end to end; for supernodal ones it orders and analyses, and
/// Multifrontal does the numbers.
class SparseCholesky {
 public:
  SparseCholesky();
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// Symbolic analysis of the pattern; kept until the next call.
  void analyse(const SymmetricMatrix& matrix, Ordering ordering);

  /// Factors matrix + shift * identity; false when that is not positive definite (or not finite).
  bool factor(const SymmetricMatrix& matrix, double shift = 0);

  /// Solves with the last successful factor.
  Vector solve(const Vector& right_hand_side) const;

  std::size_t factor_entries() const;  ///< non-zeros of L
  double factor_flops() const;         ///< floating point operations of one factorisation

 private:
  struct Package;
  std::unique_ptr<Package> package_;
};

}  // namespace bight
