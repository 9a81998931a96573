// `bight study` from outside: what it refuses, runs, reuses, collects and writes.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "call.h"
#include "small_scene.h"
#include "temporary_folder.h"

namespace fs = std::filesystem;

namespace {

// A few tenths of a second a run.
std::string quick_scene(const std::string& grid) {
  return "fidelities = [\"rod\"]\n" +
         small_scene_with("[30, 20]", "[30, 27]\nrecord = [30, 28, 27]") +
         "[rod1d]\nfollow_knot = false\n[study.grid]\n" + grid;
}

const std::string two_by_two = "rod1d.segments = [60, 120]\npath.max_step = [1, 0.5]\n";

nlohmann::json study_json(const TemporaryFolder& folder, const std::string& out) {
  return nlohmann::json::parse(text_of(folder / (out + "/study.json")));
}

}  // namespace

TEST_CASE("a study that cannot be run ends with 2 before anything runs") {
  const TemporaryFolder folder;
  folder.write("good.toml", quick_scene(two_by_two));
  folder.write("typo.toml", quick_scene("rod1d.segments = [60, 120]\nrod1d.segmets = [60]\n"));
  folder.write("none.toml", small_scene);
  const auto [words, what] = GENERATE(table<std::string, std::string>(
      {{"good.toml --grid rod1d.segmets=60,120", "nearest is rod1d.segments"},
       {"typo.toml", "typo.toml:14: study.grid.rod1d.segmets: unknown key"},
       {"none.toml", "[study.grid]"},
       {"good.toml --grid rod1d.segments=60,3", "rod1d.segments: 3 is not a whole number"},
       {"good.toml --grid rod.length=350mm,100mm", "rod.length=100mm"},
       {"good.toml --set study.extrapolate=rod1d.segments", "study.extrapolate"},
       {"good.toml --set study.grid=3", "a table such as"}}));
  const Outcome outcome = call(folder, "study " + words);
  CAPTURE(words, outcome.complained);
  CHECK(outcome.status == 2);
  CHECK(outcome.complained.find(what) != std::string::npos);
  CHECK(outcome.said.empty());
  CHECK_FALSE(fs::exists(folder / "results"));
}

TEST_CASE("a study runs its grid, measures it, and runs nothing twice") {
  const TemporaryFolder folder;
  folder.write("quick.toml", quick_scene(two_by_two));
  const Outcome first = call(folder, "study quick.toml --out s --threads 2");
  CAPTURE(first.said, first.complained);
  REQUIRE(first.status == 0);
  const std::string csv = text_of(folder / "s/study.csv");
  CHECK(lines(csv) == 5);
  CHECK(csv.starts_with("run,rod1d.segments,path.max_step,fidelity,status,reference"));
  CHECK(lines(text_of(folder / "s/study_states.csv")) == 1 + 4 * 3);
  CHECK(csv.find("\"rod1d.segments=60,path.max_step=0.5\",60,0.5,rod,finished,0") !=
        std::string::npos);
  const auto json = study_json(folder, "s");
  const auto& rod = json["cases"][0];
  CHECK(rod["reference"]["run"] == "rod1d.segments=120,path.max_step=0.5");
  CHECK(rod["sentences"].size() == 4);
  REQUIRE_FALSE(rod["pareto_front"].empty());
  // On equal segments the step matters by the contact stiffness that it leaves, at most; the
  // segments by 1.6 %.
  for (const auto& on_front : rod["pareto_front"]) {
    const double error = on_front["error_force_largest"];
    CHECK(error < 0.02);
    const bool fine = on_front["run"].get<std::string>().find("=120") != std::string::npos;
    CHECK((error < 1e-3) == fine);
  }

  const auto untouched =
      fs::last_write_time(folder / "s/runs/rod1d.segments=60,path.max_step=1/summary.json");
  CHECK(fs::exists(folder / "s/runs/rod1d.segments=60,path.max_step=1/rod/force.csv"));
  const Outcome again = call(folder, "study quick.toml --out s --grid rod1d.segments=60,120,80");
  CHECK(again.status == 0);
  CHECK(again.said.starts_with("6 runs, 4 of them done\n"));
  CHECK(fs::last_write_time(folder / "s/runs/rod1d.segments=60,path.max_step=1/summary.json") ==
        untouched);
  CHECK(lines(text_of(folder / "s/study.csv")) == 7);

  // Another scene in the same folders is neither taken for this one nor lost.
  CHECK(call(folder, "study quick.toml --out s --set rod.length=360mm").status == 2);
  CHECK(fs::last_write_time(folder / "s/runs/rod1d.segments=60,path.max_step=1/summary.json") ==
        untouched);
}

