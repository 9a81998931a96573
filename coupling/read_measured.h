#pragma once

#include <filesystem>
#include <optional>

#include "coupling/force_curve.h"
#include "coupling/units.h"

namespace bight::coupling {

/// A measured force curve. Columns by name, in any order and among others:
///
///   ebar              or shortening with a unit of length: L0 - L
///   force_normalised  or force with a unit of force
///   spread            (optional) of the force, half the width of its band; in the unit that it
///                     names, else in that of the force
///
/// A unit stands behind the name, as in `force [mN]`, `force (mN)` or `force_mN`. Quantities with
/// units need the scales of the rod they are laid on. Throws InputError with what is missing.
ForceCurve read_measured(const std::filesystem::path& file, const std::optional<Scales>& scales);

}  // namespace bight::coupling
