#pragma once

#include "mechanics/types.h"

namespace bight::rod1d {

/// The unit tangents of two neighbouring segments x0-x1-x2, and how a function of them depends on
/// the nodes.
struct TwoTangents {
  double l0, l1;  ///< lengths of the segments
  Vector3 t0, t1;

  explicit TwoTangents(const Eigen::Matrix<double, 9, 1>& x) {
    const Vector3 e0 = x.segment<3>(3) - x.head<3>(), e1 = x.tail<3>() - x.segment<3>(3);
    l0 = e0.norm(), l1 = e1.norm();
    t0 = e0 / l0, t1 = e1 / l1;
  }

  /// d(t0, t1)/d(x0, x1, x2), with dt/de = (I - t t')/l.
  Eigen::Matrix<double, 6, 9> derivative() const {
    const Matrix3 P0 = across(t0) / l0, P1 = across(t1) / l1;
    Eigen::Matrix<double, 6, 9> J = Eigen::Matrix<double, 6, 9>::Zero();
    J.block<3, 3>(0, 0) = -P0, J.block<3, 3>(0, 3) = P0;
    J.block<3, 3>(3, 3) = -P1, J.block<3, 3>(3, 6) = P1;
    return J;
  }

  /// g . d2(t0, t1)/dx2 for the gradient g by (t0, t1): with p = (I - t t') g,
  /// g . d2t/de2 = -(t p' + p t' + (g . t)(I - t t'))/l^2.
  Eigen::Matrix<double, 9, 9> second(const Eigen::Matrix<double, 6, 1>& g) const {
    Eigen::Matrix<double, 9, 9> H = Eigen::Matrix<double, 9, 9>::Zero();
    const auto add = [&](int at, const Vector3& t, double l, const Vector3& by_t) {
      const Vector3 p = across(t) * by_t;
      const Matrix3 h =
          -(t * p.transpose() + p * t.transpose() + by_t.dot(t) * across(t)) / (l * l);
      H.block<3, 3>(at, at) += h, H.block<3, 3>(at, at + 3) -= h;
      H.block<3, 3>(at + 3, at) -= h, H.block<3, 3>(at + 3, at + 3) += h;
    };
    add(0, t0, l0, g.head<3>());
    add(3, t1, l1, g.tail<3>());
    return H;
  }

 private:
  static Matrix3 across(const Vector3& t) { return Matrix3::Identity() - t * t.transpose(); }
};

}  // namespace bight::rod1d
