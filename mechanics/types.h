#pragma once

#include <Eigen/Core>
#include <vector>

/// Units inside mechanics, rod1d and solid3d: lengths in diameters D, stresses in Young's moduli E.
/// So a force is in E D^2, an energy in E D^3, and the bending stiffness of a round rod is pi/64.
/// coupling/ converts from and to SI; the same numbers serve a rod of 1 um and one of 1 m.
namespace bight {

using Vector = Eigen::VectorXd;
using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// A polyline: one point per node or section [D].
using Polyline = std::vector<Vector3>;

}  // namespace bight
