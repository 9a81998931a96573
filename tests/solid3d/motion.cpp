#include <catch2/catch.hpp>
#include <cmath>

#include "solid3d/effects/gravity.h"
#include "solid3d/solid_motion.h"
#include "solid3d/solid_problem.h"
#include "tests/crossing.h"
#include "tests/derivatives.h"

using namespace bight;
using namespace bight::solid3d;

namespace {

SolidParameters smooth() {
  SolidParameters parameters;
  parameters.contact = false;
  return parameters;
}

/// A straight strand along z.
struct Bar {
  explicit Bar(double length, double cell, const SolidParameters& parameters = smooth())
      : length(length),
        problem({{make_section(12), graded_layers(length, cell, cell, 0, length),
                  [](const Vector3& X) { return X; }}},
                parameters),
        mesh(problem.strands()[0]),
        mass(lumped_mass(mesh.hexahedra(), static_cast<int>(problem.state().size()))) {}

  /// Velocities by coordinates, of nodes by their reference positions.
  template <class F>
  Vector velocity(F&& of) const {
    Vector v = Vector::Zero(problem.state().size());
    for (int n = 0; n < mesh.nodes(); ++n) v.segment<3>(3 * n) = of(mesh.reference(n));
    return v;
  }
  Vector3 momentum(const Vector& v) const {
    Vector3 sum = Vector3::Zero();
    for (int n = 0; n < mesh.nodes(); ++n) sum += mass[3 * n] * v.segment<3>(3 * n);
    return sum;
  }
  Vector3 spin(const Vector& x, const Vector& v) const {
    Vector3 sum = Vector3::Zero();
    for (int n = 0; n < mesh.nodes(); ++n)
      sum += mass[3 * n] * Vector3(x.segment<3>(3 * n)).cross(Vector3(v.segment<3>(3 * n)));
    return sum;
  }

  double length;
  SolidProblem problem;
  const Mesh& mesh;
  Vector mass;
};

struct Vibration {
  double frequency, decay;  ///< angular frequency; rate of the envelope
  double lost;              ///< energy that went nowhere, of that at the start
};

/// One period of a bar clamped at z = 0 that begins to move in this mode. `tolerance`: of a time
/// step, relative to the amplitude at an angular frequency of 0.1.
template <class Mode>
Vibration vibration(Bar& bar, Mode&& mode, double alpha, double tolerance) {
  const std::vector<int> clamp = bar.problem.section(0, 0);
  bar.problem.hold(clamp);
  constexpr double speed = 1e-4;
  Vector shape = bar.velocity(mode);
  for (const int n : clamp) shape.segment<3>(3 * n).setZero();
  MotionParameters parameters;
  parameters.damping.alpha = alpha;
  parameters.options.tolerance = 10 * tolerance * speed;
  parameters.options.velocity_scale = 0.1;
  const auto motion = bar.problem.release(speed * shape, parameters);
  const double before = motion->energy();
  const Vector weight = bar.mass.cwiseProduct(shape), rest = bar.problem.state();
  const double v_begin = weight.dot(motion->v());
  double t0 = 0, q0 = 0, v0 = v_begin;
  for (;;) {
    const bool stepped = motion->step(1e4);
    INFO(motion->reason());
    REQUIRE(stepped);
    const double t = motion->time(), q = weight.dot(motion->x() - rest),
                 v = weight.dot(motion->v());
    if (q0 < 0 && q >= 0) {
      const double h = t - t0, low = test::crossing(q0, v0, q, v, h);
      const double period = t0 + low * h, v_end = v0 + low * (v - v0);
      return {2 * M_PI / period, std::log(v_begin / v_end) / period,
              (before - motion->energy() - motion->dissipated()) / before};
    }
    t0 = t, q0 = q, v0 = v;
  }
}

/// How much farther the tip of a cantilever goes than a beam's (Timoshenko) under a force across.
double softness(const Bar& like, double beam) {
  Bar bar(like.length, like.length / (like.mesh.layers() - 1));
  const double force = beam * 1e-3;
  const std::vector<int> tip = bar.problem.section(0, bar.mesh.layers() - 1);
  bar.problem.hold(bar.problem.section(0, 0));
  bar.problem.load(tip, {force, 0, 0});
  REQUIRE(bar.problem.go(0, 1).status == PathStatus::finished);
  double deflection = 0;
  for (const int n : tip) deflection += bar.problem.position(n).x() - bar.mesh.reference(n).x();
  return deflection / static_cast<double>(tip.size()) / 1e-3;
}

/// First bending mode of a cantilever, cos k cosh k = -1, with the turn of its sections.
struct Bending {
  double length;
  Vector3 operator()(const Vector3& X) const {
    const double k = 1.8751040687, c = (std::cosh(k) + std::cos(k)) / (std::sinh(k) + std::sin(k));
    const double u = k * X.z() / length;
    const double slope =
        k / length * (std::sinh(u) + std::sin(u) - c * (std::cosh(u) - std::cos(u)));
    return {std::cosh(u) - std::cos(u) - c * (std::sinh(u) - std::sin(u)), 0, -X.x() * slope};
  }
};

/// A quarter wave along the bar, with the breathing of its sections.
struct Stretching {
  double length;
  Vector3 operator()(const Vector3& X) const {
    const double k = M_PI / (2 * length), breath = -0.5 * k * std::cos(k * X.z());
    return {breath * X.x(), breath * X.y(), std::sin(k * X.z())};
  }
};

}  // namespace

