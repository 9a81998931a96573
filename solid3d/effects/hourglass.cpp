#include "solid3d/effects/hourglass.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace bight::solid3d {

Hourglass::Hourglass(const HexMesh& mesh, double shear_modulus, double factor, int first_cell) {
  const HexNodes<2>& corner = parent_nodes();
  Eigen::Matrix<double, 8, 4> h;
  for (int a = 0; a < 8; ++a) {
    const Vector3 xi = corner.col(a);
    h.row(a) << xi.y() * xi.z(), xi.x() * xi.z(), xi.x() * xi.y(), xi.prod();
  }
  for (size_t c = static_cast<size_t>(first_cell); c < mesh.cells.size(); ++c) {
    const HexNodes<1> X = cell_nodes<1>(mesh, mesh.cells[c]);
    const HexReference<1> mean = hex_reference<1>(X, Quadrature::mean);
    const Matrix3 sides = X * parent_gradients<1>(Vector3::Zero()).transpose();
    Cell cell;
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) cell.coordinates[3 * a + i] = 3 * mesh.cells[c][a] + i;
    for (int i = 0; i < 3; ++i) {
      const Vector3 e = sides.col(i).normalized(), across = e.unitOrthogonal();
      cell.first.col(i) = mean.gradient[0].transpose() * across;
      cell.second.col(i) = mean.gradient[0].transpose() * e.cross(across);
    }
    cell.gamma = (h - mean.gradient[0].transpose() * (X * h)) / 8;
    set_stiffness(cell, sides.colwise().norm(), factor * shear_modulus * mean.volume);
    cells_.push_back(cell);
  }
}

/// The mean of xi^2 over the cube is 1/3. c_m is that of twist about any axis across a square of
/// the brick, within what leaves the rest of bending positive in flat and long cells.
void Hourglass::set_stiffness(Cell& cell, const Vector3& l, double mu_volume) {
  const Vector3 per = l.cwiseAbs2().cwiseInverse();
  Vector4 c;
  for (int m = 0; m < 3; ++m) {
    const int i = (m + 1) % 3, j = (m + 2) % 3;
    const double low = std::min(per[i], per[j]);
    c[m] = std::clamp(per[i] + per[j] - per[m], low / 4, 2 * low);
  }
  c[3] = per.minCoeff();
  cell.isotropic = mu_volume / 3 * c;

  Matrix9 K = Matrix9::Zero();
  for (int j = 0; j < 3; ++j) {
    const int i = (j + 1) % 3, k = (j + 2) % 3;
    const int a = i + 3 * k, b = k + 3 * i;
    K(a, a) = 4 * per[i] - c[k];
    K(b, b) = 4 * per[k] - c[i];
    K(a, b) = K(b, a) = 2 / (l[i] * l[k]);
    for (int n = 0; n < 3; ++n) K(4 * j, 4 * n) = 1 / (l[j] * l[n]);
  }
  cell.stiffness = mu_volume / 3 * K;
}

void Hourglass::element(const Vector& x, int stencil, Order order, ElementSlot& slot) const {
  using Matrix8 = Eigen::Matrix<double, 8, 8>;
  using Matrix24 = Eigen::Matrix<double, 24, 24>;
  using Vector9 = Eigen::Matrix<double, 9, 1>;
  const Cell& cell = cells_[static_cast<size_t>(stencil)];
  HexNodes<1> nodes;
  for (int a = 0; a < 8; ++a) nodes.col(a) = x.segment<3>(cell.coordinates[3 * a]);
  const Matrix3 u = nodes * cell.first, v = nodes * cell.second;
  const Eigen::Matrix<double, 3, 4> q = nodes * cell.gamma;
  Matrix3 normal, Y;
  for (int i = 0; i < 3; ++i) normal.col(i) = u.col(i).cross(v.col(i));
  Y = normal.transpose() * q.leftCols<3>();
  const Vector9 force = cell.stiffness * Y.reshaped();
  slot.energy =
      0.5 * (Y.reshaped().dot(force) + q.colwise().squaredNorm().transpose().dot(cell.isotropic));
  if (order < Order::gradient) return;

  // dY = (u x v) . dq + (v x q) . du + (q x u) . dv.
  Eigen::Matrix<double, 24, 9> dY;
  for (int m = 0; m < 3; ++m)
    for (int i = 0; i < 3; ++i)
      HexNodes<1>::Map(dY.col(i + 3 * m).data()) =
          normal.col(i) * cell.gamma.col(m).transpose() +
          v.col(i).cross(q.col(m)) * cell.first.col(i).transpose() +
          q.col(m).cross(u.col(i)) * cell.second.col(i).transpose();
  const Eigen::Matrix<double, 8, 4> stiff = cell.gamma * cell.isotropic.asDiagonal();
  HexNodes<1>::Map(slot.gradient) = q * stiff.transpose() + (dY * force).reshaped(3, 8);
  if (order < Order::hessian) return;

  Matrix24 H = dY * cell.stiffness * dY.transpose();
  // Second derivatives of the products are cross products with Z_ab = -Z_ba, by component: those of
  // q and u meet in v, those of u and v in q, those of v and q in u. Sums over m are taken first.
  const Eigen::Map<const Matrix3> s(force.data());
  const Eigen::Matrix<double, 8, 3> P = cell.gamma.leftCols<3>() * s.transpose();
  const Matrix3 sum_q = q.leftCols<3>() * s.transpose();
  std::array<Matrix8, 3> half{Matrix8::Zero(), Matrix8::Zero(), Matrix8::Zero()};
  for (int i = 0; i < 3; ++i) {
    const auto U = cell.first.col(i), V = cell.second.col(i);
    const Matrix8 PU = P.col(i) * U.transpose(), UV = U * V.transpose(),
                  VP = V * P.col(i).transpose();
    for (int d = 0; d < 3; ++d) half[d] += v(d, i) * PU + sum_q(d, i) * UV + u(d, i) * VP;
  }
  const Matrix8 S = stiff * cell.gamma.transpose();
  for (int a = 0; a < 8; ++a)
    for (int b = 0; b < 8; ++b) {
      auto block = H.block<3, 3>(3 * a, 3 * b);
      block.diagonal().array() += S(a, b);
      for (int d = 0; d < 3; ++d) {
        const double Z = half[d](a, b) - half[d](b, a);
        block((d + 1) % 3, (d + 2) % 3) += Z;
        block((d + 2) % 3, (d + 1) % 3) -= Z;
      }
    }
  Matrix24::Map(slot.hessian) = H;
}

}  // namespace bight::solid3d
