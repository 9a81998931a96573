#pragma once

#include "mechanics/newton.h"

namespace bight {

/// Energy of x with its gradient by coordinates and, by order, its Hessian.
double evaluate(System& system, const Vector& x, Order order, Vector& gradient);

/// (H + shift)^-1 r, of the last factorisation.
Vector solved(System& system, const Vector& r);

/// Newton direction -(H + shift)^-1 g. The shift is zero where H is positive definite. Elsewhere it
/// begins at a part of the last one, but no higher than in proportion to the residual, and grows
/// until the factorisation succeeds: along a solve it decays to zero. Dropping it at once lets the
/// soft modes run far off. False when no shift in range does.
bool newton_direction(System& system, const Vector& gradient, const NewtonOptions& options,
                      NewtonResult& result, Vector& step);

/// A step of the unknowns as a change of all coordinates, and the fraction of it, at most 1, that
/// keeps within the largest move and lets no strand pass another.
struct Move {
  Vector dx;
  double longest = 1;
};
Move move_by(System& system, const Vector& x, const Vector& step, double largest_move);

/// x + dx, in the geometry of the model.
Vector moved(System& system, Vector x, const Vector& dx);

}  // namespace bight
