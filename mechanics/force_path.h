#pragma once

#include <vector>

#include "mechanics/path.h"

namespace bight {

/// Where to go in the pulling force. Equilibria are followed in ebar all the same: at a force they
/// need not be stable, nor only one.
struct ForcePath {
  std::vector<double> forces;  ///< waypoints of the end tension T [E D^2], visited in this order
  double first_ebar = 0;       ///< where the path begins
  double lowest_ebar = 0, highest_ebar = 0;  ///< and where it turns back in vain
  double max_step = 0.5, min_step = 1e-4;    ///< in ebar, as in Path
};

/// A model that says an equilibrium's tension before it is accepted.
class ForceModel : public PathModel {
 public:
  /// Of the equilibrium that was solved last [E D^2].
  virtual double tension(const NewtonResult& result) const = 0;
};

/// Goes from each force to the next by steps in ebar, tightening for a larger force and loosening
/// for a smaller one. The step that would go past the force is shortened until it meets it (within
/// 1e-4): no accepted state lies behind it, so that friction never acts backwards. Every waypoint
/// is recorded.
PathOutcome follow_forces(const ForcePath& path, ForceModel& model, const PathObserver& observer);

}  // namespace bight
