#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bight::coupling {

/// Rows of numbers as found in measured data and scans.
struct Table {
  std::string file;
  std::vector<std::string> titles;        ///< as in the header line; empty without one
  std::vector<std::string> names;         ///< the same in lower case
  std::vector<std::vector<double>> rows;  ///< all of the same length
  std::vector<int> lines;                 ///< line of each row in the file

  /// Column of that name; throws InputError that lists the names there are.
  int column(const std::string& name) const;
  bool has(const std::string& name) const;
};

std::string lower(std::string text);

/// Reads numbers parted by commas, semicolons (then a decimal comma is understood), tabs or blanks;
/// a first line that is not numbers names the columns; # begins a comment line.
Table read_table(const std::filesystem::path& file);

}  // namespace bight::coupling
