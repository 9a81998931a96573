#include "coupling/frames.h"

#include <Eigen/Geometry>
#include <cmath>

namespace bight::coupling {

NodeFrames node_frames(const rod1d::RodState& state) {
  const Polyline& x = state.nodes;
  NodeFrames frames;
  Vector3 normal = Vector3::Zero();  // twist-free
  for (size_t i = 0; i < x.size(); ++i) {
    const size_t before = i == 0 ? 0 : i - 1, after = i + 1 == x.size() ? i : i + 1;
    const Vector3 tangent = (x[after] - x[before]).normalized();
    normal = i == 0 ? tangent.unitOrthogonal()
                    : Eigen::Quaterniond::FromTwoVectors(frames.d3.back(), tangent) * normal;
    normal = (normal - tangent.dot(normal) * tangent).normalized();
    const double twist = state.twist_angle.empty()
                             ? 0.0
                             : 0.5 * (state.twist_angle[before] +
                                      state.twist_angle[std::min(i, state.twist_angle.size() - 1)]);
    frames.d1.push_back(std::cos(twist) * normal + std::sin(twist) * tangent.cross(normal));
    frames.d2.push_back(tangent.cross(frames.d1.back()));
    frames.d3.push_back(tangent);
  }
  return frames;
}

}  // namespace bight::coupling
