#pragma once

#include <string>
#include <vector>

#include "coupling/run.h"
#include "coupling/scene.h"

namespace bight::coupling {

/// One of a scene's cases, or the scene itself, without a name.
struct SceneCase {
  std::string name;
  Scene scene;
};

/// All cases of a scene, read and checked before any of them runs, or the one named `only`. What a
/// case sets overrides the scene, and `settings` override both. Throws InputError.
std::vector<SceneCase> read_cases(const std::filesystem::path& file,
                                  const std::vector<std::string>& settings,
                                  const std::vector<std::string>& fidelities,
                                  const std::string& only);

/// Runs a scene, or its cases one after another, each in a folder of its name inside that of the
/// options, and then lays their force curves on each other in `compare.csv`. A case that gives up
/// does not stop the next ones; the worst exit status counts.
ExitStatus run_cases(const std::vector<SceneCase>& cases, const RunOptions& options);

}  // namespace bight::coupling
