#include "solid3d/effects/strain.h"

#include <algorithm>
#include <cmath>

namespace bight::solid3d {

namespace {

/// A cell with a smaller det F at a Gauss point counts as inverted.
constexpr double least_det = 0.02;

using Matrix8 = Eigen::Matrix<double, 8, 8>;
using Matrix24 = Eigen::Matrix<double, 24, 24>;
using Vector24 = Eigen::Matrix<double, 24, 1>;

/// cof F = J F^-T; J follows from it without a second determinant.
Matrix3 cofactor(const Matrix3& F) {
  Matrix3 C;
  C.col(0) = F.col(1).cross(F.col(2));
  C.col(1) = F.col(2).cross(F.col(0));
  C.col(2) = F.col(0).cross(F.col(1));
  return C;
}

/// Stiffness of a cell, H(3a + i, 3b + j) = sum_KL dN_a(K) A(iK, jL) dN_b(L), by pairs of
/// directions i <= j: a vector over the nodes b for every node a.
class Stiffness {
 public:
  void add(const Matrix9& A, const HexReference::Gradients& dN) {
    const Nodes N = dN.transpose();
    int pair = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j, ++pair)
        for (int K = 0; K < 3; ++K) {
          const Eigen::Matrix<double, 8, 1> over_b = A(i + 3 * K, j) * N.col(0) +
                                                     A(i + 3 * K, j + 3) * N.col(1) +
                                                     A(i + 3 * K, j + 6) * N.col(2);
          for (int a = 0; a < 8; ++a) block_[pair].col(a) += N(a, K) * over_b;
        }
  }
  void put(Matrix24& H) const {
    int pair = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j, ++pair)
        for (int a = 0; a < 8; ++a)
          for (int b = 0; b < 8; ++b)
            H(3 * a + i, 3 * b + j) = H(3 * b + j, 3 * a + i) = block_[pair](b, a);
  }

 private:
  using Nodes = Eigen::Matrix<double, 8, 3>;
  std::array<Matrix8, 6> block_{Matrix8::Zero(), Matrix8::Zero(), Matrix8::Zero(),
                                Matrix8::Zero(), Matrix8::Zero(), Matrix8::Zero()};
};

}  // namespace

Strain::Strain(const HexMesh& mesh, int internal_begin, Material material, Quadrature quadrature,
               int first_cell)
    : material_(std::move(material)), internal_begin_(internal_begin), first_cell_(first_cell) {
  for (const auto& cell : mesh.cells) {
    std::array<int, 24> coordinates;
    for (int a = 0; a < 8; ++a)
      for (int c = 0; c < 3; ++c) coordinates[3 * a + c] = 3 * cell[a] + c;
    cells_.push_back(hex_reference(cell_nodes(mesh, cell), quadrature));
    if (quadrature != Quadrature::gauss) gauss_.push_back(hex_reference(cell_nodes(mesh, cell)));
    coordinates_.push_back(coordinates);
  }
}

HexNodes Strain::nodes(const Vector& x, int cell) const {
  HexNodes positions;
  for (int a = 0; a < 8; ++a) positions.col(a) = x.segment<3>(coordinates_[cell][3 * a]);
  return positions;
}

double Strain::volume(const HexNodes& x, const HexReference& cell, HexNodes* gradient) const {
  double v = 0;
  if (gradient) gradient->setZero();
  for (int q = 0; q < cell.points; ++q) {
    const Matrix3 F = x * cell.gradient[q].transpose();
    const Matrix3 C = cofactor(F);
    v += cell.weight[q] * F.col(0).dot(C.col(0));
    if (gradient) gradient->noalias() += cell.weight[q] * C * cell.gradient[q];
  }
  return v;
}

void Strain::element(const Vector& x, int stencil, Order order, ElementSlot& slot) const {
  std::visit(
      [&](const auto& material) { element_of(material, x, first_cell_ + stencil, order, slot); },
      material_);
}

