#include "coupling/results_folder.h"

#include <catch2/catch.hpp>

#include "coupling/errors.h"
#include "temporary_folder.h"

using namespace bight::coupling;

namespace {

const std::string finished = R"({"status": "finished"})";

}  // namespace

TEST_CASE("an absent or empty folder is fresh") {
  const TemporaryFolder folder;
  CHECK(take_folder(folder.path(), {}, false, false) == FolderState::fresh);
  CHECK(take_folder(folder / "absent", {}, true, false) == FolderState::fresh);
  folder.write("file", "");
  CHECK_THROWS_WITH(take_folder(folder / "file", {}, false, true), Catch::Contains("not a folder"));
}

TEST_CASE("the finished result of the very same scene is found again") {
  const TemporaryFolder folder;
  Scene scene;
  scene.text = "same";
  folder.write("scene.toml", "same");
  CHECK_THROWS_AS(take_folder(folder.path(), scene, false, false), InputError);
  folder.write("summary.json", R"({"status": "gave up"})");
  CHECK_THROWS_AS(take_folder(folder.path(), scene, false, false), InputError);
  folder.write("summary.json", finished);
  CHECK(take_folder(folder.path(), scene, false, false) == FolderState::finished);
  CHECK(take_folder(folder.path(), scene, true, false) == FolderState::finished);
  scene.text = "other";
  CHECK_THROWS_AS(take_folder(folder.path(), scene, false, false), InputError);
}

TEST_CASE("resuming where no run of the scene has begun is refused") {
  const TemporaryFolder folder;
  folder.write("run.log", "");
  CHECK_THROWS_WITH(take_folder(folder.path(), {}, true, false), Catch::Contains("no run of this"));
}

TEST_CASE("starting over clears what bight writes and leaves the rest") {
  const TemporaryFolder folder;
  folder.write("notes.txt", "");
  const auto of_a_run = {"scene.toml",      "summary.json",         "run.log",
                         "compare.csv",     "curvature.csv",        "rod/force.csv",
                         "rod/rod.pvd",     "rod/tie.pvd",          "rod/tie/a.vtu",
                         "rod/vtu/a.vtu",   "rod/centerline/a.csv", "solid/force.csv",
                         "solid/solid.pvd", "solid/vtu/a.vtu",      "solid/centerline/a.csv"};
  for (const std::filesystem::path name : of_a_run) {
    std::filesystem::create_directories(folder.path() / name.parent_path());
    folder.write(name.string(), "");
  }
  CHECK(take_folder(folder.path(), {}, false, true) == FolderState::fresh);
  CHECK(std::filesystem::exists(folder / "notes.txt"));
  for (const char* name : of_a_run) CHECK_FALSE(std::filesystem::exists(folder / name));
}
