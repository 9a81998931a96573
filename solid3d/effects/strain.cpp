#include "solid3d/effects/strain.h"

#include <algorithm>
#include <type_traits>

#include "solid3d/effects/three_field.h"

namespace bight::solid3d {

namespace {

/// Of a vector of HexReference: the degree.
template <int degree>
constexpr std::integral_constant<int, degree> degree_of(const std::vector<HexReference<degree>>&) {
  return {};
}

/// The coefficients of dilatation and pressure of a cell whose internal coordinates begin there.
template <int degree>
HexModes<degree> dilatation(const Vector& x, int at) {
  return x.segment<hex_modes<degree>>(at);
}
template <int degree>
HexModes<degree> pressure(const Vector& x, int at) {
  return x.segment<hex_modes<degree>>(at + hex_modes<degree>);
}

}  // namespace

Strain::Strain(const HexMesh& mesh, int internal_begin, Material material, Quadrature quadrature,
               int first_cell)
    : material_(std::move(material)),
      internal_begin_(internal_begin),
      first_cell_(first_cell),
      cells_(static_cast<int>(mesh.cells.size())),
      nodes_per_cell_(mesh.degree == 1 ? hex_nodes<1> : hex_nodes<2>),
      internals_per_cell_(internals_per_cell(mesh.degree)) {
  if (mesh.degree == 1)
    reference_ = reference<1>(mesh, quadrature);
  else
    reference_ = reference<2>(mesh, quadrature);
  if (quadrature != Quadrature::gauss) gauss_ = reference<1>(mesh, Quadrature::gauss);
  for (const HexCell& cell : mesh.cells)
    for (const int node : cell)
      for (int c = 0; c < 3; ++c) coordinates_.push_back(3 * node + c);
}

template <int degree>
Strain::Cells<degree> Strain::reference(const HexMesh& mesh, Quadrature quadrature) const {
  Cells<degree> all;
  for (const HexCell& cell : mesh.cells)
    all.push_back(hex_reference<degree>(cell_nodes<degree>(mesh, cell), quadrature));
  return all;
}

template <int degree>
HexNodes<degree> Strain::nodes(const Vector& x, int cell) const {
  constexpr int n = hex_nodes<degree>;
  HexNodes<degree> positions;
  for (int a = 0; a < n; ++a)
    positions.col(a) = x.segment<3>(coordinates_[static_cast<size_t>(3 * (cell * n + a))]);
  return positions;
}

void Strain::element(const Vector& x, int stencil, Order order, ElementSlot& slot) const {
  const int cell = first_cell_ + stencil;
  std::visit(
      [&](const auto& material, const auto& cells) {
        constexpr int degree = decltype(degree_of(cells))::value;
        three_field<degree>(material, cells[cell], nodes<degree>(x, cell),
                            dilatation<degree>(x, internal(cell)),
                            pressure<degree>(x, internal(cell)), order, slot);
      },
      material_, reference_);
}

void Strain::recover(const Vector& x, Vector& dx) const {
  std::visit(
      [&](const auto& material, const auto& cells) {
        constexpr int degree = decltype(degree_of(cells))::value;
#pragma omp parallel for schedule(static)
        for (int cell = 0; cell < cells_; ++cell) {
          const int at = internal(cell);
          recover_fields<degree>(material, cells[cell], nodes<degree>(x, cell),
                                 nodes<degree>(dx, cell), dilatation<degree>(x, at),
                                 pressure<degree>(x, at), &dx[at], &dx[at + hex_modes<degree>]);
        }
      },
      material_, reference_);
}

void Strain::settle(Vector& x) const {
  std::visit(
      [&](const auto& material, const auto& cells) {
        constexpr int degree = decltype(degree_of(cells))::value, modes = hex_modes<degree>;
        for (int cell = 0; cell < cells_; ++cell) {
          const int at = internal(cell);
          const auto v = cell_volume<degree>(cells[cell], nodes<degree>(x, cell), false).v;
          const HexModes<degree> t = v / cells[cell].volume - HexModes<degree>::Unit(0);
          x.segment<modes>(at) = t;
          x.segment<modes>(at + modes) =
              cell_volumetric<degree>(material, cells[cell], t).slope / cells[cell].volume;
        }
      },
      material_, reference_);
}

Strain::CellStress Strain::stress(const Vector& x, int cell) const {
  CellStress result;
  const auto measure = [&](const auto& material, const auto& cells) {
    constexpr int degree = decltype(degree_of(cells))::value;
    const HexReference<degree>& ref = cells[cell];
    const HexNodes<degree> positions = nodes<degree>(x, cell);
    const HexModes<degree> p = pressure<degree>(x, internal(cell));
    double v = 0;
    for (int q = 0; q < ref.points; ++q) {
      const Matrix3 F = positions * ref.gradient[q].transpose();
      const Matrix3 C = cofactor(F);
      const double J = F.col(0).dot(C.col(0));
      const Matrix3 P = material.stress(F, C / J, J);
      result.cauchy +=
          ref.weight[q] * (P * F.transpose() + p.dot(ref.mode[q]) * J * Matrix3::Identity());
      result.least_jacobian = std::min(result.least_jacobian, J);
      v += ref.weight[q] * J;
    }
    result.jacobian = v / ref.volume;
    result.cauchy /= v;
  };
  std::visit(measure, material_, reference_);
  if (!gauss_.empty())
    for (const auto& gradient : gauss_[cell].gradient)
      result.least_jacobian =
          std::min(result.least_jacobian, (nodes<1>(x, cell) * gradient.transpose()).determinant());
  return result;
}

double Strain::least_jacobian(const Vector& x) const {
  double least = 1;
#pragma omp parallel for schedule(static) reduction(min : least)
  for (int cell = 0; cell < cells_; ++cell) least = std::min(least, stress(x, cell).least_jacobian);
  return least;
}

}  // namespace bight::solid3d
