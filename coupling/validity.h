#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/path.h"

namespace bight::coupling {

/// By how much the rod's tension is too large at an ebar, because its sections stay round.
struct RodError {
  double ebar = 0;
  double relative = 0;  ///< (T_rod - T_solid)/T_rod
};

/// Estimated from the rod alone, along its first tightening. If strands could flatten under their
/// contact forces they would store U (rod1d/flattening.h), and at the same ends the knot would have
/// less energy by U, to first order; as T = -dE/de,
///
///   error = c (-dU/de) / T.
///
/// c makes up for what Hertz's long cylinders leave out (short contacts, sections of bent rods). It
/// was calibrated on one run, the frictionless overhand knot of L0 = 42.17 D with 32 cells a
/// section between ebar 20 and 15, where it is 1.67 to 1.78; where the error is above 10 % it
/// falls, to 1.1 at 26 %. The estimate ends where it passes 30 %.
std::vector<RodError> rod_errors(const std::vector<StepRow>& rows);

/// The ebar down to which the error stays below `level`, and where it would be if the estimate were
/// off by as much as it has been found to be.
struct ValidDownTo {
  double ebar = 0, earliest = 0, latest = 0;
  bool reached = false;  ///< false: the error stays below along the whole path
};
/// Nothing where the error is above from the start, or there is no estimate.
std::optional<ValidDownTo> valid_down_to(const std::vector<RodError>& errors, double level);

/// Error in T that the verdict on a rod is about.
constexpr double verdict_level = 0.05;

/// "rod estimated within 5 % down to ebar = 18.9 (19.6 to 18.2)"
std::string validity_sentence(const std::vector<RodError>& errors, double level);

/// Columns ebar, estimated_error.
void write_rod_errors(const std::filesystem::path& file, const std::vector<RodError>& errors);

}  // namespace bight::coupling
