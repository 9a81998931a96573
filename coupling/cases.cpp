#include "coupling/cases.h"

#include <fmt/format.h>

#include <algorithm>

#include "coupling/compare.h"
#include "coupling/errors.h"
#include "coupling/read_curves.h"

namespace bight::coupling {
namespace {

struct Named {
  std::string name;
  std::vector<std::string> settings;
};

std::vector<Named> split(const std::vector<std::string>& lines) {
  std::vector<Named> cases;
  for (const std::string& line : lines) {
    const size_t colon = line.find(": ");
    const std::string name = line.substr(0, colon), setting = line.substr(colon + 2);
    if (cases.empty() || cases.back().name != name) cases.push_back({name, {}});
    if (!setting.empty()) cases.back().settings.push_back(setting);
  }
  return cases;
}

}  // namespace

std::vector<SceneCase> read_cases(const std::filesystem::path& file,
                                  const std::vector<std::string>& settings,
                                  const std::vector<std::string>& fidelities,
                                  const std::string& only) {
  Scene base = read_scene(file, settings, fidelities);
  const std::vector<Named> named = split(base.cases);
  if (named.empty() && !only.empty())
    throw InputError(fmt::format("--case {}: {} has no cases", only, file.string()));
  if (named.empty()) return {{"", std::move(base)}};
  std::vector<SceneCase> cases;
  std::string names;
  for (const Named& one : named) {
    names += (names.empty() ? "" : ", ") + one.name;
    if (!only.empty() && one.name != only) continue;
    std::vector<std::string> all = one.settings;
    all.insert(all.end(), settings.begin(), settings.end());
    try {
      cases.push_back({one.name, read_scene(file, all, fidelities)});
    } catch (const InputError& error) {
      throw InputError(fmt::format("case {}: {}", one.name, error.what()));
    }
  }
  if (cases.empty())
    throw InputError(fmt::format("--case {}: the cases of {} are {}", only, file.string(), names));
  return cases;
}

ExitStatus run_cases(const std::vector<SceneCase>& cases, const RunOptions& options) {
  if (cases.size() == 1 && cases[0].name.empty()) return run(cases[0].scene, options);
  ExitStatus worst = done;
  std::vector<ForceCurve> curves;
  for (const SceneCase& c : cases) {
    RunOptions own = options;
    own.folder = options.folder / c.name;
    if (!options.quiet) fmt::print("case {}\n", c.name);
    const ExitStatus status = run(c.scene, own);
    if (status == stopped) return stopped;
    worst = std::max(worst, status);
    try {
      for (ForceCurve& curve : read_curves(own.folder)) curves.push_back(std::move(curve));
    } catch (const InputError&) {  // not one step was accepted: its own run has said why
    }
  }
  if (curves.empty()) return worst;
  const Comparison comparison = compare(curves, cases[0].scene.friction);
  write_comparison(options.folder / "compare.csv", comparison);
  if (!options.quiet) fmt::print("{}", comparison_text(comparison));
  return worst;
}

}  // namespace bight::coupling
