#include "solid3d/rubbing.h"

namespace bight::solid3d {

namespace {

/// Iterations with the last state's friction, which bring contact forces into range, and those with
/// the whole tangent, at most; and their tolerances relative to the force scale.
constexpr int few_first = 3, most_coupled = 40;
constexpr double first_tolerance = 1e-2, coupled_tolerance = 5e-7;

NewtonOptions within(NewtonOptions options, int iterations, double tolerance) {
  options.max_iterations = iterations;
  options.force_tolerance = options.energy_tolerance = tolerance;
  return options;
}

}  // namespace

void Rubbing::freeze(const Vector& x) {
  effects_.contact->refresh(x);
  frozen_at_ = x;
  effects_.friction->freeze(x, from());
}

void Rubbing::add_change(const Vector& dx, Vector& gradient) const {
  effects_.friction->add_change(frozen_at_, dx, gradient);
}

NewtonResult newton_rubbing(System& system, Rubbing& rubbing, const Vector& guess,
                            const NewtonOptions& options, double scale,
                            const NewtonObserver& observer) {
  rubbing.freeze(rubbing.from());
  const NewtonResult begun =
      newton(system, guess, within(options, few_first, first_tolerance * scale), observer);
  return newton_rubbing_on(system, rubbing, begun, options, scale, observer);
}

NewtonResult newton_rubbing_on(System& system, Rubbing& rubbing, const NewtonResult& solved,
                               const NewtonOptions& options, double scale,
                               const NewtonObserver& observer) {
  NewtonResult result =
      coupled_newton(system, rubbing, solved.x,
                     within(options, most_coupled, coupled_tolerance * scale), observer);
  result.count_on(solved);
  return result;
}

}  // namespace bight::solid3d
