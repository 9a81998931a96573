#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "coupling/checkpoint.h"
#include "coupling/phases.h"
#include "coupling/progress.h"
#include "coupling/scene.h"
#include "coupling/write_csv.h"
#include "coupling/write_vtu.h"

namespace bight::coupling {

/// Writes what the models hand out while they run: force.csv, run.log, states, and times of phases.
class Recorder {
 public:
  Recorder(const std::filesystem::path& folder, const Scene& scene, bool quiet);

  /// Observers to be given to the models; `path` is what each will follow.
  rod1d::RodObserver watch_rod(const Path& path);
  /// `from`: what was written up to there is written again, and the run goes on behind it.
  solid3d::SolidObserver watch_solid(const solid3d::Mesh& mesh, const Path& path,
                                     const std::optional<Checkpoint>& from);

  /// Of a state of the solid on another mesh.
  solid3d::SolidObserver watch_confirmation(const solid3d::Mesh& mesh, const Path& path);

  const std::filesystem::path& folder() const { return folder_; }

  Phases phases;
  Progress progress;
  std::optional<rod1d::RodState> seed;  ///< the rod's state at the scene's seed_ebar
  std::vector<StepRow> solid_rows;
  /// Without their fields, for the summary; where they are to be confirmed, with nodes.
  std::vector<solid3d::SolidState> solid_states;

 private:
  /// The files of one fidelity.
  struct Files {
    Files(const std::filesystem::path& folder, const std::string& name, const Scales& scales);
    std::string next_name(double ebar);  ///< an ebar that is met again gets a number
    std::filesystem::path folder;
    ForceCsv force;
    Series series;
    std::map<std::string, int> met;
  };
  void write(const rod1d::RodState& state);
  void write(Files& files, const solid3d::Mesh& mesh, const solid3d::SolidState& state);
  void keep(const solid3d::SolidState& state);

  std::filesystem::path folder_;
  const Scene& scene_;
  std::optional<Files> rod_, solid_, confirmed_;
};

}  // namespace bight::coupling
