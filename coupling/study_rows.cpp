#include "coupling/study_rows.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "coupling/files.h"

namespace bight::coupling {
namespace {

using Json = nlohmann::json;

Json read_summary(const std::filesystem::path& folder) {
  if (!std::filesystem::is_regular_file(folder / "summary.json")) return {};
  Json summary = Json::parse(read_whole(folder / "summary.json"), nullptr, false);
  return summary.is_object() ? summary : Json();
}

RecordedStates recorded(const Json& fidelity) {
  RecordedStates states;
  for (const Json& state : fidelity.value("states", Json::array())) {
    double energy = 0;
    for (const Json& effect : state["energy_J"]) energy += effect.get<double>();
    const double ebar = std::round(1e6 * state["ebar"].get<double>()) / 1e6;
    int time = 1;
    while (states.contains({ebar, time})) ++time;
    states[{ebar, time}] = {ebar, state["force_normalised"].get<double>(), energy};
  }
  return states;
}

void add_cost(const Json& phases, const std::string& fidelity, StudyRow& row) {
  for (const char* phase : {"tie", "rod", "seed", "tighten"}) {
    const bool of_solid = phase == std::string("seed") || phase == std::string("tighten");
    if (!phases.contains(phase) || (of_solid && fidelity == "rod")) continue;
    row.wall_s += phases[phase].value("wall_s", 0.0);
    row.cpu_s += phases[phase].value("cpu_s", 0.0);
    row.peak_MB = std::max(row.peak_MB, phases[phase].value("peak_MB", 0.0));
  }
}

double relative(double value, double reference) {
  return std::abs(value - reference) / std::max(std::abs(reference), 1e-300);
}

}  // namespace

std::string run_status(const std::filesystem::path& folder) {
  const Json summary = read_summary(folder);
  return summary.is_object() ? summary.value("status", "") : "";
}

std::vector<StudyRow> read_rows(const std::filesystem::path& folder, size_t point,
                                const Scene& scene, const std::string& trouble) {
  const Json summary = read_summary(folder);
  std::vector<StudyRow> rows;
  for (const std::string fidelity : {"rod", "solid"}) {
    if (!(fidelity == "rod" ? scene.rod : scene.solid)) continue;
    StudyRow row{point, fidelity, "failed", trouble, folder / fidelity, {}};
    if (summary.is_object() && summary.contains(fidelity)) {
      const Json& of = summary[fidelity];
      row.status = of.value("status", "");
      row.reason = of.value("reason", "");
      row.states = recorded(of);
      row.unknowns = of.value("unknowns", 0);
      row.steps = of.value("steps", 0);
      row.iterations = of.value("newton_iterations", 0);
      add_cost(summary.value("phases", Json::object()), fidelity, row);
    } else if (summary.is_object()) {
      row.status = summary.value("status", "");
      row.reason = summary.value("verdict", "");
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::optional<double> force_difference(const RecordedStates::value_type& state,
                                       const RecordedStates& reference) {
  const auto twin = reference.find(state.first);
  if (twin == reference.end() || twin->second.force == 0) return std::nullopt;
  return state.second.force / twin->second.force - 1;
}

std::optional<ResultError> error_against(const RecordedStates& states,
                                         const RecordedStates& reference) {
  ResultError error{};
  for (const auto& [when, state] : states) {
    const auto twin = reference.find(when);
    if (twin == reference.end()) continue;
    const double force = relative(state.force, twin->second.force);
    const double energy = relative(state.energy, twin->second.energy);
    error.force_largest = std::max(error.force_largest, force);
    error.energy_largest = std::max(error.energy_largest, energy);
    error.force_mean += force;
    error.energy_mean += energy;
    ++error.states;
  }
  if (error.states == 0) return std::nullopt;
  error.force_mean /= static_cast<double>(error.states);
  error.energy_mean /= static_cast<double>(error.states);
  return error;
}

}  // namespace bight::coupling
