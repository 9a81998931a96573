#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanics/newton.h"
#include "mechanics/types.h"

namespace bight {

/// Where to go in the end-to-end shortening ebar = (L0 - L)/D.
struct Path {
  std::vector<double> waypoints;  ///< ebar, visited in this order, from the first on
  double max_step = 0.5;          ///< largest step in ebar
  double min_step = 1e-4;         ///< a step cut below this ends the run
  std::vector<double> record;     ///< ebar at which full states are handed out
};

/// One accepted step: a row of force.csv, in the units of mechanics/types.h.
struct StepRow {
  double ebar = 0;
  double tension = 0;          ///< end tension T [E D^2]
  double energy = 0;           ///< stored energy [E D^3]
  double dissipated = 0;       ///< energy lost to friction so far [E D^3]
  double max_penetration = 0;  ///< largest overlap of surfaces in contact [D]
  int contact_pairs = 0;       ///< contact samples that carry load
  int newton_iterations = 0;   ///< of the accepted solve (all of its passes)
  double wall_s = 0;           ///< seconds since the run began

  double increment = 0;          ///< the step in ebar that was accepted
  int cutbacks = 0;              ///< failed tries before it
  std::string cut_reason;        ///< why the last try failed; empty without cutbacks
  double residual = 0;           ///< out-of-balance force over the force scale
  double reaction_mismatch = 0;  ///< |T(start) + T(finish)| / T
  double min_jacobian = 1;       ///< smallest volume ratio of a cell (solid)
  double end_turn = 0;           ///< rotation of the finish end about the pulling axis [rad]
  double end_torque = 0;         ///< on the finish end about the pulling axis [E D^3]
  double snapped = 0;  ///< energy lost by jumping to another branch of equilibria [E D^3]; 0: none
  double time = 0;     ///< since the path began, where there is inertia [D sqrt(rho/E)]
  double kinetic = 0;  ///< part of the stored energy that is kinetic [E D^3]
  /// Energy that round sections would store in flattening, if they could (rod) [E D^3].
  double flattening = 0;
  double ebar_unstretched = 0;  ///< ebar of a rod of the stretched length: ebar + elongation/D
};

enum class PathStatus { finished, gave_up, interrupted };

struct PathOutcome {
  PathStatus status = PathStatus::finished;
  std::string reason;  ///< why it gave up, in words
  int steps = 0, iterations = 0, factorisations = 0, cutbacks = 0;
};

/// How far follow() has come: enough to go on from an accepted step as if it had not stopped.
struct PathProgress {
  size_t leg = 0;      ///< waypoint that is walked to; 0: not begun
  double ebar = 0;     ///< of the newest accepted step
  double step = 0;     ///< largest next one, in ebar
  PathOutcome so_far;  ///< counts of steps, iterations, ...
};

/// What the path asks of a model. The state is one plain vector of coordinates.
class PathModel {
 public:
  virtual ~PathModel() = default;
  /// First guess for `ebar` from the accepted states so far (newest last), ends moved to ebar.
  virtual Vector predict(double ebar) const = 0;
  /// Equilibrium at `ebar` from that guess. The model keeps nothing of it before accept().
  virtual NewtonResult solve(const Vector& guess, double ebar) = 0;
  /// Takes the state over as the newest accepted one and measures it.
  virtual StepRow accept(const NewtonResult& result, double ebar) = 0;
};

/// Called by follow(): every accepted step, and each state to be recorded after its step.
struct PathObserver {
  std::function<void(const StepRow&)> on_step = [](const StepRow&) {};
  std::function<void(double ebar)> on_record = [](double) {};
  /// After every step but the first, when its record was handed out.
  std::function<void(const PathProgress&)> on_progress = [](const PathProgress&) {};
  std::function<bool()> interrupted = [] { return false; };
};

/// Follows the waypoints: predict, solve, accept; cut the step when a solve fails, grow it when
/// solves are easy. Steps land exactly on waypoints and on record values. `from`: where to go on
/// from; the model is at that step.
PathOutcome follow(const Path& path, PathModel& model, const PathObserver& observer,
                   const PathProgress& from = {});

}  // namespace bight
