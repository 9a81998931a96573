#pragma once

#include <string_view>

#include "solid3d/material/parameters.h"
#include "solid3d/material/parts.h"

namespace bight::solid3d {

/// Near-incompressible neo-Hookean solid, W = mu/2 (J^(-2/3) I1 - 3), I1 = F : F, J = det F, and of
/// the element's dilatation U = K/2 (theta - 1)^2.
/// Simo, Taylor and Pister, Comput. Methods Appl. Mech. Eng. 51, 177 (1985). Stresses in E.
struct NeoHookean {
  static constexpr std::string_view name = "neo-hookean";
  double shear_modulus = 1.0 / 3, bulk_modulus = 1000.0 / 3;  ///< mu, K [E]

  static NeoHookean from(const MaterialParameters& p) {
    return {p.shear_modulus(), p.bulk_modulus()};
  }

  Volumetric volumetric(double theta_1) const {
    return quadratic_volumetric(bulk_modulus, theta_1);
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
    const double c = shear_modulus * isochoric(J), I1 = F.squaredNorm();
    const Eigen::Map<const Vector9> f(F.data()), g(F_inverse_T.data());
    Matrix9 A = Matrix9::Identity();
    A.noalias() -= 2.0 / 3 * (f * g.transpose() + g * f.transpose());
    A.noalias() += 2.0 / 9 * I1 * (g * g.transpose());
    add_transposed_product(I1 / 3, F_inverse_T, A);
    return c * A;
  }
};

}  // namespace bight::solid3d
