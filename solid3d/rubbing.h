#pragma once

#include <vector>

#include "mechanics/rubbing_newton.h"
#include "solid3d/effects.h"
#include "solid3d/section_motion.h"

namespace bight::solid3d {

/// The friction of a step while the step is solved: what it depends on (normal forces, facing
/// points and tangents) is frozen at a state, and it slides from the last accepted one.
class Rubbing final : public RubbingForces {
 public:
  /// Both outlive this; `accepted` is not empty when something is frozen.
  Rubbing(const SolidEffects& effects, const std::vector<Station>& accepted)
      : effects_(effects), accepted_(accepted) {}

  void freeze(const Vector& x) override;
  void freeze_last() override { freeze(accepted_.back().x); }
  void add_change(const Vector& dx, Vector& gradient) const override;
  const Vector& frozen_at() const { return frozen_at_; }

  /// newton_rubbing() as solids take it; tractions prescribed at a start store no energy, and get
  /// damped steps alone.
  NewtonResult solve(System& system, const Vector& guess, const NewtonOptions& options,
                     double scale, const NewtonObserver& observer);
  /// The same from a solution after something has changed.
  NewtonResult solve_on(System& system, const NewtonResult& solved, const NewtonOptions& options,
                        double scale, const NewtonObserver& observer);

 private:
  const SolidEffects& effects_;
  const std::vector<Station>& accepted_;
  Vector frozen_at_;
};

}  // namespace bight::solid3d
