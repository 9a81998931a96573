#include "coupling/results_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "coupling/checkpoint.h"
#include "coupling/errors.h"
#include "coupling/files.h"

namespace bight::coupling {
namespace {

namespace fs = std::filesystem;

bool same_scene(const fs::path& folder, const Scene& scene) {
  return fs::is_regular_file(folder / "scene.toml") &&
         read_whole(folder / "scene.toml") == scene.text;
}

bool finished(const fs::path& folder) {
  if (!fs::is_regular_file(folder / "summary.json")) return false;
  const auto summary = nlohmann::json::parse(read_whole(folder / "summary.json"), nullptr, false);
  return summary.is_object() && summary.value("status", "") == "finished";
}

// A study of the same scene may lie in the folder.
bool nothing_of_a_run(const fs::path& folder) {
  return std::ranges::all_of(fs::directory_iterator(folder), [](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename();
    return name == "runs" || name == "study.csv" || name == "study_states.csv" ||
           name == "study.json" || name == "report.html";
  });
}

// Only what a run writes; a user's own notes stay.
void clear(const fs::path& folder) {
  for (const char* name :
       {"scene.toml", "summary.json", "compare.csv", "curvature.csv", "report.html", "run.log"})
    fs::remove(folder / name);
  remove_checkpoints(folder);
  for (const char* fidelity : {"rod", "solid", "confirm"}) {
    fs::remove(folder / fidelity / "force.csv");
    fs::remove(folder / fidelity / (std::string(fidelity) + ".pvd"));
    fs::remove(folder / fidelity / "tie.pvd");
    fs::remove(folder / fidelity / "validity.csv");
    for (const char* kind : {"centerline", "vtu", "contacts", "tie"})
      fs::remove_all(folder / fidelity / kind);
  }
}

}  // namespace

FolderState take_folder(const fs::path& folder, const Scene& scene, bool resume, bool force) {
  if (!fs::exists(folder)) return FolderState::fresh;
  if (!fs::is_directory(folder)) throw InputError(folder.string() + ": not a folder");
  if (nothing_of_a_run(folder)) return FolderState::fresh;
  if (force) {
    clear(folder);
    return FolderState::fresh;
  }
  if (same_scene(folder, scene) && finished(folder)) return FolderState::finished;
  if (resume && same_scene(folder, scene)) return FolderState::begun;
  if (resume)
    throw InputError(
        fmt::format("{}: no run of this very scene to go on with; --force starts over, --out names "
                    "another folder",
                    folder.string()));
  throw InputError(
      fmt::format("{}: the folder is not empty and holds no finished result of this "
                  "scene; --resume goes on, --force starts over, --out names another folder",
                  folder.string()));
}

}  // namespace bight::coupling
