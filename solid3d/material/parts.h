#pragma once

#include <Eigen/Dense>
#include <cmath>

#include "mechanics/types.h"

namespace bight::solid3d {

/// What stored energies are made of. Derivatives by F are over its columns: 9 and 9 x 9.
using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Vector9 = Eigen::Matrix<double, 9, 1>;

/// U of the dilatation theta = v/V, with its slope (the pressure) and curvature [E].
struct Volumetric {
  double energy, slope, curvature;
};

/// U = K/2 (theta - 1)^2, of theta - 1.
inline Volumetric quadratic_volumetric(double K, double theta_1) {
  return {0.5 * K * theta_1 * theta_1, K * theta_1, K};
}

/// U = K/4 (theta^2 - 1 - 2 ln theta), of theta - 1; not finite where theta is not positive.
inline Volumetric logarithmic_volumetric(double K, double theta_1) {
  const double theta = 1 + theta_1, square_1 = theta_1 * (2 + theta_1);
  return {0.25 * K * (square_1 - 2 * std::log1p(theta_1)), 0.5 * K * square_1 / theta,
          0.5 * K * (1 + 1 / (theta * theta))};
}

/// A += factor d(G dF^T G)/dF for G = F^-T: entry (iK, jL) is G_iL G_jK. (d F^-T = -G dF^T G.)
inline void add_transposed_product(double factor, const Matrix3& G, Matrix9& A) {
  for (int L = 0; L < 3; ++L)
    for (int j = 0; j < 3; ++j)
      for (int K = 0; K < 3; ++K)
        for (int i = 0; i < 3; ++i) A(i + 3 * K, j + 3 * L) += factor * G(i, L) * G(j, K);
}

/// J^(-2/3): a cube root is half the price of a power.
inline double isochoric(double J) {
  const double root = std::cbrt(J);
  return 1 / (root * root);
}

}  // namespace bight::solid3d
