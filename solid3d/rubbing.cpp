#include "solid3d/rubbing.h"

namespace bight::solid3d {

namespace {

/// Iterations with the last state's friction, which bring contact forces into range; with the whole
/// tangent, at most: mostly they are 4.
constexpr int few_first = 3, most_full = 15, most_damped = 30;
/// Of full steps that settle.
constexpr double most_growth = 2;
/// Relative to the force scale. The energy of the last step is the square of what it leaves.
constexpr double first_tolerance = 1e-2, energy_tolerance = 5e-7, force_tolerance = 1e-5;

NewtonOptions within(NewtonOptions options, int iterations, double energy, double force) {
  options.max_iterations = iterations;
  options.energy_tolerance = energy;
  options.force_tolerance = force;
  return options;
}

/// From `begun` on, counting its iterations: full steps, then damped ones where these fail.
NewtonResult coupled(System& system, Rubbing& rubbing, const NewtonResult& begun,
                     const NewtonOptions& options, double scale, const NewtonObserver& observer) {
  NewtonResult result = begun;
  for (const bool damped : {false, true}) {
    const CoupledSteps steps = damped ? CoupledSteps{true} : CoupledSteps{false, most_growth};
    const int most = damped ? most_damped : most_full;
    NewtonResult next = coupled_newton(
        system, rubbing, begun.x,
        within(options, most, energy_tolerance * scale, force_tolerance * scale), steps, observer);
    next.count_on(result);
    result = std::move(next);
    if (result.ok()) break;
  }
  return result;
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
  const double tolerance = first_tolerance * scale;
  const auto as_before = [&](const Vector& x, int iterations) {
    rubbing.freeze(rubbing.from());
    return newton(system, x, within(options, iterations, tolerance, tolerance), observer);
  };
  const NewtonResult begun = as_before(guess, few_first);
  const NewtonResult result = coupled(system, rubbing, begun, options, scale, observer);
  if (result.ok()) return result;
  NewtonResult nearer = as_before(begun.x, options.max_iterations);
  nearer.count_on(result);
  if (!nearer.ok()) return nearer;
  return coupled(system, rubbing, nearer, options, scale, observer);
}

NewtonResult newton_rubbing_on(System& system, Rubbing& rubbing, const NewtonResult& solved,
                               const NewtonOptions& options, double scale,
                               const NewtonObserver& observer) {
  return coupled(system, rubbing, solved, options, scale, observer);
}

}  // namespace bight::solid3d
