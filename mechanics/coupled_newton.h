#pragma once

#include <limits>

#include "mechanics/newton.h"

namespace bight {

/// Forces that are no gradient: those of friction, whose limit follows the normal force. They are
/// the gradient of an effect's energy with what they depend on frozen, and change with it.
class FollowingForces {
 public:
  virtual ~FollowingForces() = default;
  /// Freezes what the forces depend on at x, whose elements the next evaluation is of.
  virtual void freeze(const Vector& x) = 0;
  /// Adds what freezing at x + dx instead changes in the gradient by coordinates, to first order.
  virtual void add_change(const Vector& dx, Vector& gradient) const = 0;
};

/// How far the steps of coupled_newton() go.
struct CoupledSteps {
  bool damped = false;
  /// Steps that wander end an attempt: those with a decrement above `most_growth` times the first
  /// one and above that of a short step.
  double most_growth = std::numeric_limits<double>::infinity();
  double short_step = 0;
};

/// Solves for equilibrium with following forces, from x near it: Newton's method with the whole,
/// unsymmetric tangent H + F, where H is the frozen energy's Hessian and F the change of the
/// following forces. The linear equations are solved by GMRES (Saad and Schultz 1986),
/// preconditioned by the factorisation of H: H^-1 F is small in rank and size, so a few products
/// do.
///
/// There is no energy to minimise. Full steps (within a bound on the frozen energy) are the fastest
/// where a step ends in a stiff curved valley and the next one goes back to its floor; where they
/// grow, the attempt ends. Damped ones are halved until the natural level function falls,
///
///   T(x + t dx) <= (1 - t/4)^2 T(x),   T(y) = r(y) . H(x)^-1 r(y),   r the residual,
///
/// which does not ask how unknowns are scaled (Deuflhard, Newton Methods for Nonlinear Problems,
/// 2004, sect. 3.3), or, where no part of the step does that, to its least value: they find the way
/// along the soft modes of a tight knot, where full ones wander.
///
/// From a poor start either fails, and minimisations at frozen forces have to be taken instead.
NewtonResult coupled_newton(System& system, FollowingForces& forces, Vector x,
                            const NewtonOptions& options, CoupledSteps steps = {},
                            const NewtonObserver& observer = {});

}  // namespace bight