TEST_CASE("lumped masses are positive and weigh what the solid does") {
  const Bar bar(3, 0.5);
  CHECK(bar.mass.minCoeff() >= 0);
  for (int n = 0; n < bar.mesh.nodes(); ++n) CHECK(bar.mass[3 * n + 1] > 0);
  CHECK(bar.mass.sum() / 3 == Approx(3 * bar.mesh.section.area()).epsilon(1e-12));
  const Mesh quadratic = make_mesh(make_section(5, 2), {0, 0.2, 0.4, 0.7, 1});
  const Vector mass = lumped_mass(quadratic.hexahedra(), 3 * quadratic.nodes());
  CHECK(mass.minCoeff() > 0);
  CHECK(mass.sum() / 3 == Approx(quadratic.section.area()).epsilon(1e-12));
}

TEST_CASE("points that a turn carries weigh on its angle as their moment of inertia") {
  // Two points on a radius of 2 and 1 about z, and a free one; the angle is the last coordinate.
  const Turn turn{{0, 0, 1}, {0, 0, 1}, 9, {0, 3}};
  const std::vector<bool> held(10, false);
  const Unknowns unknowns({0, 3, 6, 9}, 10, held, {turn});
  Vector x(10), mass(10);
  x << 2, 0, 5, 0, -1, 7, 1, 1, 1, 0.3;
  mass << 3, 3, 3, 4, 4, 4, 5, 5, 5, 0;
  const Vector moved = unknowns.moved_mass(x, mass);
  CHECK(moved[9] == Approx(3 * 4 + 4 * 1));
  CHECK(moved.head<6>().norm() == 0);
  CHECK(moved.segment<3>(6) == mass.segment<3>(6));
  // Of a stage: a pull along every unknown, the angle's too.
  InertialPull pull(unknowns, moved);
  CHECK(pull.stencils() == 0);
  pull.set(0.5, x + Vector::Constant(10, 0.1));
  CHECK(pull.stencils() == 4);
  test::check_derivatives(pull, x, 10);
}

