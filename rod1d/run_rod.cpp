#include "rod1d/run_rod.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "mechanics/knot_type.h"
#include "rod1d/knots.h"
#include "rod1d/one_thread.h"
#include "rod1d/polyline.h"
#include "rod1d/rod_model.h"
#include "rod1d/tie.h"
#include "rod1d/timed_rod.h"

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
  if ((parameters.natural_curvature != 0 || parameters.natural_twist != 0) && !parameters.twist)
    throw std::invalid_argument("natural curvature and twist need the effect twist");
  if (parameters.damping > 0 && !parameters.inertia)
    throw std::invalid_argument("damping needs the effect inertia");
  if (!(parameters.stretch_stiffness_factor >= 1))
    throw std::invalid_argument("a rod cannot be softer in stretch than its section");
  if (parameters.segments < 5) throw std::invalid_argument("a rod needs at least 5 segments");
  if (parameters.path.waypoints.empty() == parameters.forces.empty())
    throw std::invalid_argument("the path needs waypoints, of ebar or of the force");
  if (!parameters.forces.empty() && parameters.inertia)
    throw std::invalid_argument("a prescribed force is met by equilibria, without inertia");
  for (const double force : parameters.forces)
    if (!(force > 0)) throw std::invalid_argument("a knot is pulled by a force above zero");
}

constexpr double start_points = 10;  ///< of a start, per diameter
constexpr double start_step = 0.02;  ///< on the way from the start to the path, part of its ebar
/// Of a longer rod, beside its loose knot: no loop can slip over an end [D].
constexpr double spare_tails = 45;
constexpr int spare_segments = 340;   ///< of a longer rod
constexpr double shortest_reach = 4;  ///< end to end, in which a rod may be tied at all [D]

/// The middle part of a rod, of that undeformed length.
Polyline cut_to(const RodState& state, double length) {
  const double total = state.s.back(), low = 0.5 * (total - length), high = total - low;
  const auto at = [&](double s) {
    const size_t k = static_cast<size_t>(std::upper_bound(state.s.begin(), state.s.end() - 1, s) -
                                         state.s.begin());
    const double u = (s - state.s[k - 1]) / (state.s[k] - state.s[k - 1]);
    return Vector3((1 - u) * state.nodes[k - 1] + u * state.nodes[k]);
  };
  Polyline line{at(low)};
  for (size_t i = 0; i < state.s.size(); ++i)
    if (state.s[i] > low && state.s[i] < high) line.push_back(state.nodes[i]);
  line.push_back(at(high));
  return line;
}

/// The knot at about that ebar, laid out loosely or tied by moves of a straight rod.
struct KnotStart {
  const RodParameters& parameters;
  const RodObserver& observer;
  const Knot& knot = find_knot(parameters.knot);

  /// The ebar at which a path can begin, nearest to `ebar`.
  double nearest(double ebar) const {
    return parameters.from_straight ? std::clamp(ebar, tightest_tie, loosest_tie)
                                    : std::max(ebar, knot.loosest);
  }
  /// Throws std::invalid_argument for a rod that is too short.
  Polyline line(double length, double ebar) const {
    const int points = std::max(parameters.segments, static_cast<int>(start_points * length));
    if (!parameters.from_straight) return knot.loose(length, ebar, points);
    const Polyline line =
        tied(tie_protocol(parameters.knot), length, ebar,
             [&](std::string_view, const RodState& state) { observer.on_tie(state); });
    if (knot_determinant(line) != knot.determinant)
      throw std::runtime_error("the straight rod was tied to another knot than " +
                               std::string(knot.name));
    return resampled(line, points);
  }
};

/// A start for a rod that is too short to be tied loosely: a longer one is tied and pulled, then
/// its tails are cut.
Polyline cut_from_longer(const RodParameters& parameters, const KnotStart& start) {
  const double ebar = parameters.path.waypoints.front(), first = start.nearest(ebar);
  RodParameters longer;
  longer.length = std::max(parameters.length, first + spare_tails);
  longer.poissons_ratio = parameters.poissons_ratio;
  longer.knot = parameters.knot;
  longer.segments = spare_segments;
  longer.path.waypoints = {first, ebar};
  longer.path.max_step = 1;
  RodModel model(longer, start.line(longer.length, first));
  PathObserver silent;
  silent.interrupted = start.observer.interrupted;
  const PathOutcome outcome = follow(longer.path, model, silent);
  if (outcome.status != PathStatus::finished)
    throw std::runtime_error("the knot could not be pulled to ebar " + std::to_string(ebar) +
                             " on a longer rod: " + outcome.reason);
  return cut_to(model.state(), parameters.length);
}

