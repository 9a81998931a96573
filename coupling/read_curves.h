#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/force_curve.h"
#include "coupling/units.h"

namespace bight::coupling {

/// The force curves of a results folder (rod, solid), or the one of a measured CSV file (see
/// read_measured.h). Throws InputError when there is none.
std::vector<ForceCurve> read_curves(const std::filesystem::path& source,
                                    const std::optional<Scales>& scales = {});

/// Scales of the rod of a results folder, as its scene.toml says in SI; nothing for a measured
/// file. What else the scene names (a centerline file) need not be there any more.
std::optional<Scales> read_scales(const std::filesystem::path& source);

/// Folders with centerline files in a results folder, by the names that their force curves have.
std::vector<std::pair<std::string, std::filesystem::path>> fidelity_folders(
    const std::filesystem::path& source);

/// Coulomb coefficient of a results folder; nothing for a measured file.
std::optional<double> read_friction(const std::filesystem::path& source);

}  // namespace bight::coupling
