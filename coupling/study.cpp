#include "coupling/study.h"

#include <fmt/format.h>

#include <algorithm>

#include "coupling/errors.h"
#include "coupling/files.h"
#include "coupling/results_folder.h"
#include "coupling/side_by_side.h"
#include "coupling/write_study.h"

namespace bight::coupling {
namespace {

namespace fs = std::filesystem;

fs::path whole(const fs::path& path) { return fs::absolute(path).lexically_normal(); }

void check_extrapolation(const Study& plan) {
  if (plan.extrapolate.empty()) return;
  for (const Dimension& dimension : plan.grid)
    if (dimension.key->path == plan.extrapolate && dimension.resolution() &&
        dimension.values.size() >= 3)
      return;
  throw InputError(fmt::format(
      "study.extrapolate: {} is not a key of the grid with three or more finer and finer values",
      plan.extrapolate));
}

// A run that gave up would give up again: it is done too.
std::vector<size_t> not_done(const Study& plan, bool force) {
  std::vector<size_t> points;
  for (size_t i = 0; i < plan.points.size(); ++i) {
    const FolderState state = take_folder(plan.run_folder(i), plan.scenes[i], true, force);
    const bool gave_up = state == FolderState::begun && run_status(plan.run_folder(i)) == "gave up";
    if (state != FolderState::finished && !gave_up) points.push_back(i);
  }
  return points;
}

Words command(const Study& plan, const fs::path& program, size_t point) {
  Words words = {program, "run", plan.scene};
  for (const auto* settings : {&plan.settings, &plan.points[point].settings})
    for (const std::string& setting : *settings) {
      words.push_back("--set");
      words.push_back(setting);
    }
  for (const std::string& word :
       {std::string("--out"), plan.run_folder(point).string(), std::string("--threads"),
        std::string("1"), std::string("--resume"), std::string("--quiet")})
    words.push_back(word);
  return words;
}

void write_job_list(const fs::path& file, const std::vector<Words>& jobs) {
  std::string text;
  for (const Words& words : jobs) text += shell_line(words) + '\n';
  write_whole(file, text);
}

// One task of the array is one run on one core. Slurm takes no array without tasks.
void write_slurm_array(const fs::path& file, const Study& plan, const std::vector<Words>& jobs) {
  std::string text = fmt::format(
      "#!/bin/bash\n#SBATCH --job-name={}\n#SBATCH --array=1-{}\n#SBATCH --cpus-per-task=1\n"
      "# Then call `bight study` again: it collects what the tasks left in\n# {}\n"
      "export OMP_WAIT_POLICY=passive\ncase $SLURM_ARRAY_TASK_ID in\n",
      shell_line({plan.name}), jobs.size(), plan.folder.string());
  for (size_t i = 0; i < jobs.size(); ++i)
    text += fmt::format("{}) exec {} ;;\n", i + 1, shell_line(jobs[i]));
  write_whole(file, text + "esac\n");
}

}  // namespace

Study plan_study(const fs::path& scene, const std::vector<std::string>& settings,
                 const std::vector<std::string>& grid, const fs::path& out) {
  const Scene base = read_scene(scene, settings);
  if (!base.cases.empty())
    throw InputError(scene.string() +
                     ": cases: a study is of one case; give it what differs as --set");
  Study plan{whole(scene),
             base.name,
             base.extrapolate,
             settings,
             whole(out.empty() ? fs::path("results") / base.name : out),
             {},
             {},
             {}};
  std::vector<std::string> lines = base.grid;
  lines.insert(lines.end(), grid.begin(), grid.end());
  if (lines.empty())
    throw InputError(
        fmt::format("{}: nothing to study; write a table [study.grid], or --grid KEY=VALUE,VALUE",
                    scene.string()));
  plan.grid = read_grid(lines);
  plan.points = product(plan.grid);
  check_extrapolation(plan);
  for (const GridPoint& point : plan.points) {
    std::vector<std::string> all = settings;
    all.insert(all.end(), point.settings.begin(), point.settings.end());
    try {
      plan.scenes.push_back(read_scene(plan.scene, all));
    } catch (const InputError& error) {
      throw InputError(fmt::format("in the run {}: {}", point.name, error.what()));
    }
  }
  return plan;
}

ExitStatus study(const Study& plan, const StudyOptions& options) {
  const std::vector<size_t> points = not_done(plan, options.force);
  std::vector<Words> jobs;
  for (const size_t point : points) jobs.push_back(command(plan, options.program, point));
  if (!options.jobs.empty()) write_job_list(options.jobs, jobs);
  if (!options.slurm.empty() && !jobs.empty()) write_slurm_array(options.slurm, plan, jobs);
  const auto say = [&](const std::string& text) {
    if (!options.quiet) fmt::print("{}", text), std::fflush(stdout);
  };
  say(fmt::format("{} runs, {} of them done\n", plan.points.size(),
                  plan.points.size() - points.size()));
  if (!options.jobs.empty() || !options.slurm.empty()) {
    if (jobs.empty())
      say("nothing is left to run: call it without --jobs and --slurm to collect\n");
    return done;
  }

  make_folder(plan.folder / "runs");
  std::vector<std::string> trouble(plan.points.size());
  size_t ended = 0;
  const bool all = run_side_by_side(jobs, options.side_by_side, [&](size_t job, int status) {
    const size_t point = points[job];
    std::string result = run_status(plan.run_folder(point));
    if (status != done && status != gave_up)
      result = trouble[point] = fmt::format("ended with exit status {}", status);
    say(fmt::format("[{}/{}] {}: {}\n", ++ended, jobs.size(), plan.points[point].name, result));
  });
  if (!all) {
    say("interrupted; call the study again to go on\n");
    return stopped;
  }

  std::vector<StudyRow> rows;
  for (size_t i = 0; i < plan.points.size(); ++i)
    for (StudyRow& row : read_rows(plan.run_folder(i), i, plan.scenes[i], trouble[i]))
      rows.push_back(std::move(row));
  const std::vector<StudyCase> cases = study_cases(plan.grid, plan.points, rows, plan.extrapolate);
  write_study_csv(plan.folder / "study.csv", plan, rows);
  write_states_csv(plan.folder / "study_states.csv", plan, rows, cases);
  write_study_json(plan.folder / "study.json", plan, rows, cases);
  for (const StudyCase& of : cases)
    for (const std::string& sentence : sentences(plan, rows, of)) say(sentence + '\n');
  say(fmt::format("results in {}\n", plan.folder.string()));
  return std::ranges::any_of(rows, &StudyRow::finished) ? done : gave_up;
}

}  // namespace bight::coupling
