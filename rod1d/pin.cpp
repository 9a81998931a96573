#include "rod1d/pin.h"

#include <Eigen/Geometry>
#include <cmath>

namespace bight::rod1d {

double radius_of(const Vector& x, int node) { return x.segment<2>(Rod::position(node)).norm(); }

int farthest_node(const Rod& rod, const Vector& x) {
  int farthest = 0;
  for (int i = 0; i < rod.nodes(); ++i)
    if (radius_of(x, i) > radius_of(x, farthest) + 1e-9) farthest = i;
  return radius_of(x, farthest) > 0 ? farthest : -1;
}

Matrix3 turn_to_x(const Vector& x, int node) {
  const Vector3 p = x.segment<3>(Rod::position(node));
  return Eigen::AngleAxisd(-std::atan2(p.y(), p.x()), Vector3::UnitZ()).toRotationMatrix();
}

void turn(const Rod& rod, const Matrix3& by, Vector& x) {
  for (int i = 0; i < rod.nodes(); ++i)
    x.segment<3>(Rod::position(i)) = (by * x.segment<3>(Rod::position(i))).eval();
}

void turn(const Matrix3& by, Frames& frames) {
  for (auto* vectors : {&frames.tangent, &frames.normal})
    for (Vector3& v : *vectors) v = (by * v).eval();
}

}  // namespace bight::rod1d