template <class M>
void Strain::element_of(const M& material, const Vector& x, int cell, Order order,
                        ElementSlot& slot) const {
  const HexReference& ref = cells_[cell];
  const HexNodes positions = nodes(x, cell);
  const double theta_1 = x[internal_begin_ + 2 * cell], p = x[internal_begin_ + 2 * cell + 1];

  double energy = 0, v = 0;
  HexNodes g = HexNodes::Zero(), b = HexNodes::Zero();
  Stiffness stiffness;
  for (int q = 0; q < ref.points; ++q) {
    const auto& dN = ref.gradient[q];
    const double w = ref.weight[q];
    const Matrix3 F = positions * dN.transpose();
    const Matrix3 C = cofactor(F);
    const double J = F.col(0).dot(C.col(0));
    if (!(J > least_det)) {
      slot.energy = inadmissible;
      return;
    }
    energy += w * material.energy(F, J);
    v += w * J;
    if (order < Order::gradient) continue;
    const Matrix3 G = C / J;
    g.noalias() += w * material.stress(F, G, J) * dN;
    b.noalias() += w * C * dN;
    if (order < Order::hessian) continue;
    // d(p J F^-T) = p J ((F^-T:dF) F^-T - F^-T dF^T F^-T)
    Matrix9 A = material.tangent(F, G, J);
    const Eigen::Map<const Vector9> vec_G(G.data());
    A.noalias() += p * J * (vec_G * vec_G.transpose());
    add_transposed_product(-p * J, G, A);
    A *= w;
    stiffness.add(A, dN);
  }

  // Cells far from their dilatation (v != V theta) are on their way to it; the quadratic term
  // makes Pi a measure of progress there and vanishes at the solution.
  const Volumetric U = material.volumetric(theta_1);
  const double miss = v - ref.volume * (1 + theta_1);
  slot.energy = energy + ref.volume * U.energy + p * miss +
                0.5 * material.shear_modulus * miss * miss / ref.volume;
  if (!std::isfinite(slot.energy)) slot.energy = inadmissible;
  if (order < Order::gradient) return;
  // Condensed: dtheta = (v + b.du)/V - theta, dp = U'' dtheta + U' - p. The force is that of the
  // pressure U' + U'' (v/V - theta), and the stiffness gains U''/V b b^T.
  const double pressure = U.slope + U.curvature * miss / ref.volume;
  g += pressure * b;
  Vector24::Map(slot.gradient) = Vector24::Map(g.data());
  if (order < Order::hessian) return;
  const Eigen::Map<const Vector24> vec_b(b.data());
  Eigen::Map<Matrix24> H(slot.hessian);
  Matrix24 own;
  stiffness.put(own);
  H = own + U.curvature / ref.volume * (vec_b * vec_b.transpose());
}

void Strain::recover(const Vector& x, Vector& dx) const {
#pragma omp parallel for schedule(static)
  for (int cell = 0; cell < cells(); ++cell) {
    HexNodes b;
    const double v = volume(nodes(x, cell), cells_[cell], &b);
    const double dv = (b.array() * nodes(dx, cell).array()).sum();
    const int at = internal_begin_ + 2 * cell;
    const Volumetric U = volumetric(material_, x[at]);
    dx[at] = (v + dv) / cells_[cell].volume - 1 - x[at];
    dx[at + 1] = U.slope + U.curvature * dx[at] - x[at + 1];
  }
}

void Strain::settle(Vector& x) const {
  for (int cell = 0; cell < cells(); ++cell) {
    const int at = internal_begin_ + 2 * cell;
    x[at] = volume(nodes(x, cell), cells_[cell], nullptr) / cells_[cell].volume - 1;
    x[at + 1] = volumetric(material_, x[at]).slope;
  }
}

Strain::CellStress Strain::stress(const Vector& x, int cell) const {
  const HexReference& ref = cells_[cell];
  const HexNodes positions = nodes(x, cell);
  const double p = x[internal_begin_ + 2 * cell + 1];
  CellStress result;
  double v = 0;
  for (int q = 0; q < ref.points; ++q) {
    const Matrix3 F = positions * ref.gradient[q].transpose();
    const Matrix3 C = cofactor(F);
    const double J = F.col(0).dot(C.col(0));
    const Matrix3 P =
        std::visit([&](const auto& m) -> Matrix3 { return m.stress(F, C / J, J); }, material_);
    result.cauchy += ref.weight[q] * (P * F.transpose() + p * J * Matrix3::Identity());
    v += ref.weight[q] * J;
  }
  const HexReference& whole = gauss_.empty() ? ref : gauss_[cell];
  for (const auto& gradient : whole.gradient)
    result.least_jacobian =
        std::min(result.least_jacobian, (positions * gradient.transpose()).determinant());
  result.jacobian = v / ref.volume;
  result.cauchy /= v;
  return result;
}

}  // namespace bight::solid3d
