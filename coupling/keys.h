#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace bight::coupling {

enum class Kind {
  quantity,
  number,
  integer,
  boolean,
  word,
  words,
  numbers,
  quantities,
  text,
  file,
  grid,
  cases
};

/// What another value of a key makes of a result: another problem; the same problem solved another
/// way; or the same problem, finer or coarser. Then the size h, with which errors fall, goes with
/// the value, with its inverse, or with the inverse of its root.
enum class Fineness { physical, choice, size, count, count_per_area };

/// An interval; a bracket is open when its end is not allowed.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool contains(double value) const;
  std::string text() const;  ///< "(0, 0.5]"
};

/// One scene key: everything that reading, checking and `bight keys` need to know about it.
struct Key {
  std::string_view path;  ///< "rod.diameter"
  Kind kind;
  std::string unit;                     ///< SI, of a quantity
  Range range;                          ///< of numbers
  std::vector<std::string_view> words;  ///< of a word
  std::string_view fallback;            ///< default as TOML; empty: required or derived
  std::string_view otherwise;           ///< "required", or how the default is derived
  std::string_view meaning;
  Fineness fineness = Fineness::physical;
};

/// THE table, in the order in which a scene is written.
const std::vector<Key>& all_keys();

const Key* find_key(std::string_view path);

/// The key whose path needs the fewest edits (the last part counts alone too).
const Key& nearest_key(std::string_view path);

/// What may be written for a key: "a length in m, (0, inf)".
std::string allowed(const Key& key);

/// The table as text, for `bight keys`.
std::string keys_table();

}  // namespace bight::coupling