Polyline start_of(const RodParameters& parameters, const RodObserver& observer) {
  if (!parameters.start.empty()) return parameters.start;
  const KnotStart start{parameters, observer};
  const double first = parameters.path.waypoints.front(), length = parameters.length;
  try {
    return start.line(length, start.nearest(first));
  } catch (const std::invalid_argument&) {
    if (length - first < shortest_reach) throw;
  }
  return cut_from_longer(parameters, start);
}

/// Slack that is pulled through a knot with friction before the path begins, so that friction acts
/// everywhere against the path's direction from its first state on [D].
constexpr double mobilising = 2;

/// Where the path is entered from: the first waypoint, or with friction from a little before it, as
/// far as a short rod has room for its knot there.
double approach(const RodParameters& parameters) {
  const std::vector<double>& waypoints = parameters.path.waypoints;
  const double first = waypoints.front();
  if (parameters.friction == 0) return first;
  const bool loosens = waypoints.size() > 1 && waypoints[1] > first;
  if (loosens) return first - mobilising;
  return std::clamp(parameters.length - shortest_reach, first, first + mobilising);
}

/// From the start's own ebar to the first waypoint.
PathOutcome tie(RodModel& model, const RodParameters& parameters, const RodObserver& observer) {
  Path path = parameters.path;
  path.waypoints = {model.start_ebar(), approach(parameters)};
  path.max_step = std::max(path.max_step, start_step * model.start_ebar());
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

/// Largest part of a rod that is put into the knot to begin a path of forces with.
constexpr double loosest_part = 0.7;

double loosest_ebar(const RodParameters& parameters) {
  return std::min(loosest_part * parameters.length, parameters.length - shortest_reach);
}

/// An ebar at which the knot takes less than the first force, if the rod has room for it. The
/// loose-knot law (Audoly et al. 2007) with friction, T = 2 pi^2 B/ebar^2 (1 + 0.555 mu
/// sqrt(ebar)), thrice, as other knots and short rods lie above it; tight knots do not follow it at
/// all.
double looser_than(const RodParameters& parameters) {
  constexpr double margin = 3, tightest = 10, bending_stiffness = std::numbers::pi / 64;
  double ebar = tightest;
  for (int k = 0; k < 30; ++k)
    ebar = std::numbers::pi * std::sqrt(2 * margin * bending_stiffness / parameters.forces.front() *
                                        (1 + 0.555 * parameters.friction * std::sqrt(ebar)));
  const double tied_from = parameters.friction > 0 ? mobilising : 0;
  return std::min({std::max(ebar, tightest), loosest_ebar(parameters),
                   parameters.length - shortest_reach - tied_from});
}

/// Through the forces, from where the tied knot is.
PathOutcome follow_forces(const RodParameters& parameters, RodModel& model,
                          const PathObserver& observer) {
  ForcePath path;
  path.forces = parameters.forces;
  path.first_ebar = parameters.path.waypoints.front();
  path.highest_ebar = loosest_ebar(parameters);
  path.lowest_ebar = -parameters.length;  // stretched to twice its length
  path.max_step = parameters.path.max_step;
  path.min_step = parameters.path.min_step;
  return bight::follow_forces(path, model, observer);
}

}  // namespace

int check_start(const RodParameters& parameters) {
  return RodModel(parameters, parameters.start).determinant();
}

RodResult run_rod(const RodParameters& asked, const RodObserver& observer) {
  check(asked);
  RodParameters parameters = asked;
  if (!asked.forces.empty()) parameters.path.waypoints = {looser_than(asked)};
  const OneThread one_thread;
  RodResult result;
  const auto began = std::chrono::steady_clock::now();
  Polyline start;
  try {
    start = start_of(parameters, observer);
  } catch (const std::runtime_error& error) {
    result.outcome.status = PathStatus::gave_up;
    result.outcome.reason = error.what();
    return result;
  }
  RodModel model(parameters, start);
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
  std::unique_ptr<TimedRod> timed;
  if (parameters.inertia) timed = std::make_unique<TimedRod>(model.tied(), parameters);
  path_observer.on_record = [&](double) {
    result.states.push_back(timed ? timed->state() : model.state());
    observer.on_record(result.states.back());
  };
  PathModel& followed = timed ? static_cast<PathModel&>(*timed) : model;
  result.outcome = parameters.forces.empty() ? follow(parameters.path, followed, path_observer)
                                             : follow_forces(parameters, model, path_observer);
  result.seconds["path"] = seconds_since(tied);
  result.costs = timed ? timed->costs() : model.costs();
  for (const auto& [phase, seconds] : model.seconds()) result.seconds[phase] = seconds;
  return result;
}

}  // namespace bight::rod1d
