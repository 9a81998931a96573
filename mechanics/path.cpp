#include "mechanics/path.h"

#include <algorithm>
#include <cmath>

namespace bight {

namespace {

constexpr int easy_iterations = 10;  ///< a solve with fewer lets the step grow
constexpr double growth = 1.5;
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
  PathOutcome outcome = from.so_far;
  const auto give_up = [&](PathStatus status, std::string reason) {
    outcome.status = status;
    outcome.reason = std::move(reason);
    return outcome;
  };
  int cutbacks = 0;
  std::string cut_reason;
  const auto try_step = [&](double ebar, double increment) {
    const NewtonResult result = model.solve(model.predict(ebar), ebar);
    outcome.iterations += result.iterations;
    outcome.factorisations += result.factorisations;
    if (!result.ok()) {
      ++cutbacks, ++outcome.cutbacks;
      cut_reason = result.reason;
      return -1;
    }
    StepRow row = model.accept(result, ebar);
    row.ebar = ebar;
    row.increment = increment;
    row.newton_iterations = result.iterations;
    row.cutbacks = cutbacks;
    row.cut_reason = cut_reason;
    cutbacks = 0;
    cut_reason.clear();
    ++outcome.steps;
    observer.on_step(row);
    if (recorded(path, ebar)) observer.on_record(ebar);
    return result.iterations;
  };

  const bool begun = from.leg > 0;
  double ebar = begun ? from.ebar : path.waypoints.front();
  if (!begun && try_step(ebar, 0) < 0)
    return give_up(PathStatus::gave_up, "no equilibrium at the first ebar: " + cut_reason);

  double step = begun ? from.step : path.max_step;
  for (size_t w = begun ? from.leg : 1; w < path.waypoints.size(); ++w)
    for (const double stop : stops(path, ebar, path.waypoints[w]))
      while (std::abs(stop - ebar) > same_ebar) {
        if (observer.interrupted()) return give_up(PathStatus::interrupted, "interrupted");
        // Equal steps up to the stop, none longer than `step`.
        const double count = std::ceil(std::abs(stop - ebar) / step - same_ebar);
        const double increment = (stop - ebar) / std::max(1.0, count);
        const double target = count <= 1 ? stop : ebar + increment;
        const int iterations = try_step(target, increment);
        if (iterations < 0) {
          step = 0.5 * std::abs(increment);
          if (step < path.min_step)
            return give_up(PathStatus::gave_up, "the step became smaller than " +
                                                    std::to_string(path.min_step) + ": " +
                                                    cut_reason);
          continue;
        }
        ebar = target;
        if (iterations <= easy_iterations) step = std::min(path.max_step, growth * step);
        observer.on_progress({w, ebar, step, outcome});
      }
  return outcome;
}

}  // namespace bight
