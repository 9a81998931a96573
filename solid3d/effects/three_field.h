#pragma once

#include <cmath>

#include "mechanics/effect.h"
#include "solid3d/hex_reference.h"
#include "solid3d/material.h"

/// One cell of effects/strain.h: numbers from positions, dilatation and pressure.
namespace bight::solid3d {

/// A cell with a smaller det F at a point of its quadrature counts as inverted.
constexpr double least_det = 0.02;

/// cof F = J F^-T; J follows from it without a second determinant.
inline Matrix3 cofactor(const Matrix3& F) {
  Matrix3 C;
  C.col(0) = F.col(1).cross(F.col(2));
  C.col(1) = F.col(2).cross(F.col(0));
  C.col(2) = F.col(0).cross(F.col(1));
  return C;
}

/// Stiffness of a cell, H(3a + i, 3b + j) = sum_KL dN_a(K) A(iK, jL) dN_b(L), by pairs of
/// directions i <= j: a vector over the nodes b for every node a.
template <int nodes>
class CellStiffness {
 public:
  void add(const Matrix9& A, const Eigen::Matrix<double, 3, nodes>& dN) {
    const Eigen::Matrix<double, nodes, 3> N = dN.transpose();
    int pair = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j, ++pair) {
        Eigen::Matrix<double, nodes, 3> over_b;
        for (int K = 0; K < 3; ++K)
          over_b.col(K) = A(i + 3 * K, j) * N.col(0) + A(i + 3 * K, j + 3) * N.col(1) +
                          A(i + 3 * K, j + 6) * N.col(2);
        for (int a = 0; a < nodes; ++a)
          block_[pair].col(a) +=
              N(a, 0) * over_b.col(0) + N(a, 1) * over_b.col(1) + N(a, 2) * over_b.col(2);
      }
  }
  template <class Matrix>
  void put(Matrix& H) const {
    int pair = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j, ++pair)
        for (int a = 0; a < nodes; ++a)
          for (int b = 0; b < nodes; ++b)
            H(3 * a + i, 3 * b + j) = H(3 * b + j, 3 * a + i) = block_[pair](b, a);
  }

 private:
  using Block = Eigen::Matrix<double, nodes, nodes>;
  std::array<Block, 6> block_{Block::Zero(), Block::Zero(), Block::Zero(),
                              Block::Zero(), Block::Zero(), Block::Zero()};
};

/// v_k = int M_k det F dV, and as columns its gradients b_k by the positions.
template <int degree>
struct CellVolume {
  using Gradients = Eigen::Matrix<double, 3 * hex_nodes<degree>, hex_modes<degree>>;
  HexModes<degree> v = HexModes<degree>::Zero();
  Gradients b = Gradients::Zero();

  /// A point's share, of weight w: J = det F, C = cof F.
  void add(double w, double J, const HexModes<degree>& mode) { v += w * J * mode; }
  void add_gradient(double w, const Matrix3& C, const HexNodes<degree>& dN,
                    const HexModes<degree>& mode) {
    const HexNodes<degree> of_point = w * C * dN;
    for (int k = 0; k < hex_modes<degree>; ++k)
      HexNodes<degree>::Map(b.col(k).data()) += mode[k] * of_point;
  }
};

template <int degree>
CellVolume<degree> cell_volume(const HexReference<degree>& cell, const HexNodes<degree>& x,
                               bool with_gradients) {
  CellVolume<degree> volume;
  for (int q = 0; q < cell.points; ++q) {
    const Matrix3 F = x * cell.gradient[q].transpose();
    const Matrix3 C = cofactor(F);
    volume.add(cell.weight[q], F.col(0).dot(C.col(0)), cell.mode[q]);
    if (with_gradients) volume.add_gradient(cell.weight[q], C, cell.gradient[q], cell.mode[q]);
  }
  return volume;
}

/// int U(theta) dV of theta - 1 = sum_k t_k M_k, with derivatives by the t_k.
template <int degree>
struct CellVolumetric {
  using Matrix = Eigen::Matrix<double, hex_modes<degree>, hex_modes<degree>>;
  double energy = 0;
  HexModes<degree> slope = HexModes<degree>::Zero();
  Matrix curvature = Matrix::Zero();
};

template <int degree, class M>
CellVolumetric<degree> cell_volumetric(const M& material, const HexReference<degree>& cell,
                                       const HexModes<degree>& t) {
  CellVolumetric<degree> sum;
  for (int q = 0; q < cell.points; ++q) {
    const HexModes<degree>& mode = cell.mode[q];
    const Volumetric U = material.volumetric(t.dot(mode));
    sum.energy += cell.weight[q] * U.energy;
    sum.slope += cell.weight[q] * U.slope * mode;
    sum.curvature += cell.weight[q] * U.curvature * (mode * mode.transpose());
  }
  return sum;
}

