#include "mechanics/rubbing_newton.h"

#include <utility>

namespace bight {

namespace {

constexpr int most_damped = 30;
/// Of full steps that settle.
constexpr double most_growth = 2;
/// Energy tolerance of the first iterations, relative to the force scale.
constexpr double first_energy_tolerance = 1e-2;

/// One solve after another, each with the iterations of those before counted on.
class Attempts {
 public:
  Attempts(System& system, RubbingForces& forces, const NewtonOptions& options,
           const RubbingLimits& limits, double scale, const NewtonObserver& observer)
      : system_(system),
        forces_(forces),
        options_(options),
        limits_(limits),
        scale_(scale),
        observer_(observer) {}

  /// With the last accepted state's friction.
  bool frozen(const Vector& from, int iterations) {
    forces_.freeze_last();
    return take(newton(system_, from,
                       within(iterations, first_energy_tolerance, limits_.first_force_tolerance),
                       observer_));
  }
  /// With the whole tangent.
  bool coupled(const Vector& from, CoupledSteps steps) {
    return take(coupled_newton(system_, forces_, from,
                               within(steps.damped ? most_damped : limits_.most_full,
                                      limits_.energy_tolerance, limits_.force_tolerance),
                               steps, observer_));
  }
  bool short_damped(const Vector& from) {
    return coupled(from,
                   {.damped = true, .most_growth = 0, .short_step = limits_.short_step * scale_});
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
  NewtonOptions within(int iterations, double energy, double force) const {
    NewtonOptions options = options_;
    options.max_iterations = iterations;
    options.energy_tolerance = energy * scale_;
    options.force_tolerance = force * scale_;
    return options;
  }

  System& system_;
  RubbingForces& forces_;
  const NewtonOptions& options_;
  const RubbingLimits& limits_;
  double scale_;
  const NewtonObserver& observer_;
};

}  // namespace

NewtonResult newton_rubbing(System& system, RubbingForces& forces, const Vector& guess,
                            const NewtonOptions& options, const RubbingLimits& limits, double scale,
                            const NewtonObserver& observer) {
  Attempts attempts(system, forces, options, limits, scale, observer);
  if (attempts.short_damped(guess)) return attempts.result;
  attempts.frozen(guess, limits.few_first);
  const Vector begun = attempts.result.x;
  if (attempts.full_or_damped(begun)) return attempts.result;
  if (attempts.frozen(begun, options.max_iterations))
    attempts.full_or_damped(Vector(attempts.result.x));
  return attempts.result;
}

NewtonResult newton_rubbing_damped(System& system, RubbingForces& forces, const Vector& guess,
                                   const NewtonOptions& options, const RubbingLimits& limits,
                                   double scale, const NewtonObserver& observer) {
  Attempts attempts(system, forces, options, limits, scale, observer);
  attempts.coupled(guess, {.damped = true});
  return attempts.result;
}

NewtonResult newton_rubbing_on(System& system, RubbingForces& forces, const NewtonResult& solved,
                               const NewtonOptions& options, const RubbingLimits& limits,
                               double scale, const NewtonObserver& observer) {
  Attempts attempts(system, forces, options, limits, scale, observer);
  attempts.result = solved;
  attempts.full_or_damped(solved.x);
  return attempts.result;
}

}  // namespace bight
