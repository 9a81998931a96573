#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "mechanics/types.h"

namespace bight {

/// Solves A x = b by GMRES (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7, 856, 1986) without
/// restart, to |b - A x| <= tolerance |b|, or as well as `most` products with A can. `product`:
/// A times a vector.
inline Vector gmres(const std::function<Vector(const Vector&)>& product, const Vector& b, int most,
                    double tolerance) {
  const double size = b.norm();
  if (size == 0) return b;
  std::vector<Vector> basis{b / size};
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(most + 1, most);
  Eigen::VectorXd y;
  for (int k = 0; k < most; ++k) {
    Vector v = product(basis[k]);
    for (int i = 0; i <= k; ++i) {
      H(i, k) = basis[i].dot(v);
      v -= H(i, k) * basis[i];
    }
    H(k + 1, k) = v.norm();
    // The least squares problem is small: solved anew in each step.
    const Eigen::MatrixXd small = H.topLeftCorner(k + 2, k + 1);
    const Eigen::VectorXd right = size * Eigen::VectorXd::Unit(k + 2, 0);
    y = small.householderQr().solve(right);
    if ((right - small * y).norm() <= tolerance * size || H(k + 1, k) <= 1e-14 * size) break;
    basis.push_back(v / H(k + 1, k));
  }
  Vector x = Vector::Zero(b.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) x += y[i] * basis[i];
  return x;
}

}  // namespace bight
