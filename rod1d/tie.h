#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "rod1d/polyline.h"
#include "rod1d/run_rod.h"
#include "rod1d/two_fold.h"

namespace bight::rod1d {

/// One move while a knot is tied: where the finish grip and the auxiliary points of that half of
/// the rod are at its end. The grip goes there along a straight line while its direction turns
/// evenly.
struct TieMove {
  std::string_view step;  ///< the step of the protocol that it belongs to
  int increments;
  Vector3 finish, direction;  ///< place of the end, the rod's tangent there
  Polyline auxiliary;         ///< of the auxiliary points; empty: they are let go
};

/// How a straight rod is tied: the protocol of Baek et al. (2021), Fig. 3, after Durville (2012).
/// The rod is bent while auxiliary points are held (bend), its ends are led through its loops
/// (thread), the auxiliary points are let go (release). What the finish half does the start half
/// does as its image: one half is simulated.
struct TieProtocol {
  std::string_view knot;
  double length;                  ///< of the rod, in the unit of the moves
  TwoFold::Kind symmetry;         ///< with the axis of a half turn along x
  std::vector<double> auxiliary;  ///< arc lengths from the middle to the auxiliary points
  std::vector<TieMove> moves;     ///< from the straight rod along z on, its middle at 0

  /// End-to-end shortening over length when the knot is tied.
  double shortening() const;
};

/// THE list of protocols; throws std::invalid_argument for a knot that has none.
const TieProtocol& tie_protocol(std::string_view knot);

/// Between which ebar the protocols can tie a knot.
constexpr double tightest_tie = 27, loosest_tie = 120;

/// The centerline of a straight rod of that length [D] after it was tied: in equilibrium, ends
/// aligned, `length` - `ebar` apart. The moves are made as large as ebar asks for, by the middle of
/// the rod; what is left are straight tails. The observer sees every increment. Strands are in
/// contact throughout and none passes another.
///
/// Throws std::invalid_argument where ebar is out of range or the rod too short, std::runtime_error
/// when the numerics fail.
Polyline tied(const TieProtocol& protocol, double length, double ebar,
              const std::function<void(std::string_view step, const RodState&)>& observer = {});

}  // namespace bight::rod1d
