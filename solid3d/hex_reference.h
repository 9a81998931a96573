#pragma once

#include <Eigen/Cholesky>
#include <array>
#include <cassert>
#include <cmath>

#include "solid3d/hex.h"

namespace bight::solid3d {

/// Where the strain of a cell is taken: at (degree + 1)^3 Gauss points, or once, with the mean of
/// the gradients over the cell (exact for a distorted cell, unlike that at its middle).
enum class Quadrature { gauss, mean };

/// Functions in which a cell's pressure and dilatation are linear combinations: a constant, and of
/// degree 2 the three coordinates (Q1-P0, Q2-P1).
template <int degree>
constexpr int hex_modes = degree == 1 ? 1 : 4;
template <int degree>
using HexModes = Eigen::Matrix<double, hex_modes<degree>, 1>;

/// Of a cell: dilatation and pressure, a coefficient of each for every mode.
inline int internals_per_cell(int degree) {
  return 2 * (degree == 1 ? hex_modes<1> : hex_modes<2>);
}

/// Lagrange hexahedron: what depends on its reference shape alone. Its modes are those of the
/// reference coordinates X and not of the parent cube, so that the pressure of a bent rod, which is
/// linear in X, is exact in cells of any shape; orthonormal, int M_j M_k dV = V delta_jk, M_0 = 1.
template <int degree>
struct HexReference {
  int points = hex_nodes<degree>;
  std::array<HexNodes<degree>, hex_nodes<degree>> gradient;  ///< dN_a/dX at a point [1/D]
  std::array<double, hex_nodes<degree>> weight;              ///< reference volume of it [D^3]
  std::array<HexModes<degree>, hex_nodes<degree>> mode;
  double volume = 0;  ///< V [D^3]
};

/// Of Gauss and Legendre's degree + 1 points on [-1, 1].
struct GaussPoint {
  double t, weight;
};
inline GaussPoint gauss_point(int degree, int i) {
  if (degree == 1) return {(2 * i - 1) / std::sqrt(3.0), 1};
  return {(i - 1) * std::sqrt(0.6), i == 1 ? 8.0 / 9 : 5.0 / 9};
}

/// Place in the cube [-1, 1]^3 and weight of a cell's Gauss point q < (degree + 1)^3.
struct CellPoint {
  Vector3 xi;
  double weight;
};
inline CellPoint cell_point(int degree, int q) {
  const int n = degree + 1;
  const GaussPoint a = gauss_point(degree, q % n), b = gauss_point(degree, q / n % n),
                   c = gauss_point(degree, q / (n * n));
  return {{a.t, b.t, c.t}, a.weight * b.weight * c.weight};
}

/// The modes at the points of a cell, by Gram and Schmidt from {1, X}.
template <int degree>
void set_modes(const std::array<Vector3, hex_nodes<degree>>& X, HexReference<degree>& reference) {
  if constexpr (degree == 1) {
    reference.mode.fill(HexModes<1>::Ones());
  } else {
    Vector3 middle = Vector3::Zero();
    for (int q = 0; q < reference.points; ++q)
      middle += reference.weight[q] / reference.volume * X[q];
    Eigen::Matrix4d gram = Eigen::Matrix4d::Zero();
    for (int q = 0; q < reference.points; ++q) {
      reference.mode[q] << 1, X[q] - middle;
      gram += reference.weight[q] / reference.volume *
              (reference.mode[q] * reference.mode[q].transpose());
    }
    const Eigen::LLT<Eigen::Matrix4d> factor(gram);
    for (auto& mode : reference.mode) factor.matrixL().solveInPlace(mode);
  }
}

template <int degree>
HexReference<degree> hex_reference(const HexNodes<degree>& X,
                                   Quadrature quadrature = Quadrature::gauss) {
  HexReference<degree> reference;
  std::array<Vector3, hex_nodes<degree>> at;
  for (int q = 0; q < reference.points; ++q) {
    const auto [xi, weight] = cell_point(degree, q);
    const auto parent = parent_gradients<degree>(xi);
    const Matrix3 dX = X * parent.transpose();
    reference.gradient[q] = dX.inverse().transpose() * parent;
    reference.weight[q] = weight * dX.determinant();
    reference.volume += reference.weight[q];
    at[q] = X * parent_values<degree>(xi);
  }
  set_modes<degree>(at, reference);
  if (quadrature == Quadrature::gauss) return reference;
  assert(degree == 1);
  HexReference<degree> mean;
  mean.points = 1;
  mean.weight[0] = mean.volume = reference.volume;
  mean.gradient[0].setZero();
  for (int q = 0; q < reference.points; ++q)
    mean.gradient[0] += reference.weight[q] / reference.volume * reference.gradient[q];
  mean.mode[0] = HexModes<degree>::Unit(0);
  return mean;
}

}  // namespace bight::solid3d
