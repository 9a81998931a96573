#pragma once

#include <Eigen/Dense>
#include <cmath>

#include "mechanics/types.h"

namespace bight::solid3d {

using Matrix9 = Eigen::Matrix<double, 9, 9>;

/// Isochoric neo-Hookean solid, W = mu/2 (J^(-2/3) I1 - 3), I1 = F : F, J = det F; its volumetric
/// partner is the quadratic U = K/2 (J - 1)^2 of the element's dilatation.
/// Simo, Taylor and Pister, Comput. Methods Appl. Mech. Eng. 51, 177 (1985). Stresses in E.
struct NeoHookean {
  double shear_modulus = 1.0 / 3;  ///< mu_s [E]

  /// mu_s that gives Young's modulus 1 = 9 K mu_s / (3 K + mu_s) at a ratio k = K / mu_s.
  static NeoHookean with_bulk_ratio(double k) { return {(3 * k + 1) / (9 * k)}; }

  /// J^(-2/3): a cube root is half the price of a power.
  static double isochoric(double J) {
    const double root = std::cbrt(J);
    return 1 / (root * root);
  }

  double energy(const Matrix3& F, double J) const {
    return 0.5 * shear_modulus * (isochoric(J) * F.squaredNorm() - 3);
  }

  /// First Piola stress P = mu J^(-2/3) (F - I1/3 F^-T).
  Matrix3 stress(const Matrix3& F, const Matrix3& F_inverse_T, double J) const {
    const double c = shear_modulus * isochoric(J);
    return c * (F - F.squaredNorm() / 3 * F_inverse_T);
  }

  /// dP/dF, 9 x 9 over column-major F:
  /// dP = mu J^(-2/3) (dF - 2/3 (F^-T:dF) F - 2/3 (F:dF) F^-T + 2/9 I1 (F^-T:dF) F^-T
  ///                   + I1/3 F^-T dF^T F^-T).
  Matrix9 tangent(const Matrix3& F, const Matrix3& F_inverse_T, double J) const {
    using Vector9 = Eigen::Matrix<double, 9, 1>;
    const double c = shear_modulus * isochoric(J), I1 = F.squaredNorm();
    const Eigen::Map<const Vector9> f(F.data()), g(F_inverse_T.data());
    Matrix9 A = Matrix9::Identity();
    A.noalias() -= 2.0 / 3 * (f * g.transpose() + g * f.transpose());
    A.noalias() += 2.0 / 9 * I1 * (g * g.transpose());
    add_transposed_product(I1 / 3, F_inverse_T, A);
    return c * A;
  }

  /// A += factor d(G dF^T G)/dF for G = F^-T: entry (iK, jL) is G_iL G_jK.
  static void add_transposed_product(double factor, const Matrix3& G, Matrix9& A) {
    for (int L = 0; L < 3; ++L)
      for (int j = 0; j < 3; ++j)
        for (int K = 0; K < 3; ++K)
          for (int i = 0; i < 3; ++i) A(i + 3 * K, j + 3 * L) += factor * G(i, L) * G(j, K);
  }
};

}  // namespace bight::solid3d
