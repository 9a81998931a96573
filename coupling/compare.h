#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupling/force_curve.h"

namespace bight::coupling {

/// Relative differences in T whose ebar is told.
constexpr double parting_levels[] = {0.02, 0.05, 0.1};

/// Several force curves on one ebar axis; where a curve has no value there is none.
struct Comparison {
  struct Row {
    double ebar = 0;
    bool tightening = true;
    std::vector<std::optional<double>> force;   ///< Tbar, one per curve
    std::vector<std::optional<double>> spread;  ///< of a measured one
    std::optional<double> law;                  ///< loose-knot law
    /// Relative difference of curve i from the first one.
    std::optional<double> difference(size_t i) const;
  };
  std::vector<std::string> names;
  std::vector<Row> rows;

  bool has_spread(size_t i) const;
  /// Part of the rows, of those where both are known, in which curve i lies inside the spread of
  /// the measured one.
  std::optional<double> within_spread(size_t i, size_t measured) const;
};

/// Lays the k-th tightening (loosening) legs of all curves on each other, at every ebar that any of
/// them has. `friction` enters the law.
Comparison compare(const std::vector<ForceCurve>& curves, double friction);

/// The ebar from which on, while the knot is first tightened, curve i stays further than `level`
/// from the first curve.
std::optional<double> parted_at(const Comparison& comparison, size_t i, double level);

void write_comparison(const std::filesystem::path& file, const Comparison& comparison);

/// A table of at most `rows` rows for the eye, and where the curves part by 2, 5 and 10 %.
std::string comparison_text(const Comparison& comparison, size_t rows = 12);

}  // namespace bight::coupling
