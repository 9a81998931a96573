#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "coupling/files.h"
#include "coupling/units.h"
#include "mechanics/path.h"

namespace bight::coupling {

/// force.csv: one row per accepted step, whole or absent.
class ForceCsv {
 public:
  ForceCsv(const std::filesystem::path& file, const Scales& scales);
  void step(const StepRow& row);

 private:
  Scales scales_;
  LineFile file_;
};

/// "ebar_+020.000": sorts and reads well, the same for every kind of state file.
std::string state_name(double ebar);

/// A column of a table of numbers.
struct Column {
  std::string name;
  std::span<const double> values;
};

/// Columns of equal length, one header line, 12 significant digits; empty columns are left out.
void write_csv(const std::filesystem::path& file, const std::vector<Column>& columns);

/// centerline/NAME.csv: s, x, y, z, kappa (dimensionless), then `more`.
void write_centerline(const std::filesystem::path& file, std::span<const double> s,
                      const Polyline& line, std::span<const double> curvature,
                      const std::vector<Column>& more = {});

}  // namespace bight::coupling
