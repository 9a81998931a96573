// The built program from outside: exit status, messages, what is written and what is not.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "call.h"
#include "coupling/read_table.h"
#include "small_scene.h"
#include "temporary_folder.h"

namespace {

// A scene that a rod of few segments finishes in a blink.
std::string quick_scene() {
  return "fidelities = [\"rod\"]\n" + small_scene_with("[30, 20]", "[30, 28]") +
         "[rod1d]\nsegments = 120\n";
}

}  // namespace

TEST_CASE("bad input ends with 2, one message, and nothing written") {
  const TemporaryFolder folder;
  folder.write("typo.toml", small_scene_with("diameter", "diamter"));
  folder.write("unit.toml", small_scene_with("8.3 mm", "8.3 kg"));
  folder.write("negative.toml", small_scene_with("8.3 mm", "-8.3 mm"));
  folder.write("poisson.toml", small_scene_with("[path]", "poissons_ratio = 2\n[path]"));
  folder.write("loose.toml", small_scene_with("[30, 20]", "[50, 20]"));
  folder.write("nan.toml", small_scene_with("\"8.3 mm\"", "nan"));
  folder.write("long.toml", small_scene_with("\"350 mm\"", "1e300"));
  folder.write("empty.toml", "");
  folder.write("binary.toml", std::string("\x7f"
                                          "ELF\0\1\2\xff",
                                          8));
  folder.write("good.toml", quick_scene());
  const std::string words = GENERATE(
      "run typo.toml", "rod unit.toml", "solid negative.toml", "run poisson.toml", "run loose.toml",
      "run nan.toml", "run long.toml", "run empty.toml", "run binary.toml", "run missing.toml",
      "run .", "check typo.toml", "run good.toml --set rod.diameter=-1",
      "run good.toml --threads 0", "run good.toml --threads two", "run",
      "run good.toml --unheard-of", "tie good.toml", "", "compare missing.csv", "study good.toml",
      "report somewhere", "run good.toml --set");
  const Outcome outcome = call(folder, words);
  CAPTURE(words, outcome.complained);
  CHECK(outcome.status == 2);
  CHECK(outcome.said.empty());
  CHECK(lines(outcome.complained) == 1);
  CHECK_FALSE(std::filesystem::exists(folder / "results"));
}

TEST_CASE("help, version, keys and check answer with 0 and write nothing") {
  const TemporaryFolder folder;
  folder.write("good.toml", quick_scene());
  const std::string words =
      GENERATE("--help", "--version", "run --help", "compare --version", "keys", "check good.toml");
  const Outcome outcome = call(folder, words);
  CAPTURE(words);
  CHECK(outcome.status == 0);
  CHECK_FALSE(outcome.said.empty());
  CHECK(outcome.complained.empty());
  CHECK_FALSE(std::filesystem::exists(folder / "results"));
}

TEST_CASE("a rod runs, is found again, and is only replaced when told so") {
  const TemporaryFolder folder;
  folder.write("quick.toml", quick_scene());
  const Outcome first = call(folder, "run quick.toml");
  CAPTURE(first.said, first.complained);
  REQUIRE(first.status == 0);
  for (const char* file : {"scene.toml", "summary.json", "run.log", "compare.csv", "rod/force.csv",
                           "rod/rod.pvd", "rod/centerline/ebar_+030.000.csv",
                           "rod/centerline/ebar_+028.000.csv", "rod/vtu/ebar_+028.000.vtu"})
    CHECK(std::filesystem::exists(folder / "results/quick" / file));
  CHECK_FALSE(std::filesystem::exists(folder / "results/quick/solid"));
  const auto force = text_of(folder / "results/quick/rod/force.csv");
  CHECK(lines(first.said) > lines(force) - 1);  // a status line per step off a terminal

  const Outcome again = call(folder, "run quick.toml");
  CHECK(again.status == 0);
  CHECK(again.said.find("finished result") != std::string::npos);
  CHECK(text_of(folder / "results/quick/rod/force.csv") == force);

  CHECK(call(folder, "run quick.toml --set path.max_step=1").status == 2);
  CHECK(call(folder, "run quick.toml --set path.max_step=1 --resume").status == 2);
  const Outcome forced = call(folder, "run quick.toml --set path.max_step=1 --force --quiet");
  CHECK(forced.status == 0);
  CHECK(forced.said.empty());
  CHECK(lines(text_of(folder / "results/quick/rod/force.csv")) < lines(force));

  const Outcome compared =
      call(folder, "compare results/quick results/quick/rod/force.csv --out c");
  CHECK(compared.status == 0);
  CHECK(std::filesystem::exists(folder / "c/compare.csv"));
}

TEST_CASE("a folder that cannot be made ends with 3") {
  const TemporaryFolder folder;
  folder.write("quick.toml", quick_scene());
  const Outcome outcome = call(folder, "run quick.toml --out /proc/bight");
  CHECK(outcome.status == 3);
  CHECK(lines(outcome.complained) == 1);
}

