#pragma once

#include "coupling/values.h"
#include "solid3d/material/parameters.h"

namespace bight::coupling {

/// Shear modulus at small strain [Pa] that the model's own moduli sum to; 0 where none are given.
double moduli_sum(const Values& values);

/// E that goes with a shear modulus, at the scene's ratio of bulk and shear modulus.
double youngs_modulus_of(double shear_modulus, const Values& values);

/// What the solid is made of; moduli become shares of their sum.
solid3d::MaterialParameters material_parameters(const Values& values);

/// Refuses moduli that are missing, of another model, or at odds with Young's modulus.
void check_moduli(const Values& values, Problems& problems);

}  // namespace bight::coupling
