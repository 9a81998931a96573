#include "coupling/grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <sstream>

#include "coupling/errors.h"
#include "coupling/toml_text.h"

namespace bight::coupling {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  return first == text.npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// As it is written behind --set: a word without its quotes, everything else as TOML.
std::string as_setting(const toml::node& node) {
  return node.is_string() ? **node.as_string() : toml_text(node);
}

std::vector<std::string> read_list(const std::string& text) {
  std::vector<std::string> list;
  try {
    const toml::table table = toml::parse(fmt::format("list = [{}]", text));
    for (const toml::node& node : *table.get("list")->as_array()) list.push_back(as_setting(node));
    return list;
  } catch (const toml::parse_error&) {  // 8.3 mm, 9 mm
    std::istringstream words(text);
    for (std::string word; std::getline(words, word, ',');) list.push_back(trimmed(word));
    return list;
  }
}

Dimension read_dimension(const std::string& line) {
  const auto refuse = [&](const std::string& what) {
    return InputError(fmt::format("--grid {}: {}", line, what));
  };
  const size_t equals = line.find('=');
  if (equals == line.npos || equals == 0) throw refuse("write --grid key.path=value,value");
  const std::string path = trimmed(line.substr(0, equals));
  const Key* key = find_key(path);
  if (!key) throw refuse(fmt::format("unknown key; nearest is {}", nearest_key(path).path));
  if (path.starts_with("study.")) throw refuse("a study does not vary what it is itself");
  Dimension dimension{key, read_list(line.substr(equals + 1))};
  if (dimension.values.empty()) throw refuse("no values");
  std::set<std::string> met;
  for (const std::string& value : dimension.values) {
    if (value.empty()) throw refuse("an empty value");
    if (!met.insert(value).second) throw refuse(value + " is there twice");
  }
  return dimension;
}

// Nothing that a shell or a file system takes for more than a letter.
std::string safe(std::string text) {
  std::ranges::replace_if(
      text,
      [](unsigned char c) {
        return !std::isalnum(c) && std::string_view("._+-=").find(c) == std::string_view::npos;
      },
      '_');
  return text;
}

}  // namespace

bool Dimension::resolution() const {
  return key->fineness != Fineness::physical && key->fineness != Fineness::choice;
}

double Dimension::size(size_t value) const {
  std::string digits = values[value];
  std::erase(digits, '_');  // TOML's 1_000
  const double number = std::stod(digits);
  switch (key->fineness) {
    case Fineness::size:
      return number;
    case Fineness::count:
      return 1 / number;
    case Fineness::count_per_area:
      return 1 / std::sqrt(number);
    default:
      return 0;
  }
}

std::vector<Dimension> read_grid(const std::vector<std::string>& lines) {
  std::vector<Dimension> grid;
  for (const std::string& line : lines) {
    Dimension dimension = read_dimension(line);
    const auto same = std::ranges::find(grid, dimension.key, &Dimension::key);
    if (same == grid.end())
      grid.push_back(std::move(dimension));
    else
      *same = std::move(dimension);
  }
  return grid;
}

std::vector<GridPoint> product(const std::vector<Dimension>& grid) {
  std::vector<GridPoint> points(1);
  for (const Dimension& dimension : grid) {
    std::vector<GridPoint> longer;
    for (const GridPoint& point : points)
      for (size_t value = 0; value < dimension.values.size(); ++value) {
        longer.push_back(point);
        longer.back().at.push_back(value);
        longer.back().settings.push_back(
            fmt::format("{}={}", dimension.key->path, dimension.values[value]));
      }
    points = std::move(longer);
  }
  std::set<std::string> met;
  for (GridPoint& point : points) {
    for (const std::string& setting : point.settings)
      point.name += fmt::format("{}{}", point.name.empty() ? "" : ",", safe(setting));
    if (!met.insert(point.name).second)
      throw InputError(fmt::format("--grid: two runs would lie in the folder {}", point.name));
  }
  return points;
}

}  // namespace bight::coupling
