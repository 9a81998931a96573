#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bight::coupling {

/// How far two curvature profiles lie apart at one recorded ebar.
struct CurvatureDifference {
  std::string state;  ///< "ebar_+020.000"
  double ebar = 0;
  double mean = 0;  ///< mean |kappa_b - kappa_a| over mean kappa_a, along the knot
  double largest_a = 0, largest_b = 0;  ///< largest kappa D
};

/// Compares the centerline files that two fidelity folders (DIR/rod, DIR/solid) have in common. The
/// profiles are laid on each other by the knot's middle, since where the knot sits along the rod is
/// soft; the knot is where kappa_a is above a tenth of its largest value.
std::vector<CurvatureDifference> compare_centerlines(const std::filesystem::path& a,
                                                     const std::filesystem::path& b);

/// "b: kappa differs from a by ... at ebar ...", a line; empty without states in common.
std::string curvature_text(const std::string& a, const std::string& b,
                           const std::vector<CurvatureDifference>& differences);

void write_curvature(const std::filesystem::path& file,
                     const std::vector<CurvatureDifference>& differences);

}  // namespace bight::coupling
