#pragma once

#include <map>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "coupling/keys.h"

namespace bight::coupling {

/// What a scene gives for a key, in SI; integers are whole doubles, words are strings; a grid is a
/// list of "key=value, value", cases one of "NAME: " and "NAME: key=value".
using Value =
    std::variant<bool, double, std::string, std::vector<double>, std::vector<std::string>>;

struct Given {
  Value value;
  std::string where;  ///< "scene.toml:12" or "--set"; empty for a default
};

/// Collects problems so that all are reported at once.
class Problems {
 public:
  void add(const std::string& where, const std::string& key, const std::string& what);
  void excuse(std::string_view key) { keys_.insert(std::string(key)); }  ///< no word on it any more
  bool about(const std::string& key) const { return keys_.contains(key); }
  bool any() const { return !lines_.empty(); }
  void throw_if_any() const;  ///< InputError with one line per problem

 private:
  std::vector<std::string> lines_;
  std::set<std::string> keys_;
};

/// Values by key path, each of the key's kind and within its range.
class Values {
 public:
  explicit Values(std::string scene) : scene_(std::move(scene)) {}
  bool has(std::string_view key) const { return given_.contains(std::string(key)); }
  bool written(std::string_view key) const;       ///< by the user, that is not a default
  std::string where(std::string_view key) const;  ///< the scene as a whole for a default
  void set(std::string_view key, Given given) { given_[std::string(key)] = std::move(given); }
  /// The value of a key, or what `T` is without one.
  template <class T>
  T get(std::string_view key) const {
    const auto found = given_.find(std::string(key));
    return found == given_.end() ? T{} : std::get<T>(found->second.value);
  }
  double number(std::string_view key) const { return get<double>(key); }
  std::string word(std::string_view key) const { return get<std::string>(key); }
  /// A scene that reads back to these values, without what only a study reads and without cases.
  std::string toml() const;

 private:
  std::string scene_;
  std::map<std::string, Given> given_;
};

/// Reads TOML text (called `name` in messages), then "key=value" overrides, then defaults.
Values read_values(const std::string& text, const std::string& name,
                   const std::vector<std::string>& overrides, Problems& problems);

}  // namespace bight::coupling
