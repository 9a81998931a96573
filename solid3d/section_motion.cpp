#include "solid3d/section_motion.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>

namespace bight::solid3d {

Matrix3 rotation_by(const Vector3& w) {
  const double angle = w.norm();
  if (angle == 0) return Matrix3::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

Vector3 rotation_vector(const Matrix3& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

Vector3 seen_from(const SectionPlace& place, const Vector& x, int at) {
  return place.rotation.transpose() * (x.segment<3>(at) - place.centre);
}

std::vector<SectionPlace> section_places(const Mesh& mesh, const Vector& x) {
  const int per_layer = mesh.points_per_layer();
  Vector2 reference_centre = Vector2::Zero();
  for (const Vector2& p : mesh.section.points) reference_centre += p / per_layer;
  std::vector<SectionPlace> places(static_cast<size_t>(mesh.layers()));
#pragma omp parallel for schedule(static)
  for (int k = 0; k < mesh.layers(); ++k) {
    const auto nodes =
        Eigen::Map<const Eigen::Matrix3Xd>(x.data() + 3 * mesh.node(k, 0), 3, per_layer);
    const Vector3 centre = nodes.rowwise().mean();
    // A flat section fixes two axes; the third is their cross product.
    Eigen::Matrix<double, 3, 2> C = Eigen::Matrix<double, 3, 2>::Zero();
    for (int p = 0; p < per_layer; ++p)
      C += (nodes.col(p) - centre) * (mesh.section.points[p] - reference_centre).transpose();
    const Eigen::JacobiSVD<Eigen::Matrix<double, 3, 2>> svd(
        C, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix<double, 3, 2> axes =
        svd.matrixU().leftCols<2>() * svd.matrixV().transpose();
    Matrix3 R;
    R << axes, axes.col(0).cross(axes.col(1));
    places[k] = {centre, R};
  }
  return places;
}

/// Coordinates of all strands together; what is behind them is no position.
Eigen::Index positions(std::span<const Mesh> strands) {
  return 3 * static_cast<Eigen::Index>(strands.back().first_node + strands.back().nodes());
}

void advance_strand(const Mesh& mesh, Vector& x, const Vector& dx) {
  const int per_layer = mesh.points_per_layer();
#pragma omp parallel for schedule(static)
  for (int k = 0; k < mesh.layers(); ++k) {
    auto nodes = Eigen::Map<Eigen::Matrix3Xd>(x.data() + 3 * mesh.node(k, 0), 3, per_layer);
    const auto step =
        Eigen::Map<const Eigen::Matrix3Xd>(dx.data() + 3 * mesh.node(k, 0), 3, per_layer);
    const Vector3 centre = nodes.rowwise().mean(), shift = step.rowwise().mean();
    // Least squares: (sum |r|^2 1 - r r^T) w = sum r x d
    Matrix3 inertia = Matrix3::Zero();
    Vector3 moment = Vector3::Zero();
    for (int p = 0; p < per_layer; ++p) {
      const Vector3 r = nodes.col(p) - centre;
      inertia += r.squaredNorm() * Matrix3::Identity() - r * r.transpose();
      moment += r.cross(step.col(p) - shift);
    }
    const Vector3 w = inertia.ldlt().solve(moment);
    const Matrix3 R = rotation_by(w);
    for (int p = 0; p < per_layer; ++p) {
      const Vector3 r = nodes.col(p) - centre;
      const Vector3 strain = step.col(p) - shift - w.cross(r);
      nodes.col(p) = centre + shift + R * (r + strain);
    }
  }
}

void advance_sections(std::span<const Mesh> strands, Vector& x, const Vector& dx) {
  for (const Mesh& mesh : strands) advance_strand(mesh, x, dx);
  const Eigen::Index behind = x.size() - positions(strands);
  x.tail(behind) += dx.tail(behind);
}

/// Rates of a section's motion in its own frame, per unit of ebar.
struct Screw {
  Vector3 turn, shift;
};

Screw screw(const SectionPlace& from, const SectionPlace& to, double de) {
  return {rotation_vector(from.rotation.transpose() * to.rotation) / de,
          from.rotation.transpose() * (to.centre - from.centre) / de};
}

/// Moves a strand of x, its newest state, on to `ebar`.
void extrapolate_strand(const Mesh& mesh, const std::vector<Station>& states, double ebar,
                        Vector& x) {
  const Station &now = states.back(), &before = states[states.size() - 2];
  const Station& first = states[std::max<size_t>(states.size(), 3) - 3];
  const bool three = states.size() > 2;
  const double de = ebar - now.ebar, last = now.ebar - before.ebar;
  const double earlier = before.ebar - first.ebar;
  const auto places = section_places(mesh, now.x), old = section_places(mesh, before.x);
  const auto oldest = three ? section_places(mesh, first.x) : std::vector<SectionPlace>();
  // Rates belong to the middles of the steps: linear extrapolation to the middle of the next.
  const auto further = [&](const Vector3& rate, const Vector3& rate_before) {
    return Vector3(rate + (de + last) / (last + earlier) * (rate - rate_before));
  };
  for (int k = 0; k < mesh.layers(); ++k) {
    Screw rate = screw(old[k], places[k], last);
    if (three) {
      const Screw rate_before = screw(oldest[k], old[k], earlier);
      rate = {further(rate.turn, rate_before.turn), further(rate.shift, rate_before.shift)};
    }
    const Matrix3& R = places[k].rotation;
    const Vector3 centre = places[k].centre + R * (de * rate.shift);
    const Matrix3 turned = R * rotation_by(de * rate.turn);
    for (int p = 0; p < mesh.points_per_layer(); ++p) {
      const int at = 3 * mesh.node(k, p);
      const Vector3 mine = seen_from(places[k], now.x, at), was = seen_from(old[k], before.x, at);
      Vector3 strain = (mine - was) / last;
      if (three) strain = further(strain, (was - seen_from(oldest[k], first.x, at)) / earlier);
      x.segment<3>(at) = centre + turned * (mine + de * strain);
    }
  }
}

Vector extrapolate_sections(std::span<const Mesh> strands, const std::vector<Station>& states,
                            double ebar) {
  const Station &now = states.back(), &before = states[states.size() - 2];
  Vector x = now.x;
  for (const Mesh& mesh : strands) extrapolate_strand(mesh, states, ebar, x);
  const Eigen::Index behind = x.size() - positions(strands);
  x.tail(behind) +=
      (ebar - now.ebar) / (now.ebar - before.ebar) * (now.x.tail(behind) - before.x.tail(behind));
  return x;
}

}  // namespace bight::solid3d
