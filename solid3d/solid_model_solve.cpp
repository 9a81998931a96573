// How equilibrium is found, with contact as stiff as it has to be and friction settled.

#include <algorithm>
#include <cmath>

#include "mechanics/knot_type.h"
#include "solid3d/measure.h"
#include "solid3d/solid_model.h"

namespace bight::solid3d {

namespace {

/// Tolerances of Newton relative to the end tension.
constexpr double force_tolerance = 1e-8;
constexpr double energy_tolerance = 1e-9;
/// Energy rise that the first iteration may take, relative to T D: with more, what a bad step costs
/// is not soon won back.
constexpr double energy_rise = 0.01;
/// The same of a start, relative to its energy: the cells of the sweep are not yet true to volume,
/// and making them so costs energy that the potential of the cells' pressures has not seen.
constexpr double start_rise = 0.1;
constexpr double shift_decay = 0.01;  // good guesses need no slow decay
constexpr int max_iterations = 60, many_iterations = 1000;
/// Contact is stiffened until the overlap is in its bound, at most this often per solve.
constexpr int max_stiffenings = 6;
/// Friction has settled when the end tension changes by less than this part of it.
constexpr double friction_settled = 5e-4;
constexpr int max_friction_passes = 10;

}  // namespace

NewtonResult SolidModel::solve(const Vector& guess, double ebar) {
  // Behind a fold Newton goes downhill, in moves too short for strands to pass each other, to where
  // the knot rests.
  far_ = !relaxing_ && !effects_.friction && !parameters_.inertia &&
         std::abs(ebar - history_.back().ebar) < fold_step;
  NewtonResult result =
      parameters_.inertia && !relaxing_ ? move_to(ebar) : solve_at_rest(guess, ebar);
  if (result.ok() && knot_determinant(centerline(mesh_, result.x)) != determinant_) {
    result.status = NewtonStatus::rejected;
    result.reason = "a strand has passed through another";
  }
  return result;
}

NewtonResult SolidModel::solve_at_rest(const Vector& guess, double ebar) {
  if (relaxing_) return relax(guess);
  system_.shift = unknown_shift;
  start_energy_ = 0;
  const Vector best = best_guess(guess, ebar);
  if (effects_.friction) return solve_with_friction(best);
  // The first guess is not true to volume, as the start was not.
  return history_.size() < 2 ? settle_or_minimise(best) : solve_frictionless(best);
}

NewtonResult SolidModel::solve_frictionless(const Vector& guess) {
  return stiffened(newton(system_, guess, options(), observer_));
}

NewtonResult SolidModel::stiffened(NewtonResult result) {
  for (int i = 0; result.ok() && effects_.contact && i < max_stiffenings; ++i) {
    if (!effects_.contact->stiffen(parameters_.penetration)) break;
    result = go_on(std::move(result));
  }
  return result;
}

NewtonResult SolidModel::solve_rubbing(const Vector& guess) {
  NewtonResult result = rubbing_.solve(system_, guess, options(), tension_, observer_);
  for (int i = 0; result.ok() && i < max_stiffenings; ++i) {
    if (!effects_.contact->stiffen(parameters_.penetration)) break;
    result = rubbing_.solve_on(system_, result, options(), tension_, observer_);
  }
  return result;
}

NewtonResult SolidModel::solve_with_friction(const Vector& guess) {
  NewtonResult result = solve_rubbing(guess);
  if (result.ok() || effects_.friction->prescribes()) return result;
  const NewtonResult tried = std::move(result);
  result = solve_with_friction_frozen(guess);
  result.count_on(tried);
  return result;
}

NewtonResult SolidModel::solve_with_friction_frozen(const Vector& guess) {
  NewtonResult result;
  result.x = newest();
  double tension = 0;
  for (int pass = 0; pass < max_friction_passes; ++pass) {
    rubbing_.freeze(result.x);
    if (pass == 0) {
      result = newton(system_, guess, options(), observer_);
    } else {
      effects_.contact->stiffen(parameters_.penetration);
      result = go_on(std::move(result));
    }
    if (!result.ok()) return result;
    const double last = tension;
    tension = grip_.tension(mesh_, result.x, result.gradient).finish;
    if (pass > 0 && std::abs(tension - last) < friction_settled * std::abs(tension) &&
        effects_.contact->max_penetration() <= parameters_.penetration)
      return result;
  }
  result.status = NewtonStatus::too_many_iterations;
  result.reason = "friction does not settle";
  return result;
}

NewtonOptions SolidModel::options() const {
  NewtonOptions options;
  options.max_iterations = far_ ? many_iterations : max_iterations;
  options.force_tolerance = std::max(force_tolerance * tension_, round_off());
  options.energy_tolerance = energy_tolerance * tension_;
  options.largest_move = parameters_.largest_move;
  options.shift_decay = shift_decay;
  options.bound.first_rise = energy_rise * tension_ + start_rise * start_energy_;
  return options;
}

/// Least out-of-balance force that can be told from zero [E D^2]: strains are differences of
/// positions as far as L0 from the origin, and K turns them into forces on a node.
double SolidModel::round_off() const {
  const double eps = std::numeric_limits<double>::epsilon();
  return 5 * eps * parameters_.material.bulk_modulus() * mesh_.s.back() * mesh_.cell_width();
}

NewtonResult SolidModel::go_on(NewtonResult solved) {
  NewtonResult result = newton(system_, std::move(solved.x), options(), observer_);
  result.count_on(solved);
  return result;
}

}  // namespace bight::solid3d
