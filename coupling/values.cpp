#include "coupling/values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "coupling/errors.h"

namespace bight::coupling {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      result += fmt::format("\\u{:04x}", c);
    else
      result += c;
  }
  return result + '"';
}

// Shortest text that reads back to the same number.
std::string toml_text(double value) { return fmt::format("{}", value); }
std::string toml_text(bool value) { return value ? "true" : "false"; }
std::string toml_text(const std::string& value) { return quoted(value); }
template <class T>
std::string toml_text(const std::vector<T>& values) {
  std::vector<std::string> texts;
  for (const T& value : values) texts.push_back(toml_text(value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace

void Problems::add(const std::string& where, const std::string& key, const std::string& what) {
  keys_.insert(key);
  lines_.push_back(key.empty() ? fmt::format("{}: {}", where, what)
                               : fmt::format("{}: {}: {}", where, key, what));
}

void Problems::throw_if_any() const {
  if (any()) throw InputError(fmt::format("{}", fmt::join(lines_, "\n")));
}

bool Values::written(std::string_view key) const {
  const auto found = given_.find(std::string(key));
  return found != given_.end() && !found->second.where.empty();
}

std::string Values::where(std::string_view key) const {
  return written(key) ? given_.at(std::string(key)).where : scene_;
}

std::string Values::toml() const {
  std::string text, section;
  for (const Key& key : all_keys()) {
    const auto found = given_.find(std::string(key.path));
    if (found == given_.end() || key.path.starts_with("study.") || key.kind == Kind::cases)
      continue;
    const size_t dot = key.path.find('.');
    if (dot != key.path.npos && key.path.substr(0, dot) != section) {
      section = key.path.substr(0, dot);
      text += fmt::format("\n[{}]\n", section);
    }
    const std::string name(dot == key.path.npos ? key.path : key.path.substr(dot + 1));
    text +=
        name + " = " + std::visit([](const auto& v) { return toml_text(v); }, found->second.value);
    text += key.unit.empty() ? "\n" : fmt::format("  # {}\n", key.unit);
  }
  return text;
}

}  // namespace bight::coupling
