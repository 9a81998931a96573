#include "rod1d/polyline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bight::rod1d {

double polyline_length(const Polyline& line) {
  double length = 0;
  for (size_t i = 0; i + 1 < line.size(); ++i) length += (line[i + 1] - line[i]).norm();
  return length;
}

Polyline resampled(const Polyline& line, int segments) {
  const double spacing = polyline_length(line) / segments;
  Polyline out{line.front()};
  double begin = 0;  // arc length at line[i]
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const double length = (line[i + 1] - line[i]).norm();
    while (static_cast<int>(out.size()) < segments &&
           begin + length >= spacing * static_cast<double>(out.size())) {
      const double u = (spacing * static_cast<double>(out.size()) - begin) / length;
      out.push_back((1 - u) * line[i] + u * line[i + 1]);
    }
    begin += length;
  }
  out.push_back(line.back());
  return out;
}

Polyline smoothed(Polyline line, double width) {
  const double spacing = polyline_length(line) / static_cast<double>(line.size() - 1);
  // One pass of (1/4, 1/2, 1/4) has the variance spacing^2/2.
  const int passes = static_cast<int>(std::ceil(2 * width * width / (spacing * spacing)));
  for (int pass = 0; pass < passes; ++pass) {
    Vector3 before = line.front();
    for (size_t i = 1; i + 1 < line.size(); ++i) {
      const Vector3 here = line[i];
      line[i] = 0.25 * before + 0.5 * here + 0.25 * line[i + 1];
      before = here;
    }
  }
  return line;
}

Polyline chord_on_axis(const Polyline& line) {
  const Vector3 chord = line.back() - line.front(), middle = 0.5 * (line.front() + line.back());
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(chord, Vector3::UnitZ());
  Polyline out;
  for (const Vector3& p : line) out.push_back(turn * (p - middle));
  return out;
}

namespace {

/// Distance of two segments (Ericson, Real-Time Collision Detection, 5.1.9).
double distance(const Vector3& p, const Vector3& p_end, const Vector3& q, const Vector3& q_end) {
  const Vector3 u = p_end - p, v = q_end - q, r = p - q;
  const double a = u.squaredNorm(), e = v.squaredNorm(), b = u.dot(v), c = u.dot(r), f = v.dot(r);
  const double denominator = a * e - b * b;
  double s =
      denominator > 1e-12 * a * e ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.5;
  const double t = std::clamp((b * s + f) / e, 0.0, 1.0);
  s = std::clamp((b * t - c) / a, 0.0, 1.0);
  return (r + s * u - t * v).norm();
}

}  // namespace

double smallest_distance(const Polyline& line, double apart) {
  std::vector<double> middle;
  double length = 0;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    const double l = (line[i + 1] - line[i]).norm();
    middle.push_back(length + 0.5 * l);
    length += l;
  }
  double smallest = length;
  for (size_t i = 0; i + 1 < line.size(); ++i)
    for (size_t j = i + 1; j + 1 < line.size(); ++j)
      if (middle[j] - middle[i] > apart)
        smallest = std::min(smallest, distance(line[i], line[i + 1], line[j], line[j + 1]));
  return smallest;
}

}  // namespace bight::rod1d
