#pragma once

#include <array>
#include <cmath>

#include "mechanics/types.h"

namespace bight::solid3d {

/// Trilinear 8-node hexahedron with 2 x 2 x 2 Gauss points: what depends on its reference shape
/// alone. Nodes in VTK order.
struct HexReference {
  static constexpr int points = 8;
  using Gradients = Eigen::Matrix<double, 3, 8>;  ///< dN_a/dX, a column per node [1/D]

  std::array<Gradients, points> gradient;
  std::array<double, points> weight;  ///< reference volume of the point [D^3]
  double volume = 0;                  ///< V [D^3]
};

/// Node positions as columns.
using HexNodes = Eigen::Matrix<double, 3, 8>;

/// dN_a/dxi at a point of the cube [-1, 1]^3: N_a = (1 + xi xi_a)(1 + eta eta_a)(1 + zeta
/// zeta_a)/8.
inline HexReference::Gradients parent_gradients(const Vector3& xi) {
  static const HexNodes corner = (HexNodes() << -1, 1, 1, -1, -1, 1, 1, -1, -1, -1, 1, 1, -1, -1, 1,
                                  1, -1, -1, -1, -1, 1, 1, 1, 1)
                                     .finished();
  HexReference::Gradients g;
  for (int a = 0; a < 8; ++a) {
    const Vector3 f = Vector3::Ones() + xi.cwiseProduct(corner.col(a));
    g.col(a) = Vector3(corner(0, a) * f.y() * f.z(), corner(1, a) * f.x() * f.z(),
                       corner(2, a) * f.x() * f.y()) /
               8;
  }
  return g;
}

inline HexReference hex_reference(const HexNodes& X) {
  const double gauss = 1 / std::sqrt(3.0);
  HexReference reference;
  for (int q = 0; q < HexReference::points; ++q) {
    const Vector3 xi(q & 1 ? gauss : -gauss, q & 2 ? gauss : -gauss, q & 4 ? gauss : -gauss);
    const auto parent = parent_gradients(xi);
    const Matrix3 dX = X * parent.transpose();
    reference.gradient[q] = dX.inverse().transpose() * parent;
    reference.weight[q] = dX.determinant();
    reference.volume += reference.weight[q];
  }
  return reference;
}

}  // namespace bight::solid3d
