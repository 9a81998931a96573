#include "mechanics/coupled_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/gmres.h"
#include "mechanics/newton_direction.h"
#include "mechanics/timed.h"

namespace bight {

namespace {

/// Of GMRES: products with the tangent, and the part of the right hand side that may be left.
constexpr int most_products = 12;
constexpr double linear_tolerance = 1e-3;
/// Decrements below this many tolerances are those of steps that need no search.
constexpr double small_step = 100;
/// Growth of the residual over its least value that ends an attempt with full steps.
constexpr double lost = 1e3;
/// Times that a damped step is halved until the level falls, at most.
constexpr int most_halvings = 2;

/// The first fraction, halved from the longest one, that lowers the level as it should, or else the
/// one of least level; 0 where none is admissible.
template <class LevelAt>
double damped_fraction(double longest, double level, LevelAt&& level_at) {
  double best = 0, least = inadmissible, part = longest;
  for (int halvings = 0; halvings <= most_halvings; ++halvings, part *= 0.5) {
    const double there = level_at(part), falls = 1 - 0.25 * part;
    if (there < least) best = part, least = there;
    if (there <= falls * falls * level) break;
  }
  return best;
}

}  // namespace

NewtonResult coupled_newton(System& system, FollowingForces& forces, Vector x,
                            const NewtonOptions& options, CoupledSteps steps,
                            const NewtonObserver& observer) {
  Assembler& assembler = system.assembler;
  const Unknowns& unknowns = assembler.unknowns();
  NewtonResult result;
  auto finish = [&](NewtonStatus status, std::string reason) {
    result.status = status;
    result.reason = std::move(reason);
    result.x = std::move(x);
    return result;
  };
  // The frozen energy is what keeps a wild full step in bounds; near the solution it may rise.
  const auto energy_at = [&](const Vector& trial) {
    assembler.refresh(trial);
    const double energy = assembler.energy(trial);
    return std::isfinite(energy) ? energy : inadmissible;
  };
  const auto freeze = [&](const Vector& at) {
    const Timed timed(system.seconds["pairs"]);
    forces.freeze(at);
  };
  const auto level_at = [&](const Vector& trial) {
    Vector gradient;
    freeze(trial);
    if (!std::isfinite(evaluate(system, trial, Order::gradient, gradient))) return inadmissible;
    const Vector r = unknowns.reduce(trial, gradient);
    return r.allFinite() ? r.dot(solved(system, r)) : inadmissible;
  };
  double first_decrement = 0, least = std::numeric_limits<double>::infinity();
  for (;; ++result.iterations) {
    freeze(x);
    result.energy = evaluate(system, x, Order::hessian, result.gradient);
    const Vector g = unknowns.reduce(x, result.gradient);
    if (!std::isfinite(result.energy) || !g.allFinite())
      return finish(NewtonStatus::not_finite, "the residual is not finite");
    result.residual = g.size() ? g.cwiseAbs().maxCoeff() : 0.0;
    if (result.iterations > 0 && result.residual <= options.force_tolerance &&
        result.decrement <= options.energy_tolerance)
      return finish(NewtonStatus::converged, "");
    if (!steps.damped && result.residual > lost * least)
      return finish(NewtonStatus::stalled, "the residual grows");
    least = std::min(least, result.residual);
    if (result.iterations >= options.max_iterations)
      return finish(NewtonStatus::too_many_iterations, "too many iterations");

    Vector step;
    if (!newton_direction(system, g, options, result, step))
      return finish(NewtonStatus::no_descent, "no shift makes the tangent positive definite");
    const double level = -g.dot(step);
    step = gmres(
        [&](const Vector& v) {
          Vector change = Vector::Zero(x.size());
          {
            const Timed timed(system.seconds["assembly"]);
            forces.add_change(unknowns.expand(x, v), change);
          }
          return Vector(v + solved(system, unknowns.reduce(x, change)));
        },
        step, most_products, linear_tolerance);
    if (!step.allFinite()) return finish(NewtonStatus::not_finite, "the step is not finite");
    result.decrement = std::abs(g.dot(step));
    if (result.iterations == 0) first_decrement = result.decrement;
    if (result.decrement > std::max(steps.short_step, steps.most_growth * first_decrement))
      return finish(NewtonStatus::stalled, "the steps grow");

    const auto [dx, longest] = move_by(system, x, step, options.largest_move);
    const auto tell = [&](double fraction) {
      if (observer)
        observer({result.iterations, result.energy, result.residual, result.decrement, fraction,
                  system.shift});
    };
    if (longest == 1 && result.decrement <= small_step * options.energy_tolerance) {
      tell(1);
      x = moved(system, std::move(x), dx);
      continue;
    }
    const auto at = [&](double fraction) { return moved(system, x, fraction * dx); };
    const double fraction =
        steps.damped
            ? damped_fraction(longest, level, [&](double part) { return level_at(at(part)); })
            : search([&](double part) { return energy_at(at(part)); }, result.energy,
                     options.bound.allowed(result.iterations) + 2 * result.decrement, longest)
                  .step;
    tell(fraction);
    if (fraction == 0) return finish(NewtonStatus::stalled, "no step is admissible");
    x = at(fraction);
  }
}

}  // namespace bight