TEST_CASE("an interrupted run ends with 130 and leaves whole files") {
  const TemporaryFolder folder;
  const std::string scene =
      folder.write("slow.toml", "fidelities = [\"rod\"]\n" + small_scene + "max_step = 0.002\n");
  const std::string out = folder / "out";
  const pid_t child = fork();
  if (child == 0) {
    execl(BIGHT_PROGRAM, "bight", "run", scene.c_str(), "--out", out.c_str(), "--quiet", nullptr);
    _exit(127);
  }
  while (text_of(out + "/rod/force.csv").find("\n30,") == std::string::npos &&
         waitpid(child, nullptr, WNOHANG) == 0)
    usleep(10000);
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
  const auto table = bight::coupling::read_table(out + "/rod/force.csv");
  CHECK(table.rows.size() < 1000);
  CHECK(text_of(out + "/summary.json").find("\"interrupted\"") != std::string::npos);
}

TEST_CASE("a killed run goes on from its checkpoint to the same curve") {
  const TemporaryFolder folder;
  const std::string scene = folder.write(
      "knot.toml",
      small_scene_with("[30, 20]", "[20, 19]") +
          "[effects]\nfriction = 0.2\n[solid3d]\nsection_elements = 12\naxial_ratio = 1.5\n");
  REQUIRE(call(folder, "solid knot.toml --out whole --quiet").status == 0);
  const std::string out = folder / "cut";
  const pid_t child = fork();
  if (child == 0) {
    execl(BIGHT_PROGRAM, "bight", "solid", scene.c_str(), "--out", out.c_str(), "--quiet", nullptr);
    _exit(127);
  }
  while (!std::filesystem::exists(out + "/checkpoint/solid_000002.h5") &&
         waitpid(child, nullptr, WNOHANG) == 0)
    usleep(10000);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  REQUIRE_FALSE(std::filesystem::exists(out + "/summary.json"));
  CHECK(call(folder, "solid knot.toml --out cut --quiet").status == 2);
  REQUIRE(call(folder, "solid knot.toml --out cut --quiet --resume").status == 0);
  CHECK(text_of(out + "/run.log").find("resumed at ebar") != std::string::npos);
  const auto whole = bight::coupling::read_table(folder / "whole/solid/force.csv");
  const auto cut = bight::coupling::read_table(folder / "cut/solid/force.csv");
  REQUIRE(cut.rows.size() == whole.rows.size());
  REQUIRE(cut.names == whole.names);
  for (size_t i = 0; i < cut.rows.size(); ++i)
    for (size_t k = 0; k < cut.names.size(); ++k)
      if (cut.names[k] != "wall_s") {
        INFO(cut.names[k] << " in row " << i);
        CHECK(cut.rows[i][k] == whole.rows[i][k]);
      }
  CHECK(text_of(folder / "cut/solid/solid.pvd") == text_of(folder / "whole/solid/solid.pvd"));
}

TEST_CASE("a state is confirmed on a finer section, also by a resumed run") {
  const TemporaryFolder folder;
  folder.write("knot.toml",
               small_scene_with("[30, 20]", "[20, 19]\nmax_step = 0.25") +
                   "[solid3d]\nsection_elements = 12\naxial_ratio = 1.2\nconfirm_at = [20]\n"
                   "confirm_elements = 21\n");
  const Outcome whole = call(folder, "solid knot.toml --out whole");
  REQUIRE(whole.status == 0);
  CHECK(whole.said.find("confirmed at ebar 20 with 21 cells a section") != std::string::npos);
  const auto summary = [&](const char* out) {
    return nlohmann::json::parse(text_of(folder / (std::string(out) + "/summary.json")));
  };
  const auto confirmed = summary("whole")["confirmed"];
  REQUIRE(confirmed.size() == 1);
  CHECK(confirmed[0]["cells"] > summary("whole")["solid"]["cells"]);
  const double error = confirmed[0]["error_of_path"];
  CHECK(std::abs(error) > 1e-3);
  CHECK(std::abs(error) < 0.03);
  const auto table = bight::coupling::read_table(folder / "whole/confirm/force.csv");
  REQUIRE(table.rows.size() == 1);
  CHECK(std::filesystem::exists(folder / "whole/confirm/centerline/ebar_+020.000.csv"));

  // As if it had been killed: what is to be confirmed was recorded before the last checkpoint.
  std::filesystem::remove(folder / "whole/summary.json");
  std::filesystem::remove_all(folder / "whole/confirm");
  REQUIRE(call(folder, "solid knot.toml --out whole --resume --quiet").status == 0);
  CHECK(text_of(folder / "whole/run.log").find("resumed at ebar") != std::string::npos);
  const auto again = bight::coupling::read_table(folder / "whole/confirm/force.csv");
  CHECK(again.rows[0][1] == table.rows[0][1]);
}
