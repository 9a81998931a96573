#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "mechanics/types.h"

namespace bight::solid3d {

/// Any mesh of 8-node hexahedra: reference positions [D], and nodes of each cell in VTK order.
struct HexMesh {
  std::vector<Vector3> nodes;
  std::vector<std::array<int, 8>> cells;
};

/// Where the strain of a cell is taken: at 2 x 2 x 2 Gauss points, or once, with the mean of the
/// gradients over the cell (exact for a distorted cell, unlike that at its middle).
enum class Quadrature { gauss, mean };

/// Trilinear 8-node hexahedron: what depends on its reference shape alone.
struct HexReference {
  using Gradients = Eigen::Matrix<double, 3, 8>;  ///< dN_a/dX, a column per node [1/D]

  int points = 8;
  std::array<Gradients, 8> gradient;
  std::array<double, 8> weight;  ///< reference volume of the point [D^3]
  double volume = 0;             ///< V [D^3]
};

/// Node positions as columns.
using HexNodes = Eigen::Matrix<double, 3, 8>;

/// Node positions in the cube [-1, 1]^3.
inline const HexNodes& parent_corners() {
  static const HexNodes corners = (HexNodes() << -1, 1, 1, -1, -1, 1, 1, -1, -1, -1, 1, 1, -1, -1,
                                   1, 1, -1, -1, -1, -1, 1, 1, 1, 1)
                                      .finished();
  return corners;
}

/// dN_a/dxi at a point of the cube [-1, 1]^3: N_a = (1 + xi xi_a)(1 + eta eta_a)(1 + zeta
/// zeta_a)/8.
inline HexReference::Gradients parent_gradients(const Vector3& xi) {
  const HexNodes& corner = parent_corners();
  HexReference::Gradients g;
  for (int a = 0; a < 8; ++a) {
    const Vector3 f = Vector3::Ones() + xi.cwiseProduct(corner.col(a));
    g.col(a) = Vector3(corner(0, a) * f.y() * f.z(), corner(1, a) * f.x() * f.z(),
                       corner(2, a) * f.x() * f.y()) /
               8;
  }
  return g;
}

inline HexReference hex_reference(const HexNodes& X, Quadrature quadrature = Quadrature::gauss) {
  const double gauss = 1 / std::sqrt(3.0);
  HexReference reference;
  for (int q = 0; q < reference.points; ++q) {
    const Vector3 xi(q & 1 ? gauss : -gauss, q & 2 ? gauss : -gauss, q & 4 ? gauss : -gauss);
    const auto parent = parent_gradients(xi);
    const Matrix3 dX = X * parent.transpose();
    reference.gradient[q] = dX.inverse().transpose() * parent;
    reference.weight[q] = dX.determinant();
    reference.volume += reference.weight[q];
  }
  if (quadrature == Quadrature::gauss) return reference;
  HexReference mean;
  mean.points = 1;
  mean.weight[0] = mean.volume = reference.volume;
  mean.gradient[0].setZero();
  for (int q = 0; q < reference.points; ++q)
    mean.gradient[0] += reference.weight[q] / reference.volume * reference.gradient[q];
  return mean;
}

/// Positions of a cell's nodes.
inline HexNodes cell_nodes(const HexMesh& mesh, const std::array<int, 8>& cell) {
  HexNodes X;
  for (int a = 0; a < 8; ++a) X.col(a) = mesh.nodes[cell[a]];
  return X;
}

}  // namespace bight::solid3d
