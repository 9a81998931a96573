#pragma once

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

/// Solves for equilibrium with following forces, from x near it: Newton's method with the whole,
/// unsymmetric tangent H + F, where H is the frozen energy's Hessian and F the change of the
/// following forces. The linear equations are solved by GMRES (Saad and Schultz 1986),
/// preconditioned by the factorisation of H: H^-1 F is small in rank and size, so a few products
/// do.
///
/// There is no energy to minimise: the frozen one only bounds a wild step, and may rise by what the
/// step is predicted to change. From a poor start it fails (`stalled`, or `too_many_iterations`),
/// and minimisations at frozen forces have to be taken instead.
NewtonResult coupled_newton(System& system, FollowingForces& forces, Vector x,
                            const NewtonOptions& options,
                            const NewtonObserver& observer = {});

}  // namespace bight
