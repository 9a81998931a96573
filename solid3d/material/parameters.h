#pragma once

#include <string>
#include <vector>

namespace bight::solid3d {

/// One term of Ogden's energy: its share of mu_s, and its exponent.
struct OgdenTerm {
  double share = 1, exponent = 2;
};

/// The material of a solid. Stresses are in E: Young's modulus at small strain is 1, whatever the
/// model, so that mu_s and K follow from their ratio, E = 9 K mu_s / (3 K + mu_s).
struct MaterialParameters {
  std::string model = "neo-hookean";  ///< a name in the list of material.h
  double bulk_to_shear = 1000;        ///< k = K / mu_s
  double c01_share = 0;               ///< of C10 + C01 = mu_s / 2 (mooney-rivlin)
  std::vector<OgdenTerm> ogden{{}};   ///< shares that sum to 1 (ogden)

  double shear_modulus() const { return (3 * bulk_to_shear + 1) / (9 * bulk_to_shear); }
  double bulk_modulus() const { return bulk_to_shear * shear_modulus(); }
};

}  // namespace bight::solid3d
