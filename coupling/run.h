#pragma once

#include <filesystem>

#include "coupling/scene.h"

namespace bight::coupling {

enum ExitStatus { done = 0, gave_up = 1, bad_input = 2, file_trouble = 3, stopped = 130 };

struct RunOptions {
  std::filesystem::path folder;
  int threads = 1;
  bool resume = false, force = false, quiet = false;
};

/// The whole flow: scene -> rod -> sweep -> solid -> compare -> files.
ExitStatus run(const Scene& scene, const RunOptions& options);

}  // namespace bight::coupling
