#pragma once

#include <vector>

#include "mechanics/effect.h"
#include "solid3d/hex_reference.h"

namespace bight::solid3d {

/// What holds the twelve modes of a hexahedron that its mean strain does not see. With
///
///   x(xi) = affine + sum_m q_m h_m(xi),   h = eta zeta, xi zeta, xi eta, xi eta zeta,
///   q_m = sum_a x_a gamma_ma   (gamma vanishes on affine fields: Flanagan and Belytschko, Int. J.
///                               Numer. Methods Eng. 17, 679 (1981), eq. 36),
///
/// the energy is that of a brick of incompressible material of modulus mu_s, whose volume is the
/// business of the cell's pressure. With Y_im = cof F e_i . q_m, F the cell's mean deformation, e_i
/// the unit vector along its sides and l_i half of these, it has three parts:
///
///   sum_m c_m |q_m|^2 / 2, which mu_s/2 F:F makes of twist at any strain;
///   mu V/6 (sum_i Y_ii/l_i)^2, the rest of twist for unequal sides;
///   the rest of bending, 2 mu_s (a^2 + a b + b^2) of stretches a = Y_ik/l_i, b = Y_ki/l_k that
///   vary with xi_j, where direction j is free to follow and there is no parasitic shear (assumed
///   strain, Belytschko and Bindeman, Comput. Methods Appl. Mech. Eng. 105, 225 (1993)).
///
/// None feels a rotation. All are polynomials of the positions, with exact derivatives.
class Hourglass : public Effect {
 public:
  /// Positions of node n are coordinates 3n ...; `factor` scales the energy. Only cells from
  /// `first_cell` on carry any.
  Hourglass(const HexMesh& mesh, double shear_modulus, double factor = 1, int first_cell = 0);

  std::string_view name() const override { return "hourglass"; }
  int stencils() const override { return static_cast<int>(cells_.size()); }
  std::span<const int> coordinates(int stencil) const override {
    return cells_[static_cast<size_t>(stencil)].coordinates;
  }
  void element(const Vector& x, int stencil, Order order, ElementSlot& slot) const override;

 private:
  using Vector4 = Eigen::Matrix<double, 4, 1>;
  using Matrix9 = Eigen::Matrix<double, 9, 9>;
  struct Cell {
    std::array<int, 24> coordinates;
    /// cof F e_i = u x v, u = sum_a x_a first_ai, v = sum_a x_a second_ai [1/D]
    Eigen::Matrix<double, 8, 3> first, second;
    Eigen::Matrix<double, 8, 4> gamma;
    Vector4 isotropic;  ///< c_m [E D]
    Matrix9 stiffness;  ///< of Y_im at i + 3m, m < 3 [E D]
  };
  static void set_stiffness(Cell& cell, const Vector3& l, double mu_volume);

  std::vector<Cell> cells_;
};

}  // namespace bight::solid3d
