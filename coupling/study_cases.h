#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/study_rows.h"

namespace bight::coupling {

/// Order of convergence in one key, all others at the reference's, from three values whose sizes
/// are in ratios of about two or more where the grid has such.
struct KeyOrder {
  const Key* key;
  std::vector<std::string> values;  ///< the finest first
  /// In the size h that the key sets: of the largest and mean difference in T, the mean in energy.
  std::optional<double> force_largest, force_mean, energy;
};

/// What is left in the reference of the resolution in one key, relative, in T.
struct KeyUncertainty {
  const Key* key;
  double force;
  bool order_known;  ///< else it is the difference of the two finest runs
  bool extrapolated;
};

/// The runs of one fidelity that solve one and the same problem.
struct StudyCase {
  std::string fidelity;
  std::vector<std::string> problem;  ///< settings of the grid that are the problem's
  std::vector<size_t> rows;
  std::optional<size_t> reference;  ///< the finest row that finished
  RecordedStates reference_states;  ///< what errors are measured against: its own, or their limit
  bool extrapolated = false;        ///< the reference is extrapolated from there
  std::vector<KeyOrder> orders;
  std::vector<KeyUncertainty> uncertainties;
  std::vector<size_t> front;  ///< rows, the cheapest first; T against seconds

  double uncertainty() const;  ///< of the reference in T: the sum over keys

  /// Of the rod: how far its reference is from that of the solid of the same problem, which no
  /// resolution mends.
  struct Gap {
    double ebar;
    double force;  ///< T of the rod over that of the solid, less 1
  };
  std::vector<Gap> from_solid;  ///< at each ebar that both recorded, the largest first
};

/// Settings of a row's run that mean something to its fidelity and are not the problem's.
std::vector<std::string> resolution_settings(const std::vector<Dimension>& grid,
                                             const GridPoint& point, const std::string& fidelity);

/// Sorts rows into cases, finds each one's reference, writes errors into the rows, and finds orders
/// and fronts. Rows of the rod that differ by keys of the solid alone are one: the first counts.
/// `extrapolate`: key over which the reference is extrapolated, or empty.
std::vector<StudyCase> study_cases(const std::vector<Dimension>& grid,
                                   const std::vector<GridPoint>& points,
                                   std::vector<StudyRow>& rows, const std::string& extrapolate);

}  // namespace bight::coupling
