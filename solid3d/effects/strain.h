#pragma once

#include <vector>

#include "mechanics/effect.h"
#include "solid3d/hex.h"
#include "solid3d/material.h"

namespace bight::solid3d {

/// Strain energy of three-field hexahedra: displacement trilinear, dilatation theta and pressure p
/// constant in a cell,
///
///   Pi = int W(F) dV + V U(theta) + p (v - V theta),   v = int det F dV,
///
/// W and U of the material; at Gauss points (Q1-P0), or with the mean F of the cell.
/// Simo, Taylor and Pister (1985), eq. 2.20. theta - 1 and p are internal coordinates, condensed in
/// each cell and recovered after each Newton step. Their use: the geometric stiffness sees a
/// pressure that was predicted linearly; from the displacement it would be K times the
/// second-order volume error of a large rotation.
class Strain : public Effect {
 public:
  /// The positions of node n are coordinates 3n ...; the internal pair of cell c is at
  /// internal_begin + 2c. Only cells from `first_cell` on carry energy.
  Strain(const HexMesh& mesh, int internal_begin, Material material,
         Quadrature quadrature = Quadrature::gauss, int first_cell = 0);

  std::string_view name() const override { return "strain"; }
  int stencils() const override { return cells() - first_cell_; }
  std::span<const int> coordinates(int stencil) const override {
    return coordinates_[static_cast<size_t>(first_cell_ + stencil)];
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

  int cells() const { return static_cast<int>(cells_.size()); }

 private:
  HexNodes nodes(const Vector& x, int cell) const;
  /// Current volume v and its gradient b = dv/dx.
  double volume(const HexNodes& x, const HexReference& cell, HexNodes* gradient) const;

  template <class M>
  void element_of(const M& material, const Vector& x, int cell, Order order,
                  ElementSlot& slot) const;

  Material material_;
  int internal_begin_, first_cell_;
  std::vector<HexReference> cells_;
  std::vector<HexReference> gauss_;  ///< of cells with another quadrature: where det F is measured
  std::vector<std::array<int, 24>> coordinates_;
};

}  // namespace bight::solid3d
