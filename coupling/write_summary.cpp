#include "coupling/write_summary.h"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "coupling/compare_centerlines.h"
#include "coupling/files.h"
#include "coupling/validity.h"

namespace bight::coupling {
namespace {

using Json = nlohmann::ordered_json;

std::string percent(double level) { return fmt::format("{:.0f} %", 100 * level); }

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

Json machine(int threads) {
  utsname system{};
  uname(&system);
  return {{"processor", processor()},
          {"cores", sysconf(_SC_NPROCESSORS_ONLN)},
          {"memory_MB", sysconf(_SC_PHYS_PAGES) / 1024 * (sysconf(_SC_PAGESIZE) / 1024)},
          {"system", fmt::format("{} {}", system.sysname, system.release)},
          {"threads", threads}};
}

Json versions() {
  Json result = {{"bight", BIGHT_VERSION}, {"compiler", __VERSION__}};
  std::istringstream libraries(BIGHT_LIBRARIES);  // "Eigen 3.4.0,CHOLMOD ..."
  for (std::string library; std::getline(libraries, library, ',');)
    result[library.substr(0, library.find(' '))] = library.substr(library.find(' ') + 1);
  return result;
}

Json path_numbers(const PathOutcome& outcome, const std::vector<StepRow>& steps) {
  Json result = {{"status", outcome.status == PathStatus::finished  ? "finished"
                            : outcome.status == PathStatus::gave_up ? "gave up"
                                                                    : "interrupted"},
                 {"reason", outcome.reason},
                 {"steps", outcome.steps},
                 {"newton_iterations", outcome.iterations},
                 {"factorisations", outcome.factorisations},
                 {"cutbacks", outcome.cutbacks}};
  if (steps.empty()) return result;
  const auto worst = [&](auto of) { return std::ranges::max(steps, {}, of); };
  result["wall_s"] = steps.back().wall_s;
  result["last_ebar"] = steps.back().ebar;
  result["worst_penetration"] = worst(&StepRow::max_penetration).max_penetration;
  result["worst_reaction_mismatch"] = worst(&StepRow::reaction_mismatch).reaction_mismatch;
  result["most_contact_pairs"] = worst(&StepRow::contact_pairs).contact_pairs;
  result["end_turn"] = steps.back().end_turn;
  result["snaps_at_ebar"] = Json::array();
  for (const StepRow& row : steps)
    if (row.snapped > 0) result["snaps_at_ebar"].push_back(row.ebar);
  return result;
}

Json energies(const std::map<std::string, double>& by_effect, double scale) {
  Json result = Json::object();
  for (const auto& [effect, energy] : by_effect) result[effect] = energy * scale;
  return result;
}

Json costs(const std::vector<EffectCost>& by_effect) {
  Json result = Json::object();
  for (const EffectCost& cost : by_effect)
    result[cost.name] = {{"seconds", cost.seconds},
                         {"stencils", cost.stencils},
                         {"unknowns", cost.unknowns},
                         {"matrix_MB", 1e-6 * 12 * static_cast<double>(cost.entries)}};
  return result;
}

Json rod_numbers(const rod1d::RodResult& rod, const Scene& scene) {
  Json result = {
      {"segments", scene.segments}, {"unknowns", rod.unknowns}, {"effects", rod.effects}};
  result.update(path_numbers(rod.outcome, rod.steps));
  result["seconds"] = rod.seconds;
  result["cost_by_effect"] = costs(rod.costs);
  for (const rod1d::RodState& state : rod.states) {
    const double bending = 0.5 * std::ranges::max(state.curvature);
    const double stretch = std::ranges::max(state.stretch) - 1;
    result["states"].push_back(
        {{"ebar", state.ebar},
         {"force_normalised", normalised_force(state.tension)},
         {"determinant", state.determinant},
         {"writhe", state.writhe},
         {"largest_bending_strain", bending},
         {"largest_stretch_strain", stretch},
         {"energy_J", energies(state.energy_by_effect, scene.scales().energy())}});
  }
  const std::vector<RodError> errors = rod_errors(rod.steps);
  result["validity"]["sentence"] = validity_sentence(errors, verdict_level);
  for (const double level : parting_levels) {
    Json& down_to = result["validity"]["down_to_ebar"][percent(level)];
    if (const auto valid = valid_down_to(errors, level))
      down_to = {{"ebar", valid->ebar},
                 {"range", {valid->earliest, valid->latest}},
                 {"reached", valid->reached}};
  }
  return result;
}

Json solid_numbers(const solid3d::SolidResult& solid, const Scene& scene,
                   const Recorder& recorder) {
  Json result = {{"cells", solid.cells},
                 {"unknowns", solid.unknowns},
                 {"one_half", solid.symmetric},
                 {"effects", solid.effects}};
  result.update(path_numbers(solid.outcome, solid.steps));
  if (!solid.steps.empty())
    result["smallest_jacobian"] =
        std::ranges::min(solid.steps, {}, &StepRow::min_jacobian).min_jacobian;
  result["seconds"] = solid.seconds;
  result["cost_by_effect"] = costs(solid.costs);
  for (const solid3d::SolidState& state : recorder.solid_states)
    result["states"].push_back(
        {{"ebar", state.ebar},
         {"force_normalised", normalised_force(state.tension)},
         {"determinant", state.determinant},
         {"skin_crossings", state.skin_crossings},
         {"largest_curvature", std::ranges::max(state.curvature)},
         {"largest_flattening", std::ranges::max(state.flattening)},
         {"smallest_jacobian", state.min_jacobian},
         {"energy_J", energies(state.energy_by_effect, scene.scales().energy())}});
  return result;
}

Json confirmed_numbers(const Confirmation& of, const Scene& scene) {
  Json result = {{"ebar", of.ebar},
                 {"section_elements", scene.confirm_elements},
                 {"cells", of.result.cells},
                 {"unknowns", of.result.unknowns}};
  result.update(path_numbers(of.result.outcome, of.result.steps));
  if (!of.finished()) return result;
  result["force_normalised"] = normalised_force(of.result.steps.back().tension);
  result["error_of_path"] = of.path_error();
  return result;
}

Json comparison_numbers(const Comparison& comparison, const Recorder& recorder) {
  Json result;
  for (const double level : parting_levels) {
    const auto parted = parted_at(comparison, 1, level);
    result["parted_from_ebar"][percent(level)] = parted ? Json(*parted) : Json();
  }
  const auto curvature =
      compare_centerlines(recorder.folder() / "rod", recorder.folder() / "solid");
  write_curvature(recorder.folder() / "curvature.csv", curvature);
  for (const CurvatureDifference& d : curvature)
    result["curvature"].push_back({{"ebar", d.ebar},
                                   {"mean_difference", d.mean},
                                   {"largest_kappa_rod", d.largest_a},
                                   {"largest_kappa_solid", d.largest_b}});
  return result;
}

}  // namespace

bool RunReport::interrupted() const {
  return rod.outcome.status == PathStatus::interrupted ||
         (solid && solid->outcome.status == PathStatus::interrupted) ||
         std::ranges::any_of(confirmed, [](const Confirmation& of) {
           return of.result.outcome.status == PathStatus::interrupted;
         });
}

bool RunReport::finished() const {
  return rod.outcome.status == PathStatus::finished &&
         (!scene.solid || (solid && solid->outcome.status == PathStatus::finished)) &&
         std::ranges::all_of(confirmed, &Confirmation::finished);
}

std::string RunReport::status() const {
  return interrupted() ? "interrupted" : finished() ? "finished" : "gave up";
}

std::string RunReport::verdict() const {
  std::string text = status();
  if (rod.outcome.status != PathStatus::finished) text += "; rod: " + rod.outcome.reason;
  if (scene.solid && !solid) text += "; the rod did not reach the solid's seed";
  if (solid && solid->outcome.status != PathStatus::finished)
    text += "; solid: " + solid->outcome.reason;
  for (const Confirmation& of : confirmed)
    if (!of.finished()) text += "; " + confirmation_text(scene, of);
  return text;
}

void write_summary(const RunReport& report, Recorder& recorder) {
  recorder.phases.enter("write");
  const Scene& scene = report.scene;
  Json summary = {{"status", report.status()},  {"verdict", report.verdict()},
                  {"scene", scene.name},        {"title", scene.title},
                  {"friction", scene.friction}, {"warnings", scene.warnings},
                  {"versions", versions()},     {"machine", machine(report.threads)}};
  if (scene.rod) summary["rod"] = rod_numbers(report.rod, scene);
  if (report.solid) summary["solid"] = solid_numbers(*report.solid, scene, recorder);
  for (const Confirmation& of : report.confirmed)
    summary["confirmed"].push_back(confirmed_numbers(of, scene));
  if (report.comparison.names.size() > 1)
    summary["comparison"] = comparison_numbers(report.comparison, recorder);
  recorder.phases.enter("done");
  for (const Phases::Phase& phase : recorder.phases.list())
    if (phase.name != "done")
      summary["phases"][phase.name] = {
          {"wall_s", phase.wall_s}, {"cpu_s", phase.cpu_s}, {"peak_MB", phase.peak_MB}};
  write_whole(recorder.folder() / "summary.json", summary.dump(2) + "\n");
}

}  // namespace bight::coupling
