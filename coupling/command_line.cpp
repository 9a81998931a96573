#include "coupling/command_line.h"

#include <omp.h>

#include <CLI/CLI.hpp>

#include "coupling/errors.h"

namespace bight::coupling {
namespace {

constexpr const char* exit_codes =
    "Exit status: 0 done; 1 the numerics gave up; 2 bad input; 3 a file could not be read or "
    "written;\n130 interrupted.";

CLI::App* add_verb(CLI::App& app, const char* verb, const char* does) {
  CLI::App* sub = app.add_subcommand(verb, does);
  sub->set_version_flag("--version", BIGHT_VERSION);
  sub->footer(exit_codes);
  return sub;
}

void add_scene(CLI::App* sub, Command& command) {
  sub->add_option("SCENE", command.scene, "Scene file (TOML)")->required();
  sub->add_option("--set", command.settings, "Override a key of the scene (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->trigger_on_parse(false);
  sub->add_option("--case", command.only_case, "This case of the scene alone")->type_name("NAME");
}

void add_run_options(CLI::App* sub, Command& command) {
  sub->add_option("--out", command.out, "Folder for results; default results/SCENE-NAME")
      ->type_name("DIR");
  sub->add_option("--threads", command.threads, "Threads; default all cores")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  sub->add_flag("--resume", command.resume, "Go on from the last checkpoint in DIR");
  sub->add_flag("--force", command.force, "Start over in a folder that is not empty");
  sub->add_flag("--quiet", command.quiet, "Print nothing but errors");
}

}  // namespace

std::optional<Command> read_command_line(int argc, char** argv) {
  Command command;
  command.threads = omp_get_num_procs();
  CLI::App app("bight: elastic knots as a Kirchhoff rod and as a 3D solid", "bight");
  app.set_version_flag("--version", BIGHT_VERSION);
  app.require_subcommand(1);
  app.footer(exit_codes);

  for (const auto& [verb, does] :
       {std::pair{"run", "Simulate what the scene asks for, then compare the fidelities"},
        std::pair{"rod", "Rod alone: tie the knot and follow the path"},
        std::pair{"solid", "Solid alone, seeded by a rod that is tied on the fly"}}) {
    CLI::App* sub = add_verb(app, verb, does);
    add_scene(sub, command);
    add_run_options(sub, command);
  }
  CLI::App* study = add_verb(app, "study", "Run a scene over a grid of keys: error against time");
  add_scene(study, command);
  add_run_options(study, command);
  study
      ->add_option("--grid", command.grid,
                   "Values of a key to be run through (repeatable: the product)")
      ->type_name("KEY=VALUE,VALUE")
      ->allow_extra_args(false)
      ->trigger_on_parse(false);
  study->add_option("--jobs", command.jobs, "Write the runs' commands, a line each; run nothing")
      ->type_name("FILE");
  study->add_option("--slurm", command.slurm, "Write a Slurm array script of them; run nothing")
      ->type_name("FILE");
  add_scene(add_verb(app, "check", "Read a scene, say what will be simulated; run nothing"),
            command);
  add_verb(app, "keys", "List every key of a scene: unit, range, default, meaning");
  CLI::App* compare = add_verb(
      app, "compare", "Lay force curves of results folders and measured CSV files on each other");
  compare
      ->add_option("SOURCE", command.sources,
                   "Results folders, or CSV files with columns ebar, force_normalised")
      ->required();
  compare->add_option("--out", command.out, "Folder for compare.csv; default: print only")
      ->type_name("DIR");
  CLI::App* report = add_verb(app, "report", "One self-contained HTML page for a result");
  report->add_option("DIR", command.results, "Results folder of a run or a study")->required();
  report->add_option("--out", command.out, "The page; default DIR/report.html")->type_name("FILE");
  report
      ->add_option("--measured", command.measured,
                   "CSV file with columns ebar, force_normalised to be laid over (repeatable)")
      ->type_name("FILE")
      ->allow_extra_args(false);
  report
      ->add_option("--script", command.script, "The page's program; default: as ./bight builds it")
      ->type_name("FILE");

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& answered) {
    app.exit(answered);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    throw InputError(std::string(error.what()) + "; see bight --help");
  }
  command.verb = app.get_subcommands().front()->get_name();
  return command;
}

}  // namespace bight::coupling
