#include <fmt/format.h>

#include <exception>

#include "coupling/cases.h"
#include "coupling/command_line.h"
#include "coupling/compare.h"
#include "coupling/compare_centerlines.h"
#include "coupling/errors.h"
#include "coupling/expect.h"
#include "coupling/files.h"
#include "coupling/interrupt.h"
#include "coupling/keys.h"
#include "coupling/read_curves.h"
#include "coupling/report.h"
#include "coupling/run.h"
#include "coupling/study.h"

using namespace bight::coupling;

namespace {

ExitStatus compare_sources(const Command& command) {
  std::vector<ForceCurve> curves;
  std::vector<std::pair<std::string, std::filesystem::path>> folders;
  double friction = 0;
  std::optional<Scales> scales;  // of the first rod
  for (const auto& source : command.sources) {
    if (!scales) scales = read_scales(source);
    for (ForceCurve& curve : read_curves(source, scales)) curves.push_back(std::move(curve));
    for (auto& folder : fidelity_folders(source)) folders.push_back(std::move(folder));
    if (const auto of_source = read_friction(source)) friction = *of_source;
  }
  const Comparison comparison = compare(curves, friction);
  fmt::print("{}", comparison_text(comparison));
  if (!command.out.empty()) {
    make_folder(command.out);
    write_comparison(command.out / "compare.csv", comparison);
  }
  for (size_t i = 1; i < folders.size(); ++i) {
    const auto differences = compare_centerlines(folders[0].second, folders[i].second);
    fmt::print("{}", curvature_text(folders[0].first, folders[i].first, differences));
    if (!command.out.empty() && !differences.empty())
      write_curvature(command.out / ("curvature_" + folders[i].first + ".csv"), differences);
  }
  return done;
}

ExitStatus study_scene(const Command& command) {
  const Study plan = plan_study(command.scene, command.settings, command.grid, command.out);
  catch_interrupts();
  return study(plan, {.program = std::filesystem::read_symlink("/proc/self/exe"),
                      .jobs = command.jobs,
                      .slurm = command.slurm,
                      .side_by_side = command.threads,
                      .force = command.force,
                      .quiet = command.quiet});
}

ExitStatus obey(const Command& command) {
  if (command.verb == "keys") return fmt::print("{}", keys_table()), done;
  if (command.verb == "compare") return compare_sources(command);
  if (command.verb == "check") {
    for (const SceneCase& c : read_cases(command.scene, command.settings, {}, command.only_case))
      fmt::print("{}{}", c.name.empty() ? "" : "case " + c.name + "\n", expectations(c.scene));
    return done;
  }

  if (command.verb == "study") return study_scene(command);
  if (command.verb == "report")
    return report(command.results, {command.out, command.measured, command.script}), done;

  const std::vector<std::string> only =
      command.verb == "run" ? std::vector<std::string>{} : std::vector{command.verb};
  const std::vector<SceneCase> cases =
      read_cases(command.scene, command.settings, only, command.only_case);
  catch_interrupts();
  const RunOptions options{.folder = command.out.empty()
                                         ? std::filesystem::path("results") / cases[0].scene.name
                                         : command.out,
                           .threads = command.threads,
                           .resume = command.resume,
                           .force = command.force,
                           .quiet = command.quiet};
  return run_cases(cases, options);
}

ExitStatus fail(ExitStatus status, const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto command = read_command_line(argc, argv);
    return command ? obey(*command) : done;
  } catch (const InputError& error) {
    return fail(bad_input, error);
  } catch (const FileError& error) {
    return fail(file_trouble, error);
  } catch (const std::exception& error) {
    return fail(gave_up, error);
  }
}
