#include <Eigen/Geometry>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "rod1d/rod_problem.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

/// A rod of unit length and bending stiffness that is a helix when free, clamped above with its
/// tangent down, under its own weight.
struct Helix {
  double twisting_stiffness = 1 / 1.5, curvature = 8, twist = 3, weight = 20;
  Vector3 down = -Vector3::UnitZ();
  Vector3 d1 = down.unitOrthogonal();  ///< as the first frame of a rod along `down`
};

/// Kirchhoff's equations of the inextensible rod, by shooting. In the material frame R = (d1, d2,
/// t) with the strains u (two curvatures, twist) and the moment m = K (u - u0):
///
///   R' = R [u]x,   m' = -u x m - e3 x R'n,   n = weight below;   m = 0 at the free end
struct Shooting {
  explicit Shooting(const Helix& helix) : helix(helix) {}

  struct State {
    Vector3 r = Vector3::Zero();
    Matrix3 R;
    Vector3 m;
  };
  State rate(double s, const State& at) const {
    const Vector3 stiffness(1, 1, helix.twisting_stiffness);
    const Vector3 u =
        Vector3(helix.curvature, 0, helix.twist) + at.m.cwiseQuotient(stiffness).eval();
    const Vector3 n = helix.weight * (1 - s) * helix.down;
    State d;
    d.r = at.R.col(2);
    for (int k = 0; k < 3; ++k) d.R.col(k) = (at.R * u).cross(at.R.col(k));
    d.m = -u.cross(at.m) - Vector3::UnitZ().cross(at.R.transpose() * n);
    return d;
  }
  static State moved(const State& a, double h, const State& d) {
    return {a.r + h * d.r, a.R + h * d.R, a.m + h * d.m};
  }
  /// Runge-Kutta of fourth order from the clamp, where the moment is m0.
  State end(const Vector3& m0) const {
    State y;
    y.R << helix.d1, helix.down.cross(helix.d1), helix.down;
    y.m = m0;
    const int steps = 2000;
    const double h = 1.0 / steps;
    for (int i = 0; i < steps; ++i) {
      const double s = i * h;
      const State a = rate(s, y), b = rate(s + 0.5 * h, moved(y, 0.5 * h, a));
      const State c = rate(s + 0.5 * h, moved(y, 0.5 * h, b)), d = rate(s + h, moved(y, h, c));
      y = moved(moved(moved(moved(y, h / 6, a), h / 3, b), h / 3, c), h / 6, d);
    }
    return y;
  }
  Vector3 tip() {
    const double full = helix.weight;
    Vector3 m = Vector3::Zero();
    for (const double part : {0.25, 0.5, 0.75, 1.0}) {
      helix.weight = part * full;
      for (int k = 0; k < 20; ++k) {
        const Vector3 miss = end(m).m;
        if (miss.norm() < 1e-11) break;
        Matrix3 J;
        for (int c = 0; c < 3; ++c) {
          const Vector3 step = 1e-6 * Vector3::Unit(c);
          J.col(c) = (end(m + step).m - end(m - step).m) / 2e-6;
        }
        m -= J.lu().solve(miss);
      }
    }
    CHECK(end(m).m.norm() < 1e-9);
    return end(m).r;
  }
  Helix helix;
};

Vector3 tip_of_rod(const Helix& helix, int segments) {
  Rod rod = uniform_rod(1, segments, 0.5);
  const double h = 1 / (segments - 0.5);  // the clamp ends in the middle of the first segment
  rod.rest_length.assign(segments, h);
  rod.bending_stiffness = 1;
  rod.twisting_stiffness = helix.twisting_stiffness;
  rod.stretching_stiffness = 1e6;
  rod.rest_curvature.assign(rod.nodes(), Vector2(helix.curvature * h, 0));
  rod.rest_twist.assign(rod.nodes(), helix.twist * h);
  Polyline line;
  for (int i = 0; i <= segments; ++i) line.push_back((i - 0.5) * h * helix.down);
  RodProblem problem(rod, line, true);
  problem.hold(0), problem.hold(1), problem.hold_angle(0);
  REQUIRE(problem.solve(2000).ok());
  problem.weigh(helix.weight * helix.down);
  REQUIRE(problem.solve(2000).ok());
  return problem.nodes().back();
}

}  // namespace

TEST_CASE("a helix under its own weight hangs as Kirchhoff's equations say") {
  const Helix helix;
  const Vector3 exact = Shooting(helix).tip();
  Helix free = helix;
  free.weight = 0;
  const double stretched = (exact - Shooting(free).tip()).norm();
  const double coarse = (tip_of_rod(helix, 40) - exact).norm();
  const double fine = (tip_of_rod(helix, 80) - exact).norm();
  INFO("tip " << exact.transpose() << ", moved by " << stretched << "; errors " << coarse << ", "
              << fine);
  CHECK(stretched > 0.1);
  CHECK(fine < 2e-3);
  CHECK(coarse / fine == Approx(4).epsilon(0.15));
}
