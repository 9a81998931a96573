#include "coupling/report_data.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "coupling/compare.h"
#include "coupling/compare_centerlines.h"
#include "coupling/errors.h"
#include "coupling/evenly.h"
#include "coupling/files.h"
#include "coupling/read_curves.h"
#include "coupling/read_table.h"
#include "coupling/report_states.h"

namespace bight::coupling {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr size_t most_states = 60, most_rows = 4000, most_notes = 200;

// An unfinished run has not written all files yet.
std::string text_of(const fs::path& file) { return fs::exists(file) ? read_whole(file) : ""; }

Json read_json(const fs::path& file) {
  if (!fs::exists(file)) return {};
  Json json = Json::parse(read_whole(file), nullptr, false);
  if (json.is_discarded()) throw FileError(file.string() + ": cannot be read as JSON");
  return json;
}

Json read_toml(const fs::path& file) {
  if (!fs::exists(file)) return Json::object();
  try {
    std::ostringstream json;
    json << toml::json_formatter(toml::parse(read_whole(file)));
    return Json::parse(json.str());
  } catch (const toml::parse_error& error) {
    throw FileError(fmt::format("{}:{}: cannot be read as TOML: {}", file.string(),
                                error.source().begin.line, error.description()));
  }
}

// Folders of the fidelities that have accepted a step, by their names.
std::vector<std::pair<std::string, fs::path>> begun_fidelities(const fs::path& folder) {
  std::vector<std::pair<std::string, fs::path>> begun;
  for (const auto& [name, of] : fidelity_folders(folder))
    if (!read_table(of / "force.csv").rows.empty()) begun.emplace_back(of.filename(), of);
  return begun;
}

Json force_columns(const fs::path& csv) {
  const Table table = read_table(csv);
  Json columns = {{"rows", table.rows.size()}};
  for (size_t k = 0; k < table.names.size(); ++k) {
    Json& column = columns[table.names[k]] = Json::array();
    for (const size_t row : evenly(table.rows.size(), most_rows))
      column.push_back(table.rows[row][k]);
  }
  return columns;
}

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json();
}

Json comparison_of(const std::vector<ForceCurve>& curves, double friction) {
  const Comparison comparison = compare(curves, friction);
  Json result = {{"names", comparison.names}, {"rows", Json::array()}};
  for (const size_t k : evenly(comparison.rows.size(), most_rows)) {
    const Comparison::Row& row = comparison.rows[k];
    Json json = {{"ebar", row.ebar}, {"tightening", row.tightening}, {"law", or_null(row.law)}};
    for (size_t i = 0; i < row.force.size(); ++i) {
      json["force"].push_back(or_null(row.force[i]));
      json["difference"].push_back(or_null(row.difference(i)));
    }
    result["rows"].push_back(json);
  }
  for (size_t i = 1; i < comparison.names.size(); ++i)
    for (const double level : parting_levels)
      result["parted"][comparison.names[i]].push_back(
          {{"level", level}, {"ebar", or_null(parted_at(comparison, i, level))}});
  return result;
}

Json law_over(const std::vector<ForceCurve>& curves, double friction) {
  constexpr int points = 200;
  double low = 1e300, high = 0;
  for (const ForceCurve& curve : curves)
    for (const double ebar : curve.ebar) low = std::min(low, ebar), high = std::max(high, ebar);
  Json law = Json::array();
  for (int i = 0; i <= points && high > 0; ++i) {
    const double ebar = high + (std::max(low, 0.01 * high) - high) * i / points;
    law.push_back({{"ebar", ebar},
                   {"tightening", or_null(loose_knot_law(ebar, friction, true))},
                   {"loosening", or_null(loose_knot_law(ebar, friction, false))}});
  }
  return law;
}

Json curvature_of(const fs::path& folder) {
  Json result = Json::array();
  for (const auto& d : compare_centerlines(folder / "rod", folder / "solid"))
    result.push_back({{"name", d.state}, {"ebar", d.ebar}, {"mean_difference", d.mean}});
  return result;
}

Json notes_of(const fs::path& log) {
  Json notes = Json::array();
  std::istringstream lines(text_of(log));
  for (std::string line; std::getline(lines, line) && notes.size() < most_notes;)
    if (line.find("cutbacks") != line.npos || line.find("SNAP") != line.npos) notes.push_back(line);
  return notes;
}

}  // namespace

Json report_data(const fs::path& folder, const std::vector<fs::path>& measured, size_t bytes) {
  if (!fs::is_directory(folder)) throw InputError(folder.string() + ": there is no such folder");
  const bool study = fs::exists(folder / "study.csv");
  const auto fidelities = begun_fidelities(folder);
  if (fidelities.empty() && !study)
    throw InputError(folder.string() +
                     ": no result: no rows in rod/force.csv or solid/force.csv, no study.csv");
  std::vector<ForceCurve> measurements;
  for (const fs::path& file : measured)
    for (ForceCurve& curve : read_curves(file, read_scales(folder)))
      measurements.push_back(std::move(curve));

  const std::string scene_text = text_of(folder / "scene.toml");
  Json data = {{"folder", folder.lexically_normal().string()},
               {"scene", read_toml(folder / "scene.toml")},
               {"scene_text", scene_text},
               {"summary", read_json(folder / "summary.json")},
               {"force", Json::object()}};
  std::vector<ForceCurve> curves;
  for (const auto& [fidelity, of] : fidelities) {
    data["force"][fidelity] = force_columns(of / "force.csv");
    for (ForceCurve& curve : read_curves(of / "force.csv")) {
      curve.name = fidelity;
      curves.push_back(std::move(curve));
    }
  }
  const size_t simulated = curves.size();
  curves.insert(curves.end(), measurements.begin(), measurements.end());
  if (simulated > 0) {
    const double friction = data["scene"].value(Json::json_pointer("/effects/friction"), 0.0);
    data["comparison"] = comparison_of(curves, friction);
    data["law"] = law_over({curves.begin(), curves.begin() + simulated}, friction);
    data["curvature"] = curvature_of(folder);
    data["notes"] = notes_of(folder / "run.log");
  }
  for (const ForceCurve& curve : measurements)
    data["measured"].push_back({{"name", curve.name},
                                {"ebar", curve.ebar},
                                {"force_normalised", curve.force},
                                {"spread", curve.spread}});
  if (study)
    data["study"] = {{"csv", read_whole(folder / "study.csv")},
                     {"json", read_json(folder / "study.json")}};
  if (simulated > 0) {
    const double diameter = data["scene"].value(Json::json_pointer("/rod/diameter"), 0.0);
    if (!(diameter > 0)) throw FileError((folder / "scene.toml").string() + ": no rod.diameter");
    const size_t left = bytes - std::min(bytes, data.dump().size());
    data["states"] = report_states(folder, diameter, most_states, left);
  }
  return data;
}

}  // namespace bight::coupling
