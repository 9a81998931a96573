#include "mechanics/force_path.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "mechanics/path_steps.h"

namespace bight {

namespace {

constexpr double force_tolerance = 1e-4;  ///< relative to the force
constexpr int most_trials = 40;

/// Zero of a function between a and b, where it has the values fa and fb of opposite signs: false
/// position, with the value at an end that stays halved (Dowell and Jarratt 1971, "Illinois").
class Bracket {
 public:
  Bracket(double a, double fa, double b, double fb) : a_(a), fa_(fa), b_(b), fb_(fb) {}
  double guess() const { return a_ - fa_ * (b_ - a_) / (fb_ - fa_); }
  double width() const { return std::abs(b_ - a_); }
  void put(double c, double fc) {
    const bool replaces_b = fc * fb_ > 0;
    (replaces_b ? b_ : a_) = c;
    (replaces_b ? fb_ : fa_) = fc;
    if (replaced_b_ == (replaces_b ? 1 : 0)) (replaces_b ? fa_ : fb_) *= 0.5;
    replaced_b_ = replaces_b ? 1 : 0;
  }

 private:
  double a_, fa_, b_, fb_;
  int replaced_b_ = -1;
};

std::string in_words(const char* what, double force, double ebar) {
  std::ostringstream text;
  text << what << " (force " << force << " E D^2, ebar " << ebar << ")";
  return text.str();
}

}  // namespace

PathOutcome follow_forces(const ForcePath& path, ForceModel& model, const PathObserver& observer) {
  PathSteps steps(model, observer);
  double ebar = path.first_ebar;
  const NewtonResult first = steps.solve(ebar);
  if (!first.ok())
    return steps.stop(PathStatus::gave_up, "no equilibrium at the first ebar: " + steps.cut_reason);
  double tension = steps.accept(first, ebar, 0).tension;

  double step = path.max_step;
  for (const double force : path.forces) {
    const auto beyond = [&](double t) { return t / force - 1; };
    const double direction = tension < force ? -1 : 1;
    while (std::abs(beyond(tension)) > force_tolerance) {
      if (observer.interrupted()) return steps.stop(PathStatus::interrupted, "interrupted");
      const double limit = direction < 0 ? path.lowest_ebar : path.highest_ebar;
      double target = ebar + direction * std::min(step, std::abs(limit - ebar));
      if (std::abs(target - ebar) < path.min_step)
        return steps.stop(PathStatus::gave_up,
                          in_words("the knot does not take this force", force, ebar));
      NewtonResult result = steps.solve(target);
      double t = result.ok() ? model.tension(result) : 0;
      if (result.ok() && beyond(t) * direction < -force_tolerance) {
        Bracket bracket(ebar, beyond(tension), target, beyond(t));
        for (int k = 0; k < most_trials && bracket.width() > 1e-3 * path.min_step; ++k) {
          target = bracket.guess();
          result = steps.solve(target);
          if (!result.ok()) break;
          t = model.tension(result);
          if (std::abs(beyond(t)) <= force_tolerance) break;
          bracket.put(target, beyond(t));
        }
        if (result.ok() && std::abs(beyond(t)) > force_tolerance)
          return steps.stop(PathStatus::gave_up,
                            in_words("the force jumps over this one", force, target));
      }
      if (!result.ok()) {
        step = 0.5 * std::abs(target - ebar);
        if (step < path.min_step)
          return steps.stop(
              PathStatus::gave_up,
              in_words("the step became too small", force, ebar) + ": " + steps.cut_reason);
        continue;
      }
      const StepRow row = steps.accept(result, target, target - ebar);
      tension = row.tension;
      ebar = target;
      step = std::min(path.max_step, step_growth(row.newton_iterations, row.cutbacks > 0) * step);
    }
    observer.on_record(ebar);
  }
  return steps.outcome;
}

}  // namespace bight
