#pragma once

#include <span>
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

/// The node whose coordinates begin at `at`, as a section there sees it.
Vector3 seen_from(const SectionPlace& place, const Vector& x, int at);

/// Rotation by the vector w (axis times angle), and the vector of a rotation.
Matrix3 rotation_by(const Vector3& w);
Vector3 rotation_vector(const Matrix3& R);

/// x + dx, where each section's mean rotation in dx is taken through the exponential map: a linear
/// update inflates a section that turns by theta by theta^2/2, which incompressibility punishes.
void advance_sections(std::span<const Mesh> strands, Vector& x, const Vector& dx);
inline void advance_sections(const Mesh& mesh, Vector& x, const Vector& dx) {
  advance_sections(std::span(&mesh, 1), x, dx);
}

/// A state and the ebar it belongs to.
struct Station {
  double ebar;
  Vector x;
};

/// Guess for `ebar` from the last two or three accepted states (newest last): every section goes on
/// along its own screw, and deforms in its own frame, at the rates that the last steps had,
/// extrapolated. (In Cartesian coordinates the same extrapolation is worse than none.)
Vector extrapolate_sections(std::span<const Mesh> strands, const std::vector<Station>& states,
                            double ebar);
inline Vector extrapolate_sections(const Mesh& mesh, const std::vector<Station>& states,
                                   double ebar) {
  return extrapolate_sections(std::span(&mesh, 1), states, ebar);
}

}  // namespace bight::solid3d
