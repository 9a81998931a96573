#include "rod1d/run_rod.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "rod1d/one_thread.h"
#include "rod1d/overhand.h"
#include "rod1d/rod_model.h"

namespace bight::rod1d {

namespace {

double seconds_since(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

void check(const RodParameters& parameters) {
  if (parameters.friction < 0) throw std::invalid_argument("the friction coefficient is negative");
  if (parameters.friction > 0 && !(parameters.twist && parameters.contact))
    throw std::invalid_argument("friction needs the effects contact and twist");
  if (!parameters.finish_turns && !parameters.twist)
    throw std::invalid_argument("a finish end that may not turn needs the effect twist");
  if (parameters.finish_turns && parameters.finish_turn != 0)
    throw std::invalid_argument("only a clamped finish end can be turned");
  if (parameters.segments < 5) throw std::invalid_argument("a rod needs at least 5 segments");
  if (parameters.path.waypoints.empty()) throw std::invalid_argument("the path has no waypoint");
}

Polyline start_of(const RodParameters& parameters) {
  if (!parameters.start.empty()) return parameters.start;
  return overhand_start(parameters.length,
                        std::max(parameters.path.waypoints.front(), loosest_overhand),
                        std::max(parameters.segments, static_cast<int>(10 * parameters.length)));
}

/// Slack that is pulled through a knot with friction before the path begins, so that friction acts
/// everywhere against the path's direction from its first state on [D].
constexpr double mobilising = 2;

/// Where the path is entered from: the first waypoint, or with friction from a little before it.
double approach(const RodParameters& parameters) {
  const std::vector<double>& waypoints = parameters.path.waypoints;
  const double first = waypoints.front();
  if (parameters.friction == 0) return first;
  const bool loosens = waypoints.size() > 1 && waypoints[1] > first;
  return loosens ? first - mobilising : first + mobilising;
}

/// From the start's own ebar to the first waypoint.
PathOutcome tie(RodModel& model, const RodParameters& parameters, const RodObserver& observer) {
  Path path = parameters.path;
  path.waypoints = {model.start_ebar(), approach(parameters)};
  path.record.clear();
  PathObserver silent;
  silent.interrupted = observer.interrupted;
  PathOutcome outcome = follow(path, model, silent);
  if (parameters.friction > 0 && outcome.status == PathStatus::finished) {
    model.let_rub();
    path.waypoints = {approach(parameters), parameters.path.waypoints.front()};
    outcome = follow(path, model, silent);
  }
  if (outcome.status != PathStatus::finished) return outcome;
  // The finish may turn while the knot is tied, so that the rod is free of twist when it is
  // clamped.
  model.set_tied();
  path.waypoints = {parameters.path.waypoints.front()};
  const int parts = static_cast<int>(std::ceil(std::abs(parameters.finish_turn) / 0.5));
  for (int k = 0; k < parts && outcome.status == PathStatus::finished; ++k) {
    model.turn_finish(parameters.finish_turn / parts);
    outcome = follow(path, model, silent);
  }
  return outcome;
}

}  // namespace

RodResult run_rod(const RodParameters& parameters, const RodObserver& observer) {
  check(parameters);
  const OneThread one_thread;
  RodResult result;
  const auto began = std::chrono::steady_clock::now();
  RodModel model(parameters, start_of(parameters));
  result.unknowns = model.unknowns();
  result.effects = model.effect_names();
  result.outcome = tie(model, parameters, observer);
  result.seconds["tie"] = seconds_since(began);
  if (result.outcome.status != PathStatus::finished) return result;

  const auto tied = std::chrono::steady_clock::now();
  PathObserver path_observer;
  path_observer.interrupted = observer.interrupted;
  path_observer.on_step = [&](const StepRow& row) {
    result.steps.push_back(row);
    observer.on_step(row);
  };
  path_observer.on_record = [&](double) {
    result.states.push_back(model.state());
    observer.on_record(result.states.back());
  };
  result.outcome = follow(parameters.path, model, path_observer);
  result.seconds["path"] = seconds_since(tied);
  for (const auto& [phase, seconds] : model.seconds()) result.seconds[phase] = seconds;
  return result;
}

}  // namespace bight::rod1d
