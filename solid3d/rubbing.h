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
  /// The last accepted state.
  const Vector& from() const { return accepted_.back().x; }

 private:
  const SolidEffects& effects_;
  const std::vector<Station>& accepted_;
  Vector frozen_at_;
};

/// Newton steps with the whole tangent, full ones or else damped ones, after a few with the last
/// state's friction: the contact forces of a guess are too rough to begin with. Where both fail, as
/// many of the first as it takes, and again. `options` is what a frictionless solve would take;
/// tolerances and iterations are replaced by those of friction, relative to the force `scale`
/// [E D^2].
NewtonResult newton_rubbing(System& system, Rubbing& rubbing, const Vector& guess,
                            const NewtonOptions& options, double scale,
                            const NewtonObserver& observer);

/// The same from a solution after something has changed, without the few first ones.
NewtonResult newton_rubbing_on(System& system, Rubbing& rubbing, const NewtonResult& solved,
                               const NewtonOptions& options, double scale,
                               const NewtonObserver& observer);

}  // namespace bight::solid3d
