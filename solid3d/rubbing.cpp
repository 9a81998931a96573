#include "solid3d/rubbing.h"

namespace bight::solid3d {

namespace {

/// Iterations with the last state's friction, which bring contact forces into range; with the whole
/// tangent, at most: mostly they are 4.
constexpr int few_first = 3, most_full = 15, most_damped = 30;
/// Of full steps that settle.
constexpr double most_growth = 2;
/// Relative to the force scale: decrement of a short step, tolerances of the first iterations and
/// of the last ones. The energy of the last step is the square of what it leaves.
constexpr double short_step = 5e-2, first_tolerance = 1e-2, energy_tolerance = 5e-7,
                 force_tolerance = 1e-5;

NewtonOptions within(NewtonOptions options, int iterations, double energy, double force) {
  options.max_iterations = iterations;
  options.energy_tolerance = energy;
  options.force_tolerance = force;
  return options;
}

/// One solve after another, each with the iterations of those before counted on.
class Attempts {
 public:
  Attempts(System& system, Rubbing& rubbing, const NewtonOptions& options, double scale,
           const NewtonObserver& observer)
      : system_(system), rubbing_(rubbing), options_(options), scale_(scale), observer_(observer) {}

  /// With the last accepted state's friction.
  bool frozen(const Vector& from, int iterations) {
    rubbing_.freeze(rubbing_.from());
    const double tolerance = first_tolerance * scale_;
    return take(
        newton(system_, from, within(options_, iterations, tolerance, tolerance), observer_));
  }
  /// With the whole tangent.
  bool coupled(const Vector& from, CoupledSteps steps) {
    return take(coupled_newton(system_, rubbing_, from,
                               within(options_, steps.damped ? most_damped : most_full,
                                      energy_tolerance * scale_, force_tolerance * scale_),
                               steps, observer_));
  }
  bool full_or_damped(const Vector& from) {
    return coupled(from, {.most_growth = most_growth}) || coupled(from, {.damped = true});
  }

  NewtonResult result;  ///< of the last one

 private:
  bool take(NewtonResult next) {
    next.count_on(result);
    result = std::move(next);
    return result.ok();
  }

  System& system_;
  Rubbing& rubbing_;
  const NewtonOptions& options_;
  double scale_;
  const NewtonObserver& observer_;
};

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
  Attempts attempts(system, rubbing, options, scale, observer);
  if (rubbing.prescribed()) {
    attempts.coupled(guess, {.damped = true});
    return attempts.result;
  }
  if (attempts.coupled(guess, {.damped = true, .most_growth = 0, .short_step = short_step * scale}))
    return attempts.result;
  attempts.frozen(guess, few_first);
  const Vector begun = attempts.result.x;
  if (attempts.full_or_damped(begun)) return attempts.result;
  if (attempts.frozen(begun, options.max_iterations))
    attempts.full_or_damped(Vector(attempts.result.x));
  return attempts.result;
}

NewtonResult newton_rubbing_on(System& system, Rubbing& rubbing, const NewtonResult& solved,
                               const NewtonOptions& options, double scale,
                               const NewtonObserver& observer) {
  Attempts attempts(system, rubbing, options, scale, observer);
  attempts.result = solved;
  attempts.full_or_damped(solved.x);
  return attempts.result;
}

}  // namespace bight::solid3d
