#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bight::coupling {

struct ReportOptions {
  std::filesystem::path out;                    ///< empty: report.html in the folder
  std::vector<std::filesystem::path> measured;  ///< CSV files with columns ebar, force_normalised
  std::filesystem::path script;  ///< the page's program; empty: where ./bight builds it
};

/// Largest page [bytes].
constexpr size_t largest_report = 8'000'000;

/// Writes one page that shows a results folder and needs nothing but a browser; says where it is.
/// Throws InputError for a folder without results, FileError without the script.
void report(const std::filesystem::path& folder, const ReportOptions& options);

}  // namespace bight::coupling
