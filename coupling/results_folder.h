#pragma once

#include <filesystem>

#include "coupling/scene.h"

namespace bight::coupling {

enum class FolderState { fresh, begun, finished };

/// Looks at the folder for results before anything is written. A finished result of the very same
/// scene is `finished`; an absent or empty folder is `fresh`, and so is one that `force` clears of
/// everything bight writes. A result of the very same scene that is not finished is `begun` for
/// `resume`. Any other folder is refused by InputError.
FolderState take_folder(const std::filesystem::path& folder, const Scene& scene, bool resume,
                        bool force);

}  // namespace bight::coupling
