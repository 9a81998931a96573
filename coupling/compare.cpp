#include "coupling/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "coupling/files.h"

namespace bight::coupling {
namespace {

constexpr double same_ebar = 1e-6;

bool tightens(const ForceCurve& leg) { return leg.ebar.back() <= leg.ebar.front(); }

// Every ebar of the legs, in the direction of travel.
std::vector<double> axis(const std::vector<ForceCurve>& legs, bool tightening) {
  std::vector<double> all;
  for (const ForceCurve& leg : legs) all.insert(all.end(), leg.ebar.begin(), leg.ebar.end());
  std::ranges::sort(all);
  const auto same = [](double a, double b) { return std::abs(a - b) < same_ebar; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  if (tightening) std::ranges::reverse(all);
  return all;
}

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format(",{:.12g}", *value) : ",";
}

}  // namespace

std::optional<double> Comparison::Row::difference(size_t i) const {
  if (!force[i] || !force[0] || *force[0] == 0) return std::nullopt;
  return *force[i] / *force[0] - 1;
}

bool Comparison::has_spread(size_t i) const {
  return std::ranges::any_of(rows, [&](const Row& row) { return row.spread[i].has_value(); });
}

std::optional<double> Comparison::within_spread(size_t i, size_t measured) const {
  int known = 0, inside = 0;
  for (const Row& row : rows) {
    if (!row.force[i] || !row.spread[measured]) continue;
    ++known;
    inside += std::abs(*row.force[i] - *row.force[measured]) <= *row.spread[measured];
  }
  if (known == 0) return std::nullopt;
  return static_cast<double>(inside) / known;
}

Comparison compare(const std::vector<ForceCurve>& curves, double friction) {
  Comparison result;
  std::map<std::pair<int, bool>, std::vector<ForceCurve>> matched;  // by turn and direction
  for (const ForceCurve& curve : curves) {
    result.names.push_back(curve.name);
    std::map<bool, int> turns;
    for (const ForceCurve& leg : legs(curve)) {
      const bool tightening = tightens(leg);
      auto& group = matched[{2 * turns[tightening]++ + !tightening, tightening}];
      group.resize(curves.size());
      group[result.names.size() - 1] = leg;
    }
  }
  for (const auto& [turn, group] : matched)
    for (const double ebar : axis(group, turn.second)) {
      Comparison::Row row{ebar, turn.second, {}, {}, loose_knot_law(ebar, friction, turn.second)};
      for (const ForceCurve& leg : group) {
        row.force.push_back(force_at(leg, ebar));
        row.spread.push_back(spread_at(leg, ebar));
      }
      result.rows.push_back(row);
    }
  return result;
}

std::optional<double> parted_at(const Comparison& comparison, size_t i, double level) {
  std::vector<std::pair<double, double>> path;  // ebar, |difference| of the first tightening leg
  for (const Comparison::Row& row : comparison.rows) {
    if (!row.tightening || (!path.empty() && row.ebar > path.back().first)) break;
    if (const auto difference = row.difference(i))
      path.emplace_back(row.ebar, std::abs(*difference));
  }
  std::optional<double> parted;
  for (size_t k = path.size(); k-- > 0 && path[k].second >= level;) {
    parted = path[k].first;
    if (k > 0 && path[k - 1].second < level) {
      const double t = (level - path[k - 1].second) / (path[k].second - path[k - 1].second);
      parted = path[k - 1].first + t * (path[k].first - path[k - 1].first);
    }
  }
  return parted;
}

void write_comparison(const std::filesystem::path& file, const Comparison& comparison) {
  std::string text = "ebar,tightening";
  for (const std::string& name : comparison.names) text += "," + name;
  text += ",loose_knot_law";
  for (size_t i = 1; i < comparison.names.size(); ++i)
    text += "," + comparison.names[i] + "_difference";
  for (size_t i = 0; i < comparison.names.size(); ++i)
    if (comparison.has_spread(i)) text += "," + comparison.names[i] + "_spread";
  text += '\n';
  for (const Comparison::Row& row : comparison.rows) {
    text += fmt::format("{:.12g},{}", row.ebar, row.tightening ? 1 : 0);
    for (const auto& force : row.force) text += cell(force);
    text += cell(row.law);
    for (size_t i = 1; i < comparison.names.size(); ++i) text += cell(row.difference(i));
    for (size_t i = 0; i < comparison.names.size(); ++i)
      if (comparison.has_spread(i)) text += cell(row.spread[i]);
    text += '\n';
  }
  write_whole(file, text);
}

std::string comparison_text(const Comparison& comparison, size_t rows) {
  std::vector<const Comparison::Row*> shared;  // rows that say something about the difference
  for (const Comparison::Row& row : comparison.rows)
    if (comparison.names.size() < 2 ||
        std::ranges::all_of(row.force, [](const auto& force) { return force.has_value(); }))
      shared.push_back(&row);
  std::string text = fmt::format("{:>9}", "ebar");
  for (const std::string& name : comparison.names) text += fmt::format("  {:>12}", name);
  text += fmt::format("  {:>12}", "law");
  for (size_t i = 1; i < comparison.names.size(); ++i)
    text += fmt::format("  {:>12}", i == 1 ? "difference" : comparison.names[i] + " d.");
  text += '\n';
  const size_t count = std::min(rows, shared.size());
  for (size_t k = 0; k < count; ++k) {
    const Comparison::Row& row = *shared[count == 1 ? 0 : k * (shared.size() - 1) / (count - 1)];
    text += fmt::format("{:9.3f}", row.ebar);
    for (const auto& force : row.force) text += force ? fmt::format("  {:12.6g}", *force) : "";
    text += row.law ? fmt::format("  {:12.6g}", *row.law) : fmt::format("  {:>12}", "-");
    for (size_t i = 1; i < comparison.names.size(); ++i)
      if (const auto d = row.difference(i)) text += fmt::format("  {:+11.2f}%", 100 * *d);
    text += '\n';
  }
  for (size_t i = 1; i < comparison.names.size() && !shared.empty(); ++i) {
    text += fmt::format("{} stays away from {} by", comparison.names[i], comparison.names[0]);
    for (const double level : parting_levels) {
      const auto parted = parted_at(comparison, i, level);
      text += fmt::format("{} {:.0f} %{}", level == parting_levels[0] ? "" : ",", 100 * level,
                          parted ? fmt::format(" from ebar {:.2f} on", *parted) : " nowhere");
    }
    text += '\n';
  }
  for (size_t measured = 0; measured < comparison.names.size(); ++measured)
    for (size_t i = 0; i < comparison.names.size(); ++i)
      if (const auto inside = comparison.within_spread(i, measured); inside && i != measured)
        text +=
            fmt::format("{} lies inside the spread of {} at {:.0f} % of the ebar that both have\n",
                        comparison.names[i], comparison.names[measured], 100 * *inside);
  return text;
}

}  // namespace bight::coupling