TEST_CASE("a solid cantilever vibrates as a beam, and decays with alpha/2") {
  Bar bar(6, 0.25), other(6, 0.5);
  const Section& section = bar.mesh.section;
  const double L = bar.length, area = section.area(), I = section.second_moment(), nu = 0.5;
  const double euler = 3.5160152685 * std::sqrt(I / area) / (L * L);
  // Shear (k of a circle: Cowper, J. Appl. Mech. 33, 335 (1966)) and rotary inertia, that of lumped
  // masses, by Dunkerley's rule.
  const double k = 6 * (1 + nu) * (1 + nu) / (7 + 12 * nu + 4 * nu * nu);
  const double shear_stiffness = k * area / (2 * (1 + nu));
  const double shear = M_PI / (2 * L) * std::sqrt(shear_stiffness / area);
  const double radius2 = I / area + section.cell_width() * section.cell_width() / 6;
  const double beam =
      1 / std::sqrt((1 + 4.648 * radius2 / (L * L)) / (euler * euler) + 1 / (shear * shear));
  const Vibration free = vibration(bar, Bending{L}, 0, 1e-3);
  CHECK(free.frequency == Approx(beam).epsilon(0.05));  // long cells and a clamp that is stiff
  // The same cells at rest are as stiff.
  const double soft = softness(bar, 1 / (L * L * L / (3 * I) + L / shear_stiffness));
  CHECK(free.frequency == Approx(beam / std::sqrt(soft)).epsilon(0.01));
  CHECK(free.lost > 0);  // the integrator is L-stable: it never gives energy
  CHECK(free.lost < 2e-3);

  const double alpha = 0.2 * free.frequency;
  const Vibration damped = vibration(other, Bending{L}, alpha, 1e-3);
  CHECK(damped.decay == Approx(0.5 * alpha).epsilon(0.01));
  CHECK(std::abs(damped.lost) < 1e-3);
}

TEST_CASE("a solid bar vibrates along itself with a quarter of its wave") {
  Bar bar(6, 0.5), other(6, 0.5);
  const double exact = M_PI / (2 * bar.length);  // wave speed sqrt(E/rho) = 1
  const Vibration coarse = vibration(bar, Stretching{bar.length}, 0, 1e-2);
  const Vibration fine = vibration(other, Stretching{bar.length}, 0, 1e-3);
  CHECK(fine.frequency == Approx(exact).epsilon(0.025));
  CHECK(fine.lost > 0);
  CHECK(fine.lost < 0.1 * coarse.lost);
  CHECK(fine.lost < 4e-3);
}

TEST_CASE("a solid falls freely, and turns and drifts with the momentum that it has") {
  SolidParameters parameters = smooth();
  parameters.gravity = {0, -2e-3, 1e-3};
  Bar bar(3, 0.5, parameters);
  const Vector3 drift(1e-3, 2e-3, 0), turn(2e-3, 0, 1e-3), middle(0, 0, 1.5);
  const Vector v =
      bar.velocity([&](const Vector3& X) -> Vector3 { return drift + turn.cross(X - middle); });
  MotionParameters at;
  at.options.tolerance = 1e-3;
  const auto motion = bar.problem.release(v, at);
  const double weight = bar.mass.sum() / 3, time = 100, energy = motion->energy();
  REQUIRE(motion->go(time));
  const Vector3 gained = bar.momentum(motion->v()) - bar.momentum(v);
  CHECK((gained - weight * time * parameters.gravity).norm() < 1e-10 * gained.norm());
  const Vector3 centre = bar.momentum(motion->x()) / weight;
  const Vector3 fallen = middle + time * drift + 0.5 * time * time * parameters.gravity;
  CHECK((centre - fallen).norm() < 1e-10 * fallen.norm());
  // About its centre it has turned by 0.2 rad.
  const Vector3 spin =
      bar.spin(motion->x(), motion->v()) - centre.cross(Vector3(bar.momentum(motion->v())));
  const Vector3 spin_before = bar.spin(bar.problem.state(), v) - weight * middle.cross(drift);
  CHECK((spin - spin_before).norm() < 2e-3 * spin_before.norm());
  CHECK(motion->energy() == Approx(energy).epsilon(1e-5));
}
