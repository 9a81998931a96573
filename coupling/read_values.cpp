#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "coupling/errors.h"
#include "coupling/toml_text.h"
#include "coupling/units.h"
#include "coupling/values.h"

namespace bight::coupling {
namespace {

/// Says why a value cannot be taken; the caller knows the place.
struct Unfit {
  std::string why;
};

std::string shown(const toml::node& node) {
  std::ostringstream out;
  out << toml::node_view<const toml::node>(node);
  return out.str();
}

Unfit not_allowed(const Key& key, const std::string& value) {
  return {fmt::format("{} is not {}", value, allowed(key))};
}

double checked(const Key& key, double value, const std::string& text) {
  if (!std::isfinite(value) || !key.range.contains(value)) throw not_allowed(key, text);
  if (key.kind == Kind::integer && value != std::floor(value)) throw not_allowed(key, text);
  return value;
}

double to_number(const Key& key, const toml::node& node) {
  const bool has_unit = key.kind == Kind::quantity || key.kind == Kind::quantities;
  if (has_unit && node.is_string()) {
    const std::string text = **node.as_string();
    try {
      return checked(key, parse_quantity(text, key.unit), '"' + text + '"');
    } catch (const InputError& error) {
      throw Unfit{error.what()};
    }
  }
  if (!node.is_number()) throw not_allowed(key, shown(node));
  return checked(key, *node.value<double>(), shown(node));
}

std::string to_word(const Key& key, const toml::node& node) {
  if (!node.is_string()) throw not_allowed(key, shown(node));
  const std::string text = **node.as_string();
  const bool free = key.kind == Kind::text || key.kind == Kind::file;
  if (!free && std::ranges::find(key.words, text) == key.words.end())
    throw not_allowed(key, '"' + text + '"');
  return text;
}

// A list; a single value counts as a list of one.
template <class Item>
auto to_list(const Key& key, const toml::node& node, Item item) {
  std::vector<decltype(item(key, node))> list;
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& entry : *array) list.push_back(item(key, entry));
  } else {
    list.push_back(item(key, node));
  }
  if (list.empty()) throw not_allowed(key, "an empty list");
  return list;
}

Value to_value(const Key& key, const toml::node& node) {
  switch (key.kind) {
    case Kind::quantity:
    case Kind::number:
    case Kind::integer:
      return to_number(key, node);
    case Kind::boolean:
      if (!node.is_boolean()) throw not_allowed(key, shown(node));
      return **node.as_boolean();
    case Kind::word:
    case Kind::text:
    case Kind::file:
      return to_word(key, node);
    case Kind::words:
      return to_list(key, node, to_word);
    case Kind::numbers:
    case Kind::quantities:
      return to_list(key, node, to_number);
    case Kind::grid:
    case Kind::cases:
      throw not_allowed(key, shown(node));
  }
  return {};
}

std::string unknown_key(const std::string& path) {
  if (path.starts_with("effects.")) {
    std::string names;
    for (const Key& key : all_keys())
      if (key.path.starts_with("effects."))
        names += fmt::format("{}{}", names.empty() ? "" : ", ", key.path.substr(8));
    return "no such effect; available: " + names;
  }
  return fmt::format("unknown key; nearest is {}", nearest_key(path).path);
}

void take(const std::string& path, const toml::node& node, const std::string& where, Values& values,
          Problems& problems) {
  const Key* key = find_key(path);
  if (!key) {
    problems.add(where, path, unknown_key(path));
    problems.excuse(nearest_key(path).path);  // a misspelt key is not missing as well
    return;
  }
  try {
    values.set(path, {to_value(*key, node), where});
  } catch (const Unfit& unfit) {
    problems.add(where, path, unfit.why);
  }
}

// The values of a key in the grid, as they are written behind --grid: "85, 170, 340".
std::string listed(const toml::node& node) {
  if (!node.is_array()) return toml_text(node);
  std::string text;
  for (const toml::node& entry : *node.as_array())
    text += (text.empty() ? "" : ", ") + toml_text(entry);
  return text;
}

// Every key of the grid in the order of the lines; TOML's tables are sorted by name.
void take_grid(const std::string& prefix, const toml::table& table, const std::string& name,
               std::map<std::pair<uint32_t, uint32_t>, std::string>& grid, Problems& problems) {
  for (const auto& [key, node] : table) {
    const std::string path = prefix + std::string(key.str());
    const auto [line, column] = key.source().begin;
    if (const toml::table* inner = node.as_table())
      take_grid(path + '.', *inner, name, grid, problems);
    else if (!find_key(path))
      problems.add(fmt::format("{}:{}", name, line), "study.grid." + path, unknown_key(path));
    else
      grid[{line, column}] = path + '=' + listed(node);
  }
}

using ByPlace = std::map<std::pair<uint32_t, uint32_t>, std::string>;

