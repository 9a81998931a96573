#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "solid3d/material/compressible_neo_hookean.h"
#include "solid3d/material/mooney_rivlin.h"
#include "solid3d/material/neo_hookean.h"
#include "solid3d/material/ogden.h"

namespace bight::solid3d {

/// THE list of materials. Each has a `name`, `from(MaterialParameters)`, its `shear_modulus` at
/// small strain [E], and two parts of its stored energy per reference volume [E]:
///   W(F), with stress dW/dF and tangent d2W/dF2, at every point of a cell;
///   U(theta), `volumetric(theta - 1)`, of the dilatation of the cell.
/// A large modulus belongs into U, which the cells take in the mean, else they lock.
using Material = std::variant<NeoHookean, CompressibleNeoHookean, MooneyRivlin, Ogden>;

/// Throws std::invalid_argument for a name that is not in the list.
Material make_material(const MaterialParameters& parameters);

std::vector<std::string_view> material_names();

inline Volumetric volumetric(const Material& material, double theta_1) {
  return std::visit([&](const auto& m) { return m.volumetric(theta_1); }, material);
}

}  // namespace bight::solid3d
