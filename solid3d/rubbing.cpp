#include "solid3d/rubbing.h"

namespace bight::solid3d {

namespace {

/// The energy of the last step is the square of what it leaves.
constexpr RubbingLimits limits{.short_step = 1,
                               .few_first = 2,
                               .most_full = 15,
                               .first_force_tolerance = 1e-2,
                               .energy_tolerance = 5e-7,
                               .force_tolerance = 1e-5};

}  // namespace

void Rubbing::freeze(const Vector& x) {
  effects_.contact->refresh(x);
  frozen_at_ = x;
  effects_.friction->freeze(x, accepted_.back().x);
}

void Rubbing::add_change(const Vector& dx, Vector& gradient) const {
  effects_.friction->add_change(frozen_at_, dx, gradient);
}

NewtonResult Rubbing::solve(System& system, const Vector& guess, const NewtonOptions& options,
                            double scale, const NewtonObserver& observer) {
  const auto method = effects_.friction->prescribes() ? newton_rubbing_damped : newton_rubbing;
  return method(system, *this, guess, options, limits, scale, observer);
}

NewtonResult Rubbing::solve_on(System& system, const NewtonResult& solved,
                               const NewtonOptions& options, double scale,
                               const NewtonObserver& observer) {
  return newton_rubbing_on(system, *this, solved, options, limits, scale, observer);
}

}  // namespace bight::solid3d
