#pragma once

#include <string_view>

#include "solid3d/material/neo_hookean.h"

namespace bight::solid3d {

/// Mooney-Rivlin solid, W = C10 (J^(-2/3) I1 - 3) + C01 (J^(-4/3) I2 - 3) and U = K/2 (theta -
/// 1)^2; I2 = (I1^2 - |F^T F|^2)/2. mu_s = 2 (C10 + C01), and K = 2/D1 in the letters of Abaqus.
/// Mooney, J. Appl. Phys. 11, 582 (1940); Holzapfel, Nonlinear Solid Mechanics (2000), eq. 6.147.
struct MooneyRivlin {
  static constexpr std::string_view name = "mooney-rivlin";
  double shear_modulus = 1.0 / 3, bulk_modulus = 1000.0 / 3;  ///< mu_s, K [E]
  double c01_share = 0.5;                                     ///< C01 / (C10 + C01)

  static MooneyRivlin from(const MaterialParameters& p) {
    return {p.shear_modulus(), p.bulk_modulus(), p.c01_share};
  }

  Volumetric volumetric(double theta_1) const {
    return quadratic_volumetric(bulk_modulus, theta_1);
  }

  double energy(const Matrix3& F, double J) const {
    const double m = isochoric(J);
    return first().energy(F, J) + C01() * (m * m * second_invariant(F) - 3);
  }

  /// Second part: C01 J^(-4/3) (S - 4/3 I2 F^-T), S = dI2/dF = 2 (I1 F - F F^T F).
  Matrix3 stress(const Matrix3& F, const Matrix3& F_inverse_T, double J) const {
    const double m = isochoric(J), c = C01() * m * m;
    return first().stress(F, F_inverse_T, J) +
           c * (slope(F) - 4.0 / 3 * second_invariant(F) * F_inverse_T);
  }

  /// Second part: C01 J^(-4/3) (dS - 4/3 (F^-T:dF) S - 4/3 (S:dF) F^-T
  ///                            + 16/9 I2 (F^-T:dF) F^-T + 4/3 I2 F^-T dF^T F^-T),
  /// dS = 2 (I1 dF + 2 (F:dF) F - dF F^T F - F F^T dF - F dF^T F).
  Matrix9 tangent(const Matrix3& F, const Matrix3& F_inverse_T, double J) const {
    const double m = isochoric(J), c = C01() * m * m;
    const double I1 = F.squaredNorm(), I2 = second_invariant(F);
    const Matrix3 S = slope(F), C = F.transpose() * F, B = F * F.transpose();
    const Eigen::Map<const Vector9> f(F.data()), g(F_inverse_T.data()), s(S.data());
    Matrix9 A = 2 * I1 * Matrix9::Identity();
    A.noalias() += 4 * (f * f.transpose());
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) A.block<3, 3>(3 * k, 3 * l).diagonal().array() -= 2 * C(k, l);
    for (int k = 0; k < 3; ++k) A.block<3, 3>(3 * k, 3 * k) -= 2 * B;
    add_transposed_product(-2, F, A);
    A.noalias() -= 4.0 / 3 * (s * g.transpose() + g * s.transpose());
    A.noalias() += 16.0 / 9 * I2 * (g * g.transpose());
    add_transposed_product(4.0 / 3 * I2, F_inverse_T, A);
    return first().tangent(F, F_inverse_T, J) + c * A;
  }

 private:
  double C01() const { return 0.5 * shear_modulus * c01_share; }
  NeoHookean first() const { return {shear_modulus * (1 - c01_share), bulk_modulus}; }
  static double second_invariant(const Matrix3& F) {
    const double I1 = F.squaredNorm();
    return 0.5 * (I1 * I1 - (F.transpose() * F).squaredNorm());
  }
  static Matrix3 slope(const Matrix3& F) {
    return 2 * (F.squaredNorm() * F - F * F.transpose() * F);
  }
};

}  // namespace bight::solid3d