TEST_CASE("jobs run elsewhere are collected, and one that gave up is a row") {
  const TemporaryFolder folder;
  folder.write("quick.toml",
               quick_scene("rod1d.segments = [60, 80, 100]\npath.ebar = [[30, 27]]\n"));
  const Outcome listed = call(folder, "study quick.toml --jobs jobs.txt --slurm array.sh");
  REQUIRE(listed.status == 0);
  CHECK_FALSE(fs::exists(folder / "results"));
  CHECK(lines(text_of(folder / "jobs.txt")) == 3);
  CHECK(text_of(folder / "array.sh").find("--job-name='quick'\n#SBATCH --array=1-3\n") !=
        std::string::npos);
  const std::string in_folder = "cd '" + folder.path().string() + "' && ";
  REQUIRE(std::system((in_folder + "head -n 1 jobs.txt | sh").c_str()) == 0);
  REQUIRE(std::system((in_folder + "SLURM_ARRAY_TASK_ID=2 bash array.sh").c_str()) == 0);
  const std::string third = "results/quick/runs/rod1d.segments=100,path.ebar=_30__27_";
  CHECK(fs::exists(folder / "results/quick/runs"));

  CHECK(
      call(folder, "study quick.toml --jobs left.txt").said.starts_with("3 runs, 2 of them done"));
  CHECK(lines(text_of(folder / "left.txt")) == 1);
  REQUIRE(std::system((in_folder + "sh left.txt").c_str()) == 0);
  const Outcome none = call(folder, "study quick.toml --slurm none.sh");
  CHECK(none.status == 0);
  CHECK(none.said.find("nothing is left") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "none.sh"));  // Slurm refuses an array without tasks
  // As if the numerics had given up.
  std::string summary = text_of(folder / (third + "/summary.json"));
  for (size_t at = 0; (at = summary.find("\"finished\"", at)) != std::string::npos;)
    summary.replace(at, 10, "\"gave up\"");
  folder.write(third + "/summary.json", summary);
  const Outcome collected = call(folder, "study quick.toml");
  CHECK(collected.status == 0);
  CHECK(collected.said.starts_with("3 runs, 3 of them done\n"));
  const std::string csv = text_of(folder / "results/quick/study.csv");
  CHECK(csv.find(",rod,gave up,0,0,") != std::string::npos);
  CHECK(study_json(folder, "results/quick")["cases"][0]["reference"]["run"] ==
        "rod1d.segments=80,path.ebar=_30__27_");

  // A study leaves room for a run of the scene itself.
  CHECK(call(folder, "run quick.toml --set rod1d.segments=60 --quiet").status == 0);
}

TEST_CASE("an interrupted study stops its runs and goes on when called again") {
  const TemporaryFolder folder;
  const std::string scene = folder.write("slow.toml", quick_scene("path.max_step = [0.001, 1]\n"));
  const std::string out = folder / "s", slow = out + "/runs/path.max_step=0.001";
  const pid_t child = fork();
  if (child == 0) {
    execl(BIGHT_PROGRAM, "bight", "study", scene.c_str(), "--out", out.c_str(), "--threads", "1",
          "--quiet", nullptr);
    _exit(127);
  }
  while (text_of(slow + "/rod/force.csv").find("\n30,") == std::string::npos &&
         waitpid(child, nullptr, WNOHANG) == 0)
    usleep(10000);
  kill(child, SIGTERM);
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
  CHECK(text_of(slow + "/summary.json").find("\"interrupted\"") != std::string::npos);
  CHECK_FALSE(fs::exists(out + "/runs/path.max_step=1"));
  const Outcome again =
      call(folder, "study slow.toml --out s --grid path.max_step=0.001,1 --jobs left.txt");
  CHECK(again.said.starts_with("2 runs, 0 of them done"));
}
