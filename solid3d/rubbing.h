#pragma once

#include <vector>

#include "mechanics/coupled_newton.h"
#include "solid3d/effects.h"
#include "solid3d/section_motion.h"

namespace bight::solid3d {

/// The friction of a step while the step is solved: what it depends on (normal forces, facing
/// points and tangents) is frozen at a state, and it slides from the last accepted one.
class Rubbing final : public FollowingForces {
 public:
  /// Both outlive this; `accepted` is not empty when something is frozen.
  Rubbing(const SolidEffects& effects, const std::vector<Station>& accepted)
      : effects_(effects), accepted_(accepted) {}

  void freeze(const Vector& x) override;
  void add_change(const Vector& dx, Vector& gradient) const override;
  const Vector& frozen_at() const { return frozen_at_; }
  /// Tractions are those that were handed to the start.
  bool prescribed() const { return effects_.friction->prescribes(); }
  /// The last accepted state.
  const Vector& from() const { return accepted_.back().x; }

 private:
  const SolidEffects& effects_;
  const std::vector<Station>& accepted_;
  Vector frozen_at_;
};

/// Newton steps with the whole tangent. From a guess whose first step is short, damped ones; they
/// are given up where one is not. Else a few steps with the last state's friction come first: the
/// contact forces of a poor guess are too rough to begin with. Then full ones, then damped ones
/// where these fail; where both fail, as many of the few as it takes, and again. Prescribed
/// tractions of a start store no energy: damped steps alone. `options` is what a frictionless solve
/// would take; tolerances and iterations are replaced by those of friction, relative to the force
/// `scale` [E D^2].
NewtonResult newton_rubbing(System& system, Rubbing& rubbing, const Vector& guess,
                            const NewtonOptions& options, double scale,
                            const NewtonObserver& observer);

/// The same from a solution after something has changed: full steps, then damped ones.
NewtonResult newton_rubbing_on(System& system, Rubbing& rubbing, const NewtonResult& solved,
                               const NewtonOptions& options, double scale,
                               const NewtonObserver& observer);

}  // namespace bight::solid3d
