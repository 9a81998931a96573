#include "coupling/read_measured.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "coupling/errors.h"
#include "coupling/read_table.h"

namespace bight::coupling {
namespace {

/// A column and what its numbers are to be multiplied by.
struct Measured {
  size_t column;
  double factor;
};

/// The unit behind the name of a column, "" for none; nothing where the column has another name.
std::optional<std::string> unit_behind(const std::string& title, const std::string& name) {
  if (!lower(title).starts_with(name)) return std::nullopt;
  std::string rest = title.substr(name.size());
  if (rest.empty()) return rest;
  const bool brackets = rest.back() == ']' || rest.back() == ')';
  const auto begin = rest.find_first_of(brackets ? "[(" : "_ ");
  if (begin == rest.npos || rest.find_first_not_of(" _") < begin) return std::nullopt;
  rest = rest.substr(begin + 1);
  if (brackets) rest.pop_back();
  return rest;
}

std::optional<Measured> find(const Table& table, const std::string& name, const std::string& si,
                             const std::optional<double>& scale) {
  for (size_t column = 0; column < table.titles.size(); ++column) {
    const auto unit = unit_behind(table.titles[column], name);
    if (!unit || unit->empty()) continue;
    double factor = 0;
    try {
      factor = parse_quantity("1 " + *unit, si);
    } catch (const InputError& error) {
      throw InputError(
          fmt::format("{}: column {}: {}", table.file, table.titles[column], error.what()));
    }
    if (!scale)
      throw InputError(
          fmt::format("{}: column {}: give a results folder before the file; its rod says what {} "
                      "is in D and B",
                      table.file, table.titles[column], *unit));
    return Measured{column, factor / *scale};
  }
  return std::nullopt;
}

/// The dimensionless column of that name, or the one with a unit.
Measured either(const Table& table, const std::string& plain, const std::string& name,
                const std::string& si, const std::optional<double>& scale) {
  if (table.has(plain)) return {static_cast<size_t>(table.column(plain)), 1};
  if (const auto found = find(table, name, si, scale)) return *found;
  throw InputError(fmt::format(
      "{}: neither a column {} nor {} with a unit, as in {} [{}]; there are: {}", table.file, plain,
      name, name, si,
      table.names.empty() ? "no names" : fmt::format("{}", fmt::join(table.titles, ", "))));
}

}  // namespace

ForceCurve read_measured(const std::filesystem::path& file, const std::optional<Scales>& scales) {
  const Table table = read_table(file);
  std::optional<double> length, force;
  if (scales) {
    length = scales->length();
    force = scales->force() / normalised_force(1);
  }
  const Measured ebar = either(table, "ebar", "shortening", "m", length);
  const Measured tension = either(table, "force_normalised", "force", "N", force);
  std::optional<Measured> spread = find(table, "spread", "N", force);
  if (!spread && table.has("spread"))
    spread = Measured{static_cast<size_t>(table.column("spread")), tension.factor};

  ForceCurve curve{file.stem().string(), {}, {}, {}};
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const auto value = [&](const Measured& of) { return table.rows[i][of.column] * of.factor; };
    curve.ebar.push_back(value(ebar));
    curve.force.push_back(value(tension));
    if (!spread) continue;
    curve.spread.push_back(value(*spread));
    if (!(curve.spread.back() >= 0))
      throw InputError(fmt::format("{}:{}: a spread is not negative", table.file, table.lines[i]));
  }
  if (curve.ebar.empty()) throw InputError(file.string() + ": no rows");
  return curve;
}

}  // namespace bight::coupling
