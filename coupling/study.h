#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupling/grid.h"
#include "coupling/run.h"
#include "coupling/scene.h"

namespace bight::coupling {

/// A scene and the runs that a study makes of it.
struct Study {
  std::filesystem::path scene;  ///< absolute
  std::string name, extrapolate;
  std::vector<std::string> settings;  ///< of every run
  std::filesystem::path folder;       ///< absolute; runs lie in runs/NAME
  std::vector<Dimension> grid;
  std::vector<GridPoint> points;
  std::vector<Scene> scenes;  ///< of the points

  std::filesystem::path run_folder(size_t point) const {
    return folder / "runs" / points[point].name;
  }
};

struct StudyOptions {
  std::filesystem::path program;      ///< that runs a scene: this one
  std::filesystem::path jobs, slurm;  ///< written instead of running, when given
  int side_by_side = 1;               ///< runs at a time, each on one thread
  bool force = false, quiet = false;
};

/// Reads the scene with every combination of the grid (of the scene, and of `grid`, which goes
/// before it); throws InputError before anything is written. `out` may be empty.
Study plan_study(const std::filesystem::path& scene, const std::vector<std::string>& settings,
                 const std::vector<std::string>& grid, const std::filesystem::path& out);

/// Runs what has not been run yet, then writes study.csv and study.json: error against time.
ExitStatus study(const Study& plan, const StudyOptions& options);

}  // namespace bight::coupling