// What a case sets, as "NAME: key=value", in the order of the lines.
void take_case(const std::string& name, const std::string& prefix, const toml::table& table,
               const std::string& scene, ByPlace& lines, Problems& problems) {
  for (const auto& [key, node] : table) {
    const std::string path = prefix + std::string(key.str());
    const auto [line, column] = key.source().begin;
    if (const toml::table* inner = node.as_table())
      take_case(name, path + '.', *inner, scene, lines, problems);
    else if (!find_key(path))
      problems.add(fmt::format("{}:{}", scene, line), "cases." + name + "." + path,
                   unknown_key(path));
    else
      lines[{line, column}] = name + ": " + path + '=' + toml_text(node);
  }
}

std::vector<std::string> take_cases(const toml::table& cases, const std::string& scene,
                                    Problems& problems) {
  ByPlace lines;
  for (const auto& [key, node] : cases) {
    const std::string name(key.str());
    const auto [line, column] = key.source().begin;
    const bool good = !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
      return std::isalnum(c) || c == '-' || c == '_';
    });
    if (!good || !node.is_table()) {
      problems.add(fmt::format("{}:{}", scene, line), "cases." + name,
                   good ? "a case is a table of the keys that differ from the scene"
                        : "the name of a case has letters, digits, - and _");
      continue;
    }
    lines[{line, 0}] = name + ": ";
    take_case(name, "", *node.as_table(), scene, lines, problems);
  }
  std::vector<std::string> list;
  for (const auto& [place, text] : lines) list.push_back(text);
  return list;
}

void take_table(const std::string& prefix, const toml::table& table, const std::string& name,
                Values& values, Problems& problems) {
  for (const auto& [key, node] : table) {
    const std::string path = prefix + std::string(key.str());
    const std::string where = fmt::format("{}:{}", name, key.source().begin.line);
    if (const Key* known = find_key(path); known && known->kind == Kind::grid && node.is_table()) {
      std::map<std::pair<uint32_t, uint32_t>, std::string> grid;
      take_grid("", *node.as_table(), name, grid, problems);
      std::vector<std::string> lines;
      for (const auto& [place, line] : grid) lines.push_back(line);
      values.set(path, {lines, where});
    } else if (known && known->kind == Kind::cases && node.is_table()) {
      values.set(path, {take_cases(*node.as_table(), name, problems), where});
    } else if (node.is_table() && !(node.as_table()->empty() && find_key(path)))
      take_table(path + '.', *node.as_table(), name, values, problems);
    else
      take(path, node, where, values, problems);
  }
}

// The right side of --set as TOML; what is not TOML (8.3 mm, rod) is a string.
void take_override(const std::string& setting, Values& values, Problems& problems) {
  const size_t equals = setting.find('=');
  if (equals == setting.npos || equals == 0)
    return problems.add("--set " + setting, "", "write --set key.path=value");
  const std::string path = setting.substr(0, equals), text = setting.substr(equals + 1);
  const Key* key = find_key(path);
  const bool free = key && (key->kind == Kind::text || key->kind == Kind::file);
  if (!free) {
    try {
      const toml::table table = toml::parse("value = " + text);
      if (table.size() == 1) return take(path, *table.get("value"), "--set", values, problems);
    } catch (const toml::parse_error&) {
    }
  }
  take(path, toml::value<std::string>(text), "--set", values, problems);
}

bool is_text(const std::string& text) {
  return std::ranges::none_of(text, [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte == 0x7f || (byte < 0x20 && !(byte >= '\t' && byte <= '\r'));
  });
}

}  // namespace

Values read_values(const std::string& text, const std::string& name,
                   const std::vector<std::string>& overrides, Problems& problems) {
  if (!is_text(text)) throw InputError(name + ": binary data, not the TOML text of a scene");
  Values values(name);
  try {
    const toml::table table = toml::parse(text);
    if (table.empty())
      throw InputError(name + ": the scene is empty; `bight keys` lists what can be written");
    take_table("", table, name, values, problems);
  } catch (const toml::parse_error& error) {
    throw InputError(
        fmt::format("{}:{}: {}", name, error.source().begin.line, error.description()));
  }
  for (const std::string& setting : overrides) take_override(setting, values, problems);
  for (const Key& key : all_keys()) {
    const std::string path(key.path);
    if (values.has(path) || problems.about(path)) continue;
    if (!key.fallback.empty())
      values.set(
          path,
          {to_value(key, *toml::parse("value = " + std::string(key.fallback)).get("value")), ""});
    else if (key.otherwise == "required")
      problems.add(name, path, "missing; write " + allowed(key));
  }
  if (!values.has("material.youngs_modulus") && !problems.about("material.youngs_modulus") &&
      !values.has("material.c10") && !values.has("material.ogden_moduli"))
    problems.add(name, "material.youngs_modulus",
                 "missing; write " + allowed(*find_key("material.youngs_modulus")));
  if (!values.has("path.ebar") && !values.has("path.force") && !problems.about("path.ebar") &&
      !problems.about("path.force"))
    problems.add(name, "path.ebar",
                 "missing; write " + allowed(*find_key("path.ebar")) + ", or give path.force");
  return values;
}

}  // namespace bight::coupling
