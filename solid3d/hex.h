#pragma once

#include <array>
#include <vector>

#include "mechanics/types.h"

namespace bight::solid3d {

/// Nodes of a cell in VTK order: 8 of a hexahedron, 27 of a triquadratic one, whose first eight are
/// its corners.
using HexCell = std::vector<int>;

/// Any mesh of hexahedra of one degree (1: 8 nodes, 2: 27): reference positions [D] and cells.
struct HexMesh {
  std::vector<Vector3> nodes;
  std::vector<HexCell> cells;
  int degree = 1;
};

template <int degree>
constexpr int hex_nodes = (degree + 1) * (degree + 1) * (degree + 1);

/// Node positions as columns; also forces, and the gradients dN_a/dX.
template <int degree>
using HexNodes = Eigen::Matrix<double, 3, hex_nodes<degree>>;

/// Node positions in the cube [-1, 1]^3, in VTK order.
inline const HexNodes<2>& parent_nodes() {
  // clang-format off
  static const HexNodes<2> nodes = (HexNodes<2>() <<
    -1, 1, 1,-1,-1, 1, 1,-1,  0, 1, 0,-1, 0, 1, 0,-1,-1, 1, 1,-1, -1, 1, 0, 0, 0, 0, 0,
    -1,-1, 1, 1,-1,-1, 1, 1, -1, 0, 1, 0,-1, 0, 1, 0,-1,-1, 1, 1,  0, 0,-1, 1, 0, 0, 0,
    -1,-1,-1,-1, 1, 1, 1, 1, -1,-1,-1,-1, 1, 1, 1, 1, 0, 0, 0, 0,  0, 0, 0, 0,-1, 1, 0).finished();
  // clang-format on
  return nodes;
}

/// The node's place in the cell's grid, 0 ... degree along every direction.
inline std::array<int, 3> grid_place(int degree, int node) {
  std::array<int, 3> place;
  for (int c = 0; c < 3; ++c)
    place[c] = degree * (static_cast<int>(parent_nodes()(c, node)) + 1) / 2;
  return place;
}

/// Lagrange polynomial on [-1, 1] that is 1 at the node and 0 at the others, and its slope.
struct Lagrange {
  double value, slope;
};
inline Lagrange lagrange(int degree, double node, double t) {
  if (degree == 1) return {0.5 * (1 + node * t), 0.5 * node};
  if (node == 0) return {1 - t * t, -2 * t};
  return {0.5 * t * (t + node), t + 0.5 * node};
}

/// dN_a/dxi at a point of the cube [-1, 1]^3, N_a the product of three Lagrange polynomials.
template <int degree>
HexNodes<degree> parent_gradients(const Vector3& xi) {
  HexNodes<degree> g;
  for (int a = 0; a < hex_nodes<degree>; ++a) {
    std::array<Lagrange, 3> f;
    for (int c = 0; c < 3; ++c) f[c] = lagrange(degree, parent_nodes()(c, a), xi[c]);
    g.col(a) = Vector3(f[0].slope * f[1].value * f[2].value, f[0].value * f[1].slope * f[2].value,
                       f[0].value * f[1].value * f[2].slope);
  }
  return g;
}

/// N_a there.
template <int degree>
Eigen::Matrix<double, hex_nodes<degree>, 1> parent_values(const Vector3& xi) {
  Eigen::Matrix<double, hex_nodes<degree>, 1> N;
  N.setOnes();
  for (int a = 0; a < hex_nodes<degree>; ++a)
    for (int c = 0; c < 3; ++c) N[a] *= lagrange(degree, parent_nodes()(c, a), xi[c]).value;
  return N;
}

/// Positions of a cell's nodes.
template <int degree>
HexNodes<degree> cell_nodes(const HexMesh& mesh, const HexCell& cell) {
  HexNodes<degree> X;
  for (int a = 0; a < hex_nodes<degree>; ++a) X.col(a) = mesh.nodes[cell[a]];
  return X;
}

}  // namespace bight::solid3d
