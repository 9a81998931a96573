#pragma once

#include <string>
#include <utility>

#include "mechanics/path.h"

namespace bight {

/// Solves and accepts the steps of a path, counts them, and tells the observer.
class PathSteps {
 public:
  PathSteps(PathModel& model, const PathObserver& observer, PathOutcome so_far = {})
      : outcome(std::move(so_far)), model_(model), observer_(observer) {}

  /// An equilibrium, or none: then the step was cut.
  NewtonResult solve(double ebar) {
    NewtonResult result = model_.solve(model_.predict(ebar), ebar);
    outcome.iterations += result.iterations;
    outcome.factorisations += result.factorisations;
    if (!result.ok()) {
      ++cutbacks_, ++outcome.cutbacks;
      cut_reason = result.reason;
    }
    return result;
  }

  /// Takes over the equilibrium that was solved last.
  StepRow accept(const NewtonResult& result, double ebar, double increment) {
    StepRow row = model_.accept(result, ebar);
    row.ebar = ebar;
    row.increment = increment;
    row.newton_iterations = result.iterations;
    row.cutbacks = std::exchange(cutbacks_, 0);
    row.cut_reason = std::exchange(cut_reason, {});
    ++outcome.steps;
    observer_.on_step(row);
    return row;
  }

  PathOutcome stop(PathStatus status, std::string reason) {
    outcome.status = status;
    outcome.reason = std::move(reason);
    return outcome;
  }

  PathOutcome outcome;
  std::string cut_reason;  ///< why the last solve failed; empty when it did not

 private:
  PathModel& model_;
  const PathObserver& observer_;
  int cutbacks_ = 0;
};

/// By how much the step may grow after a solve. A cut is no verdict on the rest of the path: with
/// friction a solve has more iterations than an easy one, and still went well. So a hard step
/// grows, too, unless it had to be cut.
inline double step_growth(int iterations, bool cut) {
  constexpr int easy = 10, bearable = 25;
  return iterations <= easy ? 1.5 : iterations <= bearable || !cut ? 1.2 : 1.0;
}

}  // namespace bight