/// v_k - int M_k theta dV.
template <int degree>
HexModes<degree> missing(const HexReference<degree>& cell, const HexModes<degree>& v,
                         const HexModes<degree>& t) {
  return v - cell.volume * (HexModes<degree>::Unit(0) + t);
}

/// The energy Pi of a cell at positions x, and its derivatives by them with t and p condensed.
template <int degree, class M>
void three_field(const M& material, const HexReference<degree>& cell, const HexNodes<degree>& x,
                 const HexModes<degree>& t, const HexModes<degree>& p, Order order,
                 ElementSlot& slot) {
  constexpr int nodes = hex_nodes<degree>;
  CellVolume<degree> volume;
  double energy = 0;
  HexNodes<degree> g = HexNodes<degree>::Zero();
  CellStiffness<nodes> stiffness;
  for (int q = 0; q < cell.points; ++q) {
    const HexNodes<degree>& dN = cell.gradient[q];
    const double w = cell.weight[q];
    const Matrix3 F = x * dN.transpose();
    const Matrix3 C = cofactor(F);
    const double J = F.col(0).dot(C.col(0));
    if (!(J > least_det)) {
      slot.energy = inadmissible;
      return;
    }
    energy += w * material.energy(F, J);
    volume.add(w, J, cell.mode[q]);
    if (order < Order::gradient) continue;
    const Matrix3 G = C / J;
    g.noalias() += w * material.stress(F, G, J) * dN;
    volume.add_gradient(w, C, dN, cell.mode[q]);
    if (order < Order::hessian) continue;
    // d(p J F^-T) = p J ((F^-T:dF) F^-T - F^-T dF^T F^-T)
    const double pJ = p.dot(cell.mode[q]) * J;
    Matrix9 A = material.tangent(F, G, J);
    const Eigen::Map<const Vector9> vec_G(G.data());
    A.noalias() += pJ * (vec_G * vec_G.transpose());
    add_transposed_product(-pJ, G, A);
    A *= w;
    stiffness.add(A, dN);
  }

  // Cells far from their dilatation are on their way to it; the quadratic term makes Pi a measure
  // of progress there and vanishes at the solution.
  const CellVolumetric<degree> U = cell_volumetric(material, cell, t);
  const HexModes<degree> miss = missing(cell, volume.v, t);
  slot.energy = energy + U.energy + p.dot(miss) +
                0.5 * material.shear_modulus * miss.squaredNorm() / cell.volume;
  if (!std::isfinite(slot.energy)) slot.energy = inadmissible;
  if (order < Order::gradient) return;
  // Condensed: dt = (miss + b^T du)/V, dp = (U' + U'' dt)/V - p. The force is that of the pressure
  // (U' + U'' miss/V)/V, and the stiffness gains b U''/V^2 b^T.
  using Force = Eigen::Matrix<double, 3 * nodes, 1>;
  const HexModes<degree> pressure = (U.slope + U.curvature * miss / cell.volume) / cell.volume;
  Force::Map(slot.gradient) = Force::Map(g.data()) + volume.b * pressure;
  if (order < Order::hessian) return;
  Eigen::Map<Eigen::Matrix<double, 3 * nodes, 3 * nodes>> H(slot.hessian);
  const typename CellVolume<degree>::Gradients Ub =
      volume.b * (U.curvature / (cell.volume * cell.volume));
  stiffness.put(H);
  H.noalias() += Ub * volume.b.transpose();
}

/// The condensed part of a Newton step, dt and dp, for a step dx of the positions.
template <int degree, class M>
void recover_fields(const M& material, const HexReference<degree>& cell, const HexNodes<degree>& x,
                    const HexNodes<degree>& dx, const HexModes<degree>& t,
                    const HexModes<degree>& p, double* dt, double* dp) {
  using Step = Eigen::Matrix<double, 3 * hex_nodes<degree>, 1>;
  using Modes = HexModes<degree>;
  const CellVolume<degree> volume = cell_volume(cell, x, true);
  const CellVolumetric<degree> U = cell_volumetric(material, cell, t);
  const Modes v = volume.v + volume.b.transpose() * Step::Map(dx.data());
  const Modes step = missing(cell, v, t) / cell.volume;
  Modes::Map(dt) = step;
  Modes::Map(dp) = (U.slope + U.curvature * step) / cell.volume - p;
}

}  // namespace bight::solid3d
