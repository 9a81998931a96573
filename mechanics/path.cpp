#include "mechanics/path.h"

#include <algorithm>
#include <cmath>

#include "mechanics/path_steps.h"

namespace bight {

namespace {

constexpr double same_ebar = 1e-9;

/// Where the path must land between two waypoints: record values on the way, then the waypoint.
std::vector<double> stops(const Path& path, double from, double to) {
  std::vector<double> list;
  for (double r : path.record)
    if ((r - from) * (r - to) < 0 && std::abs(r - from) > same_ebar && std::abs(r - to) > same_ebar)
      list.push_back(r);
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  if (to < from) std::reverse(list.begin(), list.end());
  list.push_back(to);
  return list;
}

bool recorded(const Path& path, double ebar) {
  return std::any_of(path.record.begin(), path.record.end(),
                     [&](double r) { return std::abs(r - ebar) <= same_ebar; });
}

}  // namespace

PathOutcome follow(const Path& path, PathModel& model, const PathObserver& observer,
                   const PathProgress& from) {
  PathSteps steps(model, observer, from.so_far);
  // By how much the next step may be longer; 0 where there is no equilibrium.
  const auto try_step = [&](double ebar, double increment) {
    const NewtonResult result = steps.solve(ebar);
    if (!result.ok()) return 0.0;
    const StepRow row = steps.accept(result, ebar, increment);
    if (recorded(path, ebar)) observer.on_record(ebar);
    return step_growth(row.newton_iterations, row.cutbacks > 0);
  };

  const bool begun = from.leg > 0;
  double ebar = begun ? from.ebar : path.waypoints.front();
  if (!begun && try_step(ebar, 0) == 0)
    return steps.stop(PathStatus::gave_up, "no equilibrium at the first ebar: " + steps.cut_reason);

  double step = begun ? from.step : path.max_step;
  for (size_t w = begun ? from.leg : 1; w < path.waypoints.size(); ++w)
    for (const double stop : stops(path, ebar, path.waypoints[w]))
      while (std::abs(stop - ebar) > same_ebar) {
        if (observer.interrupted()) return steps.stop(PathStatus::interrupted, "interrupted");
        // Equal steps up to the stop, none longer than `step`.
        const double count = std::ceil(std::abs(stop - ebar) / step - same_ebar);
        const double increment = (stop - ebar) / std::max(1.0, count);
        const double target = count <= 1 ? stop : ebar + increment;
        const double growth = try_step(target, increment);
        if (growth == 0) {
          step = 0.5 * std::abs(increment);
          if (step < path.min_step)
            return steps.stop(PathStatus::gave_up, "the step became smaller than " +
                                                       std::to_string(path.min_step) + ": " +
                                                       steps.cut_reason);
          continue;
        }
        ebar = target;
        step = std::min(path.max_step, growth * step);
        observer.on_progress({w, ebar, step, steps.outcome});
      }
  return steps.outcome;
}

}  // namespace bight
