#include "coupling/run.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>

#include "coupling/checkpoint.h"
#include "coupling/compare.h"
#include "coupling/compare_centerlines.h"
#include "coupling/confirm.h"
#include "coupling/recorder.h"
#include "coupling/results_folder.h"
#include "coupling/sweep.h"
#include "coupling/validity.h"
#include "coupling/write_summary.h"

namespace bight::coupling {
namespace {

ForceCurve curve(const std::string& name, const std::vector<StepRow>& steps) {
  ForceCurve result{name, {}, {}};
  for (const StepRow& row : steps) {
    result.ebar.push_back(row.ebar);
    result.force.push_back(normalised_force(row.tension));
  }
  return result;
}

void run_seeded_solid(const Scene& scene, Recorder& recorder, const std::optional<Checkpoint>& from,
                      RunReport& report) {
  recorder.phases.enter("seed");
  const rod1d::RodState& seed = *recorder.seed;
  solid3d::SolidParameters parameters = solid_parameters(scene);
  SweepOptions options = sweep_options(scene, scene.section_elements);
  options.loosened_by = std::ranges::max(parameters.path.waypoints) - seed.ebar;
  const solid3d::Mesh mesh = swept_mesh(options, seed);
  const std::vector<Vector3> start = sweep(mesh, seed);
  parameters.expected_tension = seed.tension;
  parameters.rubs = seed.rubs;
  solid3d::SolidResult result =
      run_solid(mesh, start, seed.ebar, parameters,
                recorder.watch_solid(mesh, parameters.path, from), from ? &from->solid : nullptr);
  result.steps = recorder.solid_rows;
  report.solid = std::move(result);
  if (!report.interrupted()) report.confirmed = confirm(scene, mesh, recorder);
}

Comparison compare_fidelities(const Scene& scene, const RunReport& report, Recorder& recorder) {
  recorder.phases.enter("compare");
  std::vector<ForceCurve> curves;
  if (scene.rod) curves.push_back(curve("rod", report.rod.steps));
  if (report.solid) curves.push_back(curve("solid", report.solid->steps));
  const Comparison comparison = compare(curves, scene.friction);
  write_comparison(recorder.folder() / "compare.csv", comparison);
  std::string verdict;
  if (scene.rod) {
    const std::vector<RodError> errors = rod_errors(report.rod.steps);
    write_rod_errors(recorder.folder() / "rod" / "validity.csv", errors);
    verdict = validity_sentence(errors, verdict_level) + "\n";
  }
  recorder.progress.say(
      comparison_text(comparison) + verdict +
      curvature_text("rod", "solid",
                     compare_centerlines(recorder.folder() / "rod", recorder.folder() / "solid")));
  return comparison;
}

}  // namespace

ExitStatus run(const Scene& scene, const RunOptions& options) {
  const rod1d::RodParameters rod = rod_parameters(scene);
  const FolderState state = take_folder(options.folder, scene, options.resume, options.force);
  if (state == FolderState::finished) {
    fmt::print("{} holds the finished result of this very scene\n", options.folder.string());
    return done;
  }
  omp_set_num_threads(options.threads);
  // The rod is done again: that takes seconds, and gives the same seed.
  std::optional<Checkpoint> checkpoint;
  if (state == FolderState::begun && scene.solid) checkpoint = newest_checkpoint(options.folder);
  Recorder recorder(options.folder, scene, options.quiet);
  RunReport report{scene, options.threads};

  report.rod = run_rod(rod, recorder.watch_rod(rod.path));
  if (scene.solid && recorder.seed && !report.interrupted())
    run_seeded_solid(scene, recorder, checkpoint, report);
  recorder.progress.end();
  report.comparison = compare_fidelities(scene, report, recorder);
  write_summary(report, recorder);

  recorder.progress.say(
      fmt::format("{}; results in {}", report.verdict(), options.folder.string()));
  return report.interrupted() ? stopped : report.finished() ? done : gave_up;
}

}  // namespace bight::coupling
