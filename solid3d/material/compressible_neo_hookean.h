#pragma once

#include <string_view>

#include "solid3d/material/neo_hookean.h"

namespace bight::solid3d {

/// Neo-Hookean solid for moderate bulk moduli: W = mu/2 (J^(-2/3) I1 - 3), and
/// U = K/4 (theta^2 - 1 - 2 ln theta), which grows without bound as the volume goes to zero.
/// Simo and Miehe, Comput. Methods Appl. Mech. Eng. 98, 41 (1992), eq. 2.40. Stresses in E.
struct CompressibleNeoHookean {
  static constexpr std::string_view name = "compressible-neo-hookean";
  double shear_modulus = 1.0 / 3, bulk_modulus = 2.0 / 3;  ///< mu, K [E]

  static CompressibleNeoHookean from(const MaterialParameters& p) {
    return {p.shear_modulus(), p.bulk_modulus()};
  }

  Volumetric volumetric(double theta_1) const {
    return logarithmic_volumetric(bulk_modulus, theta_1);
  }

  double energy(const Matrix3& F, double J) const { return shape().energy(F, J); }
  Matrix3 stress(const Matrix3& F, const Matrix3& F_inverse_T, double J) const {
    return shape().stress(F, F_inverse_T, J);
  }
  Matrix9 tangent(const Matrix3& F, const Matrix3& F_inverse_T, double J) const {
    return shape().tangent(F, F_inverse_T, J);
  }

 private:
  NeoHookean shape() const { return {shear_modulus, bulk_modulus}; }
};

}  // namespace bight::solid3d
