#pragma once

#include <array>
#include <variant>
#include <vector>

#include "mechanics/effect.h"
#include "solid3d/hex_reference.h"
#include "solid3d/material.h"

namespace bight::solid3d {

/// Strain energy of three-field hexahedra: displacement of degree 1 or 2 along every side,
/// dilatation theta and pressure p in each cell for itself, constant (degree 1) or linear (2),
///
///   Pi = int W(F) + U(theta) + p (det F - theta) dV,
///   theta = 1 + sum_k t_k M_k,   p = sum_k p_k M_k,
///
/// W and U of the material, M_k the modes of hex_reference.h; at Gauss points (Q1-P0, Q2-P1), or
/// with the mean F of the cell. Simo, Taylor and Pister (1985), eq. 2.20; Q2-P1: Sussman and Bathe,
/// Comput. Struct. 26, 357 (1987). t_k and p_k are internal coordinates, condensed in each cell and
/// recovered after each Newton step. Their use: the geometric stiffness sees a pressure that was
/// predicted linearly; from the displacement it would be K times the second-order volume error of a
/// large rotation.
class Strain : public Effect {
 public:
  /// The positions of node n are coordinates 3n ...; t_k and then p_k of cell c begin at
  /// internal_begin + c internals_per_cell. Only cells from `first_cell` on carry energy.
  Strain(const HexMesh& mesh, int internal_begin, Material material,
         Quadrature quadrature = Quadrature::gauss, int first_cell = 0);

  std::string_view name() const override { return "strain"; }
  int stencils() const override { return cells() - first_cell_; }
  std::span<const int> coordinates(int stencil) const override {
    const size_t per_cell = static_cast<size_t>(3 * nodes_per_cell_);
    return std::span(coordinates_).subspan((first_cell_ + stencil) * per_cell, per_cell);
  }
  void element(const Vector& x, int stencil, Order order, ElementSlot& slot) const override;
  void recover(const Vector& x, Vector& dx) const override;
  void settle(Vector& x) const override;

  /// Cell averages for output: volume ratio v/V and Cauchy stress [E].
  struct CellStress {
    double jacobian = 1;        ///< v / V
    double least_jacobian = 1;  ///< smallest det F over the Gauss points
    Matrix3 cauchy = Matrix3::Zero();
  };
  CellStress stress(const Vector& x, int cell) const;
  /// Smallest det F over the Gauss points of all cells, 1 at most.
  double least_jacobian(const Vector& x) const;

  int cells() const { return cells_; }
  /// Number of internal coordinates.
  int internals() const { return cells_ * internals_per_cell_; }

 private:
  template <int degree>
  using Cells = std::vector<HexReference<degree>>;
  template <int degree>
  Cells<degree> reference(const HexMesh& mesh, Quadrature quadrature) const;
  template <int degree>
  HexNodes<degree> nodes(const Vector& x, int cell) const;
  int internal(int cell) const { return internal_begin_ + cell * internals_per_cell_; }

  Material material_;
  int internal_begin_, first_cell_, cells_, nodes_per_cell_, internals_per_cell_;
  std::variant<Cells<1>, Cells<2>> reference_;
  Cells<1> gauss_;  ///< of cells with another quadrature: where det F is measured
  std::vector<int> coordinates_;
};

}  // namespace bight::solid3d
