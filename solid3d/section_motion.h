#pragma once

#include <vector>

#include "mechanics/types.h"
#include "solid3d/mesh.h"

namespace bight::solid3d {

/// Place of a section: mean position and best-fit rotation of its nodes from the reference.
struct SectionPlace {
  Vector3 centre;
  Matrix3 rotation;
};

/// Places of all sections of a state (Kabsch 1976: the rotation nearest to the deformation).
std::vector<SectionPlace> section_places(const Mesh& mesh, const Vector& x);

/// x + dx, where each section's mean rotation in dx is taken through the exponential map: a linear
/// update inflates a section that turns by theta by theta^2/2, which incompressibility punishes.
void advance_sections(const Mesh& mesh, Vector& x, const Vector& dx);

/// Repeats the motion before -> now of each section in its own frame, times `ratio` (a screw; in
/// Cartesian coordinates the same extrapolation is worse than none).
Vector extrapolate_sections(const Mesh& mesh, const Vector& before, const Vector& now,
                            double ratio);

}  // namespace bight::solid3d
