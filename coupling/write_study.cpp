#include "coupling/write_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <set>

#include "coupling/convergence.h"
#include "coupling/files.h"

namespace bight::coupling {
namespace {

using Json = nlohmann::ordered_json;

constexpr double levels[] = {0.05, 0.01, 0.003};

std::string choice(const Study& plan, const StudyRow& row) {
  return fmt::format(
      "{}", fmt::join(resolution_settings(plan.grid, plan.points[row.point], row.fidelity), " "));
}

std::string title(const StudyCase& of) {
  return fmt::format("{}{}{}", of.fidelity, of.problem.empty() ? "" : ", ",
                     fmt::join(of.problem, ", "));
}

// RFC 4180.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{:.9g}", *value) : "";
}

std::string order_text(const std::optional<double>& order) {
  return order ? fmt::format("{:.1f}", *order) : "none";
}

Json order_or_null(const std::optional<double>& order) { return order ? Json(*order) : Json(); }

// What both tables begin with: the run and its values of the grid.
std::string grid_names(const Study& plan) {
  std::string text = "run";
  for (const Dimension& dimension : plan.grid) text += fmt::format(",{}", dimension.key->path);
  return text;
}

std::string grid_cells(const Study& plan, const StudyRow& row) {
  const GridPoint& point = plan.points[row.point];
  std::string text = cell(point.name);
  for (size_t d = 0; d < plan.grid.size(); ++d)
    text += ',' + cell(plan.grid[d].values[point.at[d]]);
  return text;
}

}  // namespace

std::vector<std::string> sentences(const Study& plan, const std::vector<StudyRow>& rows,
                                   const StudyCase& of) {
  if (!of.reference) return {title(of) + ": no run finished"};
  const StudyRow& finest = rows[*of.reference];
  const double uncertainty = of.uncertainty();
  std::vector<std::string> result = {
      fmt::format("{}: reference {}{}, {:.3g} s, T uncertain by {:.2g} %", title(of),
                  of.extrapolated ? "extrapolated from " : "", choice(plan, finest),
                  finest.seconds(), 100 * uncertainty)};
  std::set<const Key*> met;
  for (const KeyOrder& order : of.orders)
    if (met.insert(order.key).second)
      result.push_back(fmt::format("  order in {} {}: largest difference in T {}, mean {}",
                                   order.key->path, fmt::join(order.values, ", "),
                                   order_text(order.force_largest), order_text(order.force_mean)));
  std::vector<Tradeoff> front;
  for (const size_t row : of.front)
    front.push_back({rows[row].seconds(), rows[row].error->force_largest});
  for (const double level : levels) {
    const auto best = cheapest(front, level);
    const std::string percent = fmt::format("  {:g} % in T", 100 * level);
    if (level <= uncertainty)
      result.push_back(percent + " cannot be told: the reference is not that certain");
    else if (!best)
      result.push_back(percent + ": no run of the study but the reference");
    else
      result.push_back(fmt::format("{} costs {:.3g} s with {}", percent, front[*best].seconds,
                                   choice(plan, rows[of.front[*best]])));
  }
  if (!of.from_solid.empty()) {
    std::vector<std::string> parts;
    for (const StudyCase::Gap& gap : of.from_solid)
      parts.push_back(fmt::format("{:+.2g} % at {:g}", 100 * gap.force, gap.ebar));
    result.push_back(fmt::format("  its T against that of the solid: {}", fmt::join(parts, ", ")));
  }
  return result;
}

void write_study_csv(const std::filesystem::path& file, const Study& plan,
                     const std::vector<StudyRow>& rows) {
  std::string text = grid_names(plan);
  text +=
      ",fidelity,status,reference,on_front,states,error_force_largest,error_force_mean,"
      "error_energy_largest,error_energy_mean,error_kappa_mean,wall_s,cpu_s,unknowns,peak_MB,"
      "steps,newton_iterations,reason\n";
  for (const StudyRow& row : rows) {
    text += grid_cells(plan, row);
    const auto error = [&](double ResultError::*of) {
      return row.error ? cell(std::optional((*row.error).*of)) : "";
    };
    text += fmt::format(",{},{},{:d},{:d},{},{},{},{},{},{}", row.fidelity, row.status,
                        row.reference, row.on_front, row.states.size(),
                        error(&ResultError::force_largest), error(&ResultError::force_mean),
                        error(&ResultError::energy_largest), error(&ResultError::energy_mean),
                        row.error ? cell(row.error->curvature_mean) : "");
    text += fmt::format(",{:.9g},{:.9g},{},{:.9g},{},{},{}\n", row.wall_s, row.cpu_s, row.unknowns,
                        row.peak_MB, row.steps, row.iterations, cell(row.reason));
  }
  write_whole(file, text);
}

void write_states_csv(const std::filesystem::path& file, const Study& plan,
                      const std::vector<StudyRow>& rows, const std::vector<StudyCase>& cases) {
  std::string text = grid_names(plan);
  text += ",fidelity,ebar,time,force_normalised,energy_J,error_force,error_force_solid\n";
  for (const StudyCase& of : cases) {
    const auto solid = std::ranges::find_if(cases, [&](const StudyCase& other) {
      return other.fidelity == "solid" && other.problem == of.problem;
    });
    for (const size_t row : of.rows)
      for (const auto& state : rows[row].states)
        text +=
            grid_cells(plan, rows[row]) +
            fmt::format(
                ",{},{:.9g},{},{:.9g},{:.9g},{},{}\n", of.fidelity, state.first.first,
                state.first.second, state.second.force, state.second.energy,
                cell(force_difference(state, of.reference_states)),
                solid == cases.end() ? "" : cell(force_difference(state, solid->reference_states)));
  }
  write_whole(file, text);
}

void write_study_json(const std::filesystem::path& file, const Study& plan,
                      const std::vector<StudyRow>& rows, const std::vector<StudyCase>& cases) {
  Json result = {{"scene", plan.scene.string()}, {"settings", plan.settings}};
  for (const Dimension& dimension : plan.grid)
    result["grid"][std::string(dimension.key->path)] = dimension.values;
  for (const StudyCase& of : cases) {
    Json json = {{"fidelity", of.fidelity}, {"problem", of.problem}, {"runs", of.rows.size()}};
    if (of.reference) {
      json["reference"] = {{"run", plan.points[rows[*of.reference].point].name},
                           {"extrapolated", of.extrapolated},
                           {"uncertainty_force", of.uncertainty()}};
      for (const KeyUncertainty& left : of.uncertainties)
        json["reference"]["uncertainty_by_key"][std::string(left.key->path)] = {
            {"force", left.force},
            {"order_known", left.order_known},
            {"extrapolated", left.extrapolated}};
    }
    json["orders"] = Json::array();
    for (const KeyOrder& order : of.orders)
      json["orders"].push_back({{"key", order.key->path},
                                {"values", order.values},
                                {"force_largest", order_or_null(order.force_largest)},
                                {"force_mean", order_or_null(order.force_mean)},
                                {"energy", order_or_null(order.energy)}});
    json["pareto_front"] = Json::array();
    for (const size_t row : of.front)
      json["pareto_front"].push_back({{"run", plan.points[rows[row].point].name},
                                      {"seconds", rows[row].seconds()},
                                      {"error_force_largest", rows[row].error->force_largest}});
    for (const StudyCase::Gap& gap : of.from_solid)
      json["from_solid"].push_back({{"ebar", gap.ebar}, {"force", gap.force}});
    json["sentences"] = sentences(plan, rows, of);
    result["cases"].push_back(json);
  }
  write_whole(file, result.dump(2) + "\n");
}

}  // namespace bight::coupling
