#pragma once

#include "mechanics/coupled_newton.h"

namespace bight {

/// Friction of a step while the step is solved.
class RubbingForces : public FollowingForces {
 public:
  /// Freezes what friction depends on at the last accepted state.
  virtual void freeze_last() = 0;
};

/// What a model asks of a solve with friction; tolerances relative to its scale of forces.
struct RubbingLimits {
  double short_step;  ///< decrement of the longest step that an attempt from the guess takes [D]
  int few_first;      ///< iterations with the last state's friction, which bring contact forces in
                      ///< range
  int most_full;      ///< full steps with the whole tangent, at most: mostly they are 4
  double first_force_tolerance;
  double energy_tolerance, force_tolerance;
};

/// Newton steps with the whole tangent. From a guess whose steps are short enough, damped ones.
/// Else a few steps with the last state's friction come first: the contact forces of a poor guess
/// are too rough to begin with. Then full ones, then damped ones where these fail; where both fail,
/// as many of the few as it takes, and again. `options` is what a frictionless solve would take;
/// its tolerances and iterations are replaced by `limits`, relative to the force `scale` [E D^2].
NewtonResult newton_rubbing(System& system, RubbingForces& forces, const Vector& guess,
                            const NewtonOptions& options, const RubbingLimits& limits, double scale,
                            const NewtonObserver& observer = {});

/// Damped steps alone, for forces that store no energy: tractions prescribed at a start.
NewtonResult newton_rubbing_damped(System& system, RubbingForces& forces, const Vector& guess,
                                   const NewtonOptions& options, const RubbingLimits& limits,
                                   double scale, const NewtonObserver& observer = {});

/// From a solution after something has changed: full steps, then damped ones.
NewtonResult newton_rubbing_on(System& system, RubbingForces& forces, const NewtonResult& solved,
                               const NewtonOptions& options, const RubbingLimits& limits,
                               double scale, const NewtonObserver& observer = {});

}  // namespace bight
