#include "mechanics/newton.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanics/newton_direction.h"
#include "mechanics/timed.h"

namespace bight {

namespace {

/// Part of an energy that is lost in the round-off of its sum.
constexpr double round_off = 10 * std::numeric_limits<double>::epsilon();

}  // namespace

double evaluate(System& system, const Vector& x, Order order, Vector& gradient) {
  {
    const Timed timed(system.seconds["pairs"]);
    system.assembler.refresh(x);
  }
  const Timed timed(system.seconds["assembly"]);
  return system.assembler.assemble(x, order, gradient);
}

Vector solved(System& system, const Vector& r) {
  const Timed timed(system.seconds["solve"]);
  return system.cholesky.solve(r);
}

bool newton_direction(System& system, const Vector& g, const NewtonOptions& options,
                      NewtonResult& result, Vector& step) {
  const SymmetricMatrix& H = system.assembler.hessian();
  if (system.analysed_pattern != system.assembler.pattern_version()) {
    const Timed timed(system.seconds["analysis"]);
    system.cholesky.analyse(H, system.ordering);
    system.analysed_pattern = system.assembler.pattern_version();
  }
  double largest = 0;
  for (int j = 0; j < H.size(); ++j) largest = std::max(largest, std::abs(H.value[H.diagonal(j)]));
  const double first = std::clamp(0.1 * g.cwiseAbs().maxCoeff() / options.largest_move,
                                  1e-11 * largest, 1e-4 * largest);
  double shift = std::min(options.shift_decay * system.shift, first);
  if (shift < 1e-10 * largest) shift = 0;
  for (; shift <= 100 * largest; shift = std::max(first, 10 * shift)) {
    ++result.factorisations;
    {
      const Timed timed(system.seconds["factorisation"]);
      if (!system.cholesky.factor(H, shift)) continue;
    }
    system.shift = shift;
    step = -solved(system, g);
    return step.allFinite();
  }
  return false;
}

Move move_by(System& system, const Vector& x, const Vector& step, double largest_move) {
  const Timed timed(system.seconds["update"]);
  const Assembler& assembler = system.assembler;
  const Unknowns& unknowns = assembler.unknowns();
  Move move{unknowns.expand(x, step)};
  for (const auto& effect : assembler.effects()) effect->recover(x, move.dx);
  const auto moved = move.dx.head(unknowns.coordinates());
  move.longest = std::min(1.0, largest_move / moved.cwiseAbs().maxCoeff());
  for (const auto& effect : assembler.effects())
    move.longest = std::min(move.longest, effect->longest_step(x, move.dx));
  return move;
}

Vector moved(System& system, Vector x, const Vector& dx) {
  const Timed timed(system.seconds["update"]);
  system.advance(x, dx);
  return x;
}

bool stable(Assembler& assembler, const Vector& x) {
  Vector gradient;
  assembler.refresh(x);
  assembler.assemble(x, Order::hessian, gradient);
  SparseCholesky cholesky;
  cholesky.analyse(assembler.hessian(), Ordering::minimum_degree);
  return cholesky.factor(assembler.hessian());
}

NewtonResult newton(System& system, Vector x, const NewtonOptions& options,
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

  result.energy = evaluate(system, x, Order::hessian, result.gradient);
  if (!std::isfinite(result.energy))
    return finish(NewtonStatus::not_finite, "the first guess is inadmissible");

  bool full_step = false;
  for (;; ++result.iterations) {
    const Vector g = unknowns.reduce(x, result.gradient);
    if (!g.allFinite()) return finish(NewtonStatus::not_finite, "the residual is not finite");
    result.residual = g.size() ? g.cwiseAbs().maxCoeff() : 0.0;
    // After a full step the next decrement is about the square of the last one.
    if (full_step && result.residual <= options.force_tolerance &&
        result.decrement <= 1e3 * options.energy_tolerance)
      return finish(NewtonStatus::converged, "");
    if (result.iterations >= options.max_iterations)
      return finish(NewtonStatus::too_many_iterations, "too many iterations");

    Vector step;
    if (!newton_direction(system, g, options, result, step))
      return finish(NewtonStatus::no_descent, "no shift makes the tangent positive definite");
    result.decrement = -g.dot(step);
    if (result.decrement <= options.energy_tolerance && result.residual <= options.force_tolerance)
      return finish(NewtonStatus::converged, "");

    const auto [dx, longest] = move_by(system, x, step, options.largest_move);

    // The first trial is nearly always taken, so it is evaluated with its tangent.
    Vector trial, trial_gradient;
    bool first = true;
    const auto energy_at = [&](double fraction) {
      trial = moved(system, x, fraction * dx);
      const double energy =
          evaluate(system, trial, first ? Order::hessian : Order::energy, trial_gradient);
      first = false;
      return std::isfinite(energy) ? energy : inadmissible;
    };
    // What a step gains may be less than can be told from two energies: then it is not searched.
    const double rise = result.decrement <= round_off * std::abs(result.energy)
                            ? std::numeric_limits<double>::max()
                            : options.bound.allowed(result.iterations);
    const LineSearchResult found = search(energy_at, result.energy, rise, longest);
    if (observer)
      observer({result.iterations, result.energy, result.residual, result.decrement, found.step,
                system.shift});
    if (found.step == 0) {
      assembler.refresh(x);
      return finish(NewtonStatus::stalled, "no step lowers the energy");
    }
    if (found.evaluations > 1) evaluate(system, trial, Order::hessian, trial_gradient);
    x = std::move(trial);
    result.gradient = std::move(trial_gradient);
    result.energy = found.energy;
    full_step = found.step == 1.0 && system.shift == 0;
  }
}

}  // namespace bight
