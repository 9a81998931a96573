#include "coupling/read_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>

#include "coupling/errors.h"

namespace bight::coupling {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string> split(const std::string& line) {
  const char mark = line.find(';') != line.npos ? ';' : line.find(',') != line.npos ? ',' : ' ';
  std::vector<std::string> cells(1);
  for (const char c : line) {
    const bool parts = mark == ' ' ? c == ' ' || c == '\t' || c == '\r' : c == mark;
    if (!parts)
      cells.back() += c;
    else if (mark != ' ' || !cells.back().empty())
      cells.emplace_back();
  }
  if (mark == ' ' && cells.back().empty()) cells.pop_back();
  for (std::string& cell : cells) {
    cell = trimmed(cell);
    if (mark == ';') std::ranges::replace(cell, ',', '.');
  }
  return cells;
}

std::optional<double> number(std::string_view cell) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

}  // namespace

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool Table::has(const std::string& name) const {
  return std::ranges::find(names, name) != names.end();
}

int Table::column(const std::string& name) const {
  if (!has(name))
    throw InputError(
        fmt::format("{}: no column {}; there are: {}", file, name,
                    names.empty() ? "no names" : fmt::format("{}", fmt::join(names, ", "))));
  return static_cast<int>(std::ranges::find(names, name) - names.begin());
}

Table read_table(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw InputError(file.string() + ": there is no such file");
  std::ifstream in(file);
  if (!in) throw FileError(file.string() + ": cannot be read");

  Table table;
  table.file = file.string();
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    if (trimmed(text).empty() || trimmed(text).starts_with('#')) continue;
    const auto refuse = [&](const std::string& what) {
      return InputError(fmt::format("{}:{}: {}", file.string(), line, what));
    };
    std::vector<double> row;
    const std::vector<std::string> cells = split(text);
    for (const std::string& cell : cells)
      if (const auto value = number(cell)) row.push_back(*value);
    const bool header = row.empty() && table.rows.empty() && table.names.empty();
    if (header) {
      table.titles = cells;
      for (const std::string& cell : cells) table.names.push_back(lower(cell));
      continue;
    }
    if (row.size() != cells.size())
      throw refuse(fmt::format("not all are numbers: {}", trimmed(text)));
    if (!std::ranges::all_of(row, [](double x) { return std::isfinite(x); }))
      throw refuse("not all numbers are finite");
    const size_t width = !table.names.empty() ? table.names.size()
                         : table.rows.empty() ? row.size()
                                              : table.rows.front().size();
    if (row.size() != width)
      throw refuse(fmt::format("{} numbers where {} are expected", row.size(), width));
    table.rows.push_back(row);
    table.lines.push_back(line);
  }
  return table;
}

}  // namespace bight::coupling
