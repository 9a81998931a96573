#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coupling/grid.h"
#include "coupling/scene.h"

namespace bight::coupling {

/// Tension (Tbar) and energy [J] at a recorded ebar.
struct RecordedState {
  double ebar, force, energy;
};

/// By ebar, and the how manieth time it was met.
using RecordedStates = std::map<std::pair<double, int>, RecordedState>;

/// How far a result is from the reference: relative differences over the ebar that both recorded.
struct ResultError {
  double force_largest, force_mean, energy_largest, energy_mean;
  std::optional<double> curvature_mean;  ///< mean |kappa difference| over mean kappa, of the knot
  size_t states;
};

/// What one run of a study gave for one fidelity.
struct StudyRow {
  size_t point;  ///< of the grid
  std::string fidelity;
  std::string status, reason;    ///< "finished", "gave up", or "failed" without any result
  std::filesystem::path folder;  ///< of the fidelity
  RecordedStates states;
  /// Of tying and the rod; of the solid everything, since the rod seeds it.
  double wall_s = 0, cpu_s = 0, peak_MB = 0;
  int unknowns = 0, steps = 0, iterations = 0;
  std::optional<ResultError> error = {};
  bool reference = false, on_front = false;

  /// Of one processor: what a run on one thread takes on a machine that does nothing else.
  double seconds() const { return cpu_s > 0 ? cpu_s : wall_s; }
  bool finished() const { return status == "finished"; }
};

/// "finished", "gave up" or "interrupted" from summary.json; empty without one.
std::string run_status(const std::filesystem::path& folder);

/// A row for each fidelity that the scene of the run asks for.
std::vector<StudyRow> read_rows(const std::filesystem::path& folder, size_t point,
                                const Scene& scene, const std::string& trouble);

/// T of a state over that of the same one of the reference, less 1; nothing where there is none.
std::optional<double> force_difference(const RecordedStates::value_type& state,
                                       const RecordedStates& reference);

/// Nothing when no ebar is recorded in both.
std::optional<ResultError> error_against(const RecordedStates& states,
                                         const RecordedStates& reference);

}  // namespace bight::coupling
