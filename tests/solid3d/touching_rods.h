#pragma once

#include <functional>

#include "solid3d/solid_problem.h"

/// What problems of two touching strands have in common: where strands begin, almost hard contact.
namespace bight::test {

using solid3d::SolidParameters;
using solid3d::SolidProblem;

/// Where a straight strand along z begins: its axis along x or along y, its middle at a height.
inline std::function<Vector3(const Vector3&)> along_x(double length, double height) {
  return [=](const Vector3& X) { return Vector3(X.z() - 0.5 * length, X.y(), height - X.x()); };
}
inline std::function<Vector3(const Vector3&)> along_y(double length, double height) {
  return [=](const Vector3& X) { return Vector3(X.x(), X.z() - 0.5 * length, height - X.y()); };
}

/// Contact that is almost hard, for small overlaps.
inline SolidParameters hard_contact(double stiffness, double sample_spacing) {
  SolidParameters parameters;
  parameters.contact_stiffness = stiffness;
  parameters.contact_onset = 0.02 / stiffness;
  parameters.sample_spacing = sample_spacing;
  parameters.penetration = 1;  // never stiffened
  return parameters;
}

}  // namespace bight::test
