#pragma once

#include "mechanics/newton.h"

namespace bight {

/// Energy of x with its gradient by coordinates and, by order, its Hessian.
double evaluate(System& system, const Vector& x, Order order, Vector& gradient);

/// Newton direction -(H + shift)^-1 g. The shift is zero where H is positive definite. Elsewhere it
/// begins at a part of the last one, but no higher than in proportion to the residual, and grows
/// until the factorisation succeeds: along a solve it decays to zero. Dropping it at once lets the
/// soft modes run far off. False when no shift in range does.
bool newton_direction(System& system, const Vector& gradient, const NewtonOptions& options,
                      NewtonResult& result, Vector& step);

}  // namespace bight
