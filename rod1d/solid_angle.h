#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "mechanics/types.h"

namespace bight::rod1d {

/// Area of the spherical triangle a, b, c of unit vectors, positive when it is seen anticlockwise
/// from outside, within (-2 pi, 2 pi):
///
///   2 atan2(N, M),  N = a . (b x c),  M = 1 + a . b + b . c + c . a
///
/// (Van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30, 125, 1983.) It is the angle by which
/// parallel transport around the triangle turns a vector. With the derivatives by b and c.
struct SolidAngle {
  double value = 0;
  Eigen::Matrix<double, 6, 1> gradient;
  Eigen::Matrix<double, 6, 6> hessian;

  SolidAngle(const Vector3& a, const Vector3& b, const Vector3& c) {
    const double N = a.dot(b.cross(c)), M = 1 + a.dot(b) + b.dot(c) + c.dot(a);
    const double R = N * N + M * M;
    value = 2 * std::atan2(N, M);
    Eigen::Matrix<double, 6, 1> dN, dM;
    dN << c.cross(a), a.cross(b);
    dM << a + c, a + b;
    gradient = (2 / R) * (M * dN - N * dM);
    // Second derivatives of 2 atan2: -4 N M/R^2 by N twice, the opposite by M twice,
    // 2 (N^2 - M^2)/R^2 mixed.
    const double nn = -4 * N * M / (R * R), nm = 2 * (N * N - M * M) / (R * R);
    hessian = nn * (dN * dN.transpose() - dM * dM.transpose()) +
              nm * (dN * dM.transpose() + dM * dN.transpose());
    Matrix3 cross;  // d(c x a)/dc
    cross << 0, a.z(), -a.y(), -a.z(), 0, a.x(), a.y(), -a.x(), 0;
    const Matrix3 mixed = (2 / R) * (M * cross - N * Matrix3::Identity());
    hessian.topRightCorner<3, 3>() += mixed;
    hessian.bottomLeftCorner<3, 3>() += mixed.transpose();
  }
};

inline double solid_angle(const Vector3& a, const Vector3& b, const Vector3& c) {
  return 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

}  // namespace bight::rod1d
