#include "solid3d/contact_surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace bight::solid3d {

namespace {

/// Quadratic B-spline weights at t in [-1/2, 1/2] from the middle node, with derivatives.
void quadratic(double t, std::array<double, 3>& w, std::array<double, 3>& dw,
               std::array<double, 3>& ddw) {
  w = {0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)};
  dw = {t - 0.5, -2 * t, t + 0.5};
  ddw = {1, -2, 1};
}

/// The same for control points on a circle, h apart in angle: weights of 1, cos and sin of h t,
/// with which the spline of a regular polygon is a circle, of its radius times cos(h/2).
/// (Trigonometric B-splines: Lyche and Winther, J. Approx. Theory 25, 266, 1979.)
void trigonometric(double t, double h, std::array<double, 3>& w, std::array<double, 3>& dw,
                   std::array<double, 3>& ddw) {
  const double ch = std::cos(0.5 * h), sh = std::sin(0.5 * h);
  const double ct = std::cos(h * t), st = std::sin(h * t);
  const double scale = 0.25 / (sh * sh);
  const double cos_below = ch * ct + sh * st, cos_above = ch * ct - sh * st;  // of h (1/2 -+ t)
  const double sin_below = sh * ct - ch * st, sin_above = sh * ct + ch * st;
  w[0] = scale * (1 - cos_below), w[2] = scale * (1 - cos_above);
  dw[0] = -scale * h * sin_below, dw[2] = scale * h * sin_above;
  ddw[0] = scale * h * h * cos_below, ddw[2] = scale * h * h * cos_above;
  w[1] = 1 - w[0] - w[2], dw[1] = -dw[0] - dw[2], ddw[1] = -ddw[0] - ddw[2];
}

/// Lagrange's parabolas at t in [-1, 1] over the nodes -1, 0, 1, with derivatives.
void parabola(double t, std::array<double, 3>& w, std::array<double, 3>& dw,
              std::array<double, 3>& ddw) {
  w = {0.5 * t * (t - 1), 1 - t * t, 0.5 * t * (t + 1)};
  dw = {t - 0.5, -2 * t, t + 0.5};
  ddw = {1, -2, 1};
}

}  // namespace

ContactSurface::ContactSurface(std::span<const Mesh> strands) {
  for (const Mesh& mesh : strands) {
    const int sides = static_cast<int>(mesh.section.rim.size());
    const double R = mesh.section.points[mesh.section.rim[0]].norm();
    const double skin = 0.5 * mesh.section.diameter - R * std::cos(std::numbers::pi / sides);
    // Radius of a parabola through three points half-way between two of them.
    const Vector2 half_way(0.75 + 0.25 * std::cos(2 * std::numbers::pi / sides),
                           0.5 * std::sin(2 * std::numbers::pi / sides));
    const double face_skin =
        mesh.degree() == 1 ? skin : 0.5 * mesh.section.diameter - R * (1 + 2 * half_way.norm()) / 3;
    const int first = layers();
    for (int k = 0; k < mesh.layers(); ++k) {
      strand_of_.push_back(static_cast<int>(strands_.size()));
      first_patch_.push_back(patches());
      s_.push_back(mesh.s[k]);
      for (int point : mesh.section.rim) {
        along_.push_back(first + k);
        first_.push_back(3 * mesh.node(k, point));
      }
    }
    strands_.push_back(
        {mesh.degree(), sides, first, layers() - 1, mesh.section.diameter, skin, face_skin});
  }
}

double ContactSurface::area(int patch) const {
  const Vector2 e = extent(patch);
  return e.x() * e.y();
}

Vector2 ContactSurface::extent(int patch) const {
  const int k = along(patch);
  return {std::numbers::pi * strand(k).diameter / strand(k).sides, 0.5 * (s_[k + 1] - s_[k - 1])};
}

