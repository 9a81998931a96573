#pragma once

#include <cmath>
#include <random>

#include "solid3d/mesh.h"

namespace bight::test {

/// Straight rod of equal cells; `axial` is their length over their width.
inline solid3d::Mesh straight_mesh(int section_cells, double length, double axial, int degree = 1) {
  const solid3d::Section section = solid3d::make_section(section_cells, degree);
  const double width = section.cell_width();
  const int count = std::max(2, static_cast<int>(std::lround(length / (axial * width))));
  std::vector<double> s;
  for (int k = 0; k <= count; ++k) s.push_back(length * k / count);
  return solid3d::make_mesh(section, s);
}

/// Coordinates of a straight reference rod, `behind` zeros after the positions.
inline Vector reference_state(const solid3d::Mesh& mesh, int behind) {
  Vector x = Vector::Zero(3 * mesh.nodes() + behind);
  for (int n = 0; n < mesh.nodes(); ++n) x.segment<3>(3 * n) = mesh.reference(n);
  return x;
}

/// Winds the rod into a helix of that radius and pitch [D] about z, section axes radial and axial:
/// with a pitch near 1 its turns lie on each other.
inline Vector helix_state(const solid3d::Mesh& mesh, double radius, double pitch, int behind) {
  Vector x = Vector::Zero(3 * mesh.nodes() + behind);
  const double rise = pitch / (2 * M_PI), per_angle = std::hypot(radius, rise);
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Vector3 X = mesh.reference(n);
    const double a = X.z() / per_angle;
    const Vector3 outwards(std::cos(a), std::sin(a), 0);
    const Vector3 tangent = Vector3(-radius * std::sin(a), radius * std::cos(a), rise) / per_angle;
    const Vector3 centre = radius * outwards + rise * a * Vector3::UnitZ();
    x.segment<3>(3 * n) = centre + X.x() * outwards + X.y() * tangent.cross(outwards);
  }
  return x;
}

/// The same state with every position moved by noise of that size.
inline Vector shaken(Vector x, int coordinates, double size) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0, size);
  for (int i = 0; i < coordinates; ++i) x[i] += normal(generator);
  return x;
}

}  // namespace bight::test
