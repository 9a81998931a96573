#pragma once

#include "rod1d/frames.h"
#include "rod1d/rod.h"

namespace bight::rod1d {

/// The node that is farthest from the z axis; -1 when all are on it.
int farthest_node(const Rod& rod, const Vector& x);

/// Distance of a node from the z axis [D].
double radius_of(const Vector& x, int node);

/// The turn about the z axis that brings a node to y = 0, x > 0.
Matrix3 turn_to_x(const Vector& x, int node);

/// Turns a state about the z axis as a whole, ends and all.
void turn(const Rod& rod, const Matrix3& by, Vector& x);
void turn(const Matrix3& by, Frames& frames);

}  // namespace bight::rod1d