PatchWeights ContactSurface::weights(double u, double v) const {
  PatchWeights w;
  w.around = static_cast<int>(std::lround(u));
  const int layer = std::clamp(static_cast<int>(std::lround(v)), 0, layers() - 1);
  w.along = std::clamp(layer, strand(layer).first + 1, strand(layer).last - 1);
  trigonometric(u - w.around, 2 * std::numbers::pi / strand(layer).sides, w.u, w.du, w.ddu);
  quadratic(v - w.along, w.v, w.dv, w.ddv);
  return w;
}

PatchWeights ContactSurface::face_weights(double u, double v) const {
  PatchWeights w = weights(u, v);
  const Strand& on = strand(w.along);
  if (on.degree == 1) return w;
  w.around = 2 * static_cast<int>(std::floor(0.5 * u)) + 1;
  w.along = on.first + 2 * static_cast<int>(std::floor(0.5 * (v - on.first))) + 1;
  w.along = std::clamp(w.along, on.first + 1, on.last - 1);
  parabola(u - w.around, w.u, w.du, w.ddu);
  parabola(v - w.along, w.v, w.dv, w.ddv);
  return w;
}

SurfacePoint ContactSurface::evaluate(const Vector& x, const PatchWeights& w) const {
  SurfacePoint p;
  p.y = p.y_u = p.y_v = p.y_uu = p.y_uv = p.y_vv = Vector3::Zero();
  for (int j = 0; j < 3; ++j) {
    Vector3 row = Vector3::Zero(), row_u = row, row_uu = row;
    for (int i = 0; i < 3; ++i) {
      const Vector3 c = x.segment<3>(coordinate(w.around + i - 1, w.along + j - 1));
      row += w.u[i] * c;
      row_u += w.du[i] * c;
      row_uu += w.ddu[i] * c;
    }
    p.y += w.v[j] * row;
    p.y_u += w.v[j] * row_u;
    p.y_uu += w.v[j] * row_uu;
    p.y_v += w.dv[j] * row;
    p.y_uv += w.dv[j] * row_u;
    p.y_vv += w.ddv[j] * row;
  }
  p.normal = p.y_u.cross(p.y_v).normalized();
  return p;
}

std::optional<Vector2> ContactSurface::project(const Vector& x, const Vector3& point,
                                               Vector2 uv) const {
  constexpr int max_iterations = 30;
  constexpr double settled = 1e-11;  // of a parameter, in patches
  const Strand& on = strand(static_cast<int>(std::lround(uv.y())));
  const double v_min = on.first + 0.5, v_max = on.last - 0.5;
  double last = std::numeric_limits<double>::max();
  for (int i = 0; i < max_iterations; ++i) {
    const SurfacePoint p = evaluate(x, weights(uv.x(), uv.y()));
    const Vector3 d = point - p.y;
    const Vector2 slope(p.y_u.dot(d), p.y_v.dot(d));
    const double muu = p.y_u.squaredNorm(), muv = p.y_u.dot(p.y_v), mvv = p.y_v.squaredNorm();
    const Eigen::Matrix2d M = projection_matrix(p, d);
    double a = M(0, 0), b = M(0, 1), c = M(1, 1);
    // Far from the nearest point the exact curvature may be indefinite: Gauss-Newton there, and
    // half of its step where patches of different curvature pass the ball back and forth.
    if (!(a > 0 && a * c - b * b > 0.05 * muu * mvv)) a = muu, b = muv, c = mvv;
    const double det = a * c - b * b;
    Vector2 step((c * slope.x() - b * slope.y()) / det, (a * slope.y() - b * slope.x()) / det);
    const double size = step.cwiseAbs().maxCoeff();
    if (size > 1) step /= size;
    if (i > 8 && size > 0.5 * last) step *= 0.5;
    last = size;
    uv += step;
    if (!(uv.y() > v_min - 1 && uv.y() < v_max + 1)) return std::nullopt;
    if (size < settled) {
      if (uv.y() < v_min || uv.y() > v_max) return std::nullopt;
      return uv;
    }
  }
  return std::nullopt;
}

}  // namespace bight::solid3d
