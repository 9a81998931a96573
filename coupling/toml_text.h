#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <sstream>
#include <string>

namespace bight::coupling {

/// A value as it is written, numbers as short as they read back to the same: 0.32, [30, 20].
inline std::string toml_text(const toml::node& node) {
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const toml::array* array = node.as_array()) {
    std::string text;
    for (const toml::node& entry : *array) text += (text.empty() ? "" : ", ") + toml_text(entry);
    return '[' + text + ']';
  }
  std::ostringstream out;
  out << toml::node_view<const toml::node>(node);
  return out.str();
}

}  // namespace bight::coupling
