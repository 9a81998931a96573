#pragma once

#include <functional>
#include <string>

#include "mechanics/assemble.h"
#include "mechanics/line_search.h"
#include "mechanics/sparse_cholesky.h"
#include "mechanics/types.h"

namespace bight {

/// What Newton solves: unknowns, their effects, and how a step moves the state.
struct System {
  Assembler& assembler;
  SparseCholesky& cholesky;
  Ordering ordering = Ordering::natural;
  /// x <- x + dx, in the geometry of the model (rigid turns of sections taken exactly).
  std::function<void(Vector& x, const Vector& dx)> advance;
  int analysed_pattern = 0;  ///< pattern version that the symbolic analysis belongs to
  double shift = 0;  ///< diagonal shift of the last factorisation, where the next one begins
  std::map<std::string, double> seconds{};  ///< wall seconds by phase, summed over all solves
};

struct NewtonOptions {
  int max_iterations = 60;
  /// Energy that the next step would still gain (Newton decrement / 2) at which to stop.
  double energy_tolerance = 1e-12;
  /// Largest out-of-balance force on one unknown at which to stop.
  double force_tolerance = 1e-8;
  double largest_move = 0.25;  ///< largest change of a coordinate in one iteration [D]
  double shift_decay = 0.1;    ///< of the diagonal shift from one iteration to the next
  EnergyBound bound;
};

enum class NewtonStatus {
  converged,
  stalled,
  too_many_iterations,
  not_finite,
  no_descent,
  rejected  ///< solved, but the model does not accept the state
};

struct NewtonResult {
  NewtonStatus status = NewtonStatus::too_many_iterations;
  Vector x;
  Vector gradient;  ///< by coordinates at x: on held ones, the reactions
  double energy = 0;
  double residual = 0;   ///< largest out-of-balance force on one unknown
  double decrement = 0;  ///< g . H^-1 g at the last direction
  int iterations = 0, factorisations = 0;
  std::string reason;  ///< in words, when not converged
  bool ok() const { return status == NewtonStatus::converged; }
  /// Counts the iterations of a solve that led here as well.
  void count_on(const NewtonResult& before) {
    iterations += before.iterations;
    factorisations += before.factorisations;
  }
};

struct NewtonMonitor {
  int iteration = 0;
  double energy = 0, residual = 0, decrement = 0, step = 0, shift = 0;
};
using NewtonObserver = std::function<void(const NewtonMonitor&)>;

/// Minimises the energy over the unknowns, from x: evaluate, direction, step, stop.
NewtonResult newton(System& system, Vector x, const NewtonOptions& options,
                    const NewtonObserver& observer = {});

/// Whether the energy rises in every direction of the unknowns from x.
bool stable(Assembler& assembler, const Vector& x);

}  // namespace bight
