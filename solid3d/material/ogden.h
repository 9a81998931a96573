#pragma once

#include <Eigen/SVD>
#include <algorithm>
#include <string_view>
#include <vector>

#include "solid3d/material/parameters.h"
#include "solid3d/material/parts.h"

namespace bight::solid3d {

/// Ogden's solid, W = sum 2 mu_p/a_p^2 (b1^a_p + b2^a_p + b3^a_p - 3) of the isochoric principal
/// stretches b = J^(-1/3) l, and U = K/2 (theta - 1)^2. In this form, that of Abaqus, the moduli
/// sum to mu_s; in Ogden's own, Proc. R. Soc. Lond. A 326, 565 (1972), they are 2 mu_p/a_p.
struct Ogden {
  static constexpr std::string_view name = "ogden";
  double shear_modulus = 1.0 / 3, bulk_modulus = 1000.0 / 3;  ///< mu_s, K [E]
  std::vector<OgdenTerm> terms{{}};

  static Ogden from(const MaterialParameters& p) {
    return {p.shear_modulus(), p.bulk_modulus(), p.ogden};
  }

  Volumetric volumetric(double theta_1) const {
    return quadratic_volumetric(bulk_modulus, theta_1);
  }

  double energy(const Matrix3& F, double J) const {
    const Vector3 l = Eigen::JacobiSVD<Matrix3>(F).singularValues();
    double sum = 0;
    for (const auto& [share, a] : terms)
      sum += share / (a * a) * (std::pow(J, -a / 3) * l.array().pow(a).sum() - 3);
    return 2 * shear_modulus * sum;
  }

  /// F = sum l_i u_i v_i^T, P = sum w_i u_i v_i^T with w_i = dW/dl_i.
  Matrix3 stress(const Matrix3& F, const Matrix3&, double J) const {
    const Principal p(F);
    return p.U * slopes(p.l, J).asDiagonal() * p.V.transpose();
  }

  /// In the base u_i v_j: w_ij among the stretches; of a pair i, j, (w_i - w_j)/(l_i - l_j) on the
  /// symmetric and (w_i + w_j)/(l_i + l_j) on the antisymmetric half of u_i v_j, u_j v_i.
  /// Ogden, Non-linear Elastic Deformations (1984), eq. 6.1.45.
  Matrix9 tangent(const Matrix3& F, const Matrix3&, double J) const {
    const Principal p(F);
    const Vector3 w = slopes(p.l, J);
    Matrix9 base;  // column i + 3j: u_i v_j^T
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        Matrix3::Map(base.col(i + 3 * j).data()) = p.U.col(i) * p.V.col(j).transpose();
    Matrix9 inner = Matrix9::Zero();
    const Matrix3 curved = curvatures(p.l, J);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) inner(4 * i, 4 * j) = curved(i, j);
    for (int i = 0; i < 3; ++i)
      for (int j = i + 1; j < 3; ++j) {
        const double symmetric = slope_quotient(p.l, J, i, j);
        const double antisymmetric = (w[i] + w[j]) / (p.l[i] + p.l[j]);
        const int ij = i + 3 * j, ji = j + 3 * i;
        inner(ij, ij) = inner(ji, ji) = 0.5 * (symmetric + antisymmetric);
        inner(ij, ji) = inner(ji, ij) = 0.5 * (symmetric - antisymmetric);
      }
    return base * inner * base.transpose();
  }

 private:
  struct Principal {
    explicit Principal(const Matrix3& F) {
      const Eigen::JacobiSVD<Matrix3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
      U = svd.matrixU(), V = svd.matrixV(), l = svd.singularValues();
    }
    Matrix3 U, V;
    Vector3 l;
  };

  /// w_i = sum 2 mu_p/a J^(-a/3) (l_i^(a-1) - S/(3 l_i)), S = sum_j l_j^a.
  Vector3 slopes(const Vector3& l, double J) const {
    Vector3 w = Vector3::Zero();
    for (const auto& [share, a] : terms) {
      const Eigen::Array3d power = l.array().pow(a);
      w.array() += factor(share, a, J) * (power - power.sum() / 3) / l.array();
    }
    return w;
  }

  /// l_i l_j w_ij = sum 2 mu_p/a J^(-a/3) (a/9 S - a/3 (l_i^a + l_j^a)), and on the diagonal
  /// (a - 1) l_i^a + S/3 more in the bracket.
  Matrix3 curvatures(const Vector3& l, double J) const {
    Matrix3 w = Matrix3::Zero();
    for (const auto& [share, a] : terms) {
      const Eigen::Array3d power = l.array().pow(a);
      const double S = power.sum(), c = factor(share, a, J);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          double entry = -a / 3 * (power[i] + power[j]) + a / 9 * S;
          if (i == j) entry += (a - 1) * power[i] + S / 3;
          w(i, j) += c * entry / (l[i] * l[j]);
        }
    }
    return w;
  }

  /// (w_i - w_j)/(l_i - l_j) = sum 2 mu_p/a J^(-a/3) (q + S/(3 l_i l_j)) without a difference of
  /// near stretches: with t = ln(l_i/l_j), q = (l_i^m - l_j^m)/(l_i - l_j) is
  /// l_j^(m-1) expm1(m t)/expm1(t), m = a - 1, whose limit is m l_j^(m-1).
  double slope_quotient(const Vector3& l, double J, int i, int j) const {
    const double t = std::log1p((l[i] - l[j]) / l[j]);
    double sum = 0;
    for (const auto& [share, a] : terms) {
      const double m = a - 1, ratio = t == 0 ? m : std::expm1(m * t) / std::expm1(t);
      sum += factor(share, a, J) *
             (std::pow(l[j], m - 1) * ratio + l.array().pow(a).sum() / (3 * l[i] * l[j]));
    }
    return sum;
  }

  /// 2 mu_p/a J^(-a/3).
  double factor(double share, double a, double J) const {
    return 2 * shear_modulus * share / a * std::pow(J, -a / 3);
  }
};

}  // namespace bight::solid3d
