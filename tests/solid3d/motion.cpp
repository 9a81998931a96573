#include <catch2/catch.hpp>
#include <cmath>

#include "solid3d/effects/gravity.h"
#include "solid3d/solid_motion.h"
#include "solid3d/solid_problem.h"

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

/// Two periods of a bar clamped at z = 0 that begins to move in this mode.
template <class Mode>
Vibration vibration(const Bar& bar, SolidProblem& problem, Mode&& mode, double alpha,
                    double tolerance) {
  problem.hold(problem.section(0, 0));
  constexpr double size = 1e-4;  // velocity
  Vector shape = bar.velocity(mode);
  for (const int n : problem.section(0, 0)) shape.segment<3>(3 * n).setZero();
  MotionParameters parameters;
  parameters.damping.alpha = alpha;
  parameters.options.tolerance = tolerance * size * 10;
  parameters.options.velocity_scale = 0.1;
  const auto motion = problem.release(size * shape, parameters);
  const double before = motion->energy();
  const Vector weight = bar.mass.cwiseProduct(shape), rest = problem.state();
  std::vector<std::pair<double, double>> zeros;  // upwards, each with the speed there
  double t0 = 0, q0 = 0, v0 = weight.dot(size * shape);
  zeros.push_back({0, v0});
  while (zeros.size() < 3) {
    const bool stepped = motion->step(1e4);
    INFO(motion->reason());
    REQUIRE(stepped);
    const double t = motion->time(), q = weight.dot(motion->x() - rest),
                 v = weight.dot(motion->v());
    if (q0 < 0 && q >= 0) {
      const double h = t - t0;
      double low = 0, high = 1;
      for (int k = 0; k < 60; ++k) {
        const double u = 0.5 * (low + high), w = 1 - u;
        const double value =
            w * w * (1 + 2 * u) * q0 + u * u * (3 - 2 * u) * q + u * w * h * (w * v0 - u * v);
        (value < 0 ? low : high) = u;
      }
      zeros.push_back({t0 + low * h, v0 + low * (v - v0)});
    }
    t0 = t, q0 = q, v0 = v;
  }
  const double time = zeros.back().first;
  WARN("steps " << motion->steps() << " iterations " << motion->iterations());
  return {2 * M_PI * 2 / time, std::log(zeros.front().second / zeros.back().second) / time,
          (before - motion->energy() - motion->dissipated()) / before};
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
}

TEST_CASE("a solid cantilever vibrates as a beam, and decays with alpha/2") {
  Bar bar(6, 0.5);
  const Section& section = bar.mesh.section;
  const double L2 = bar.length * bar.length, area = section.area(), I = section.second_moment();
  const double euler = 3.5160152685 * std::sqrt(I / area) / L2;
  // Shear (k of a circle, Cowper 1966) and the lumped rotary inertia, by Dunkerley's rule.
  const double nu = 0.5, k = 6 * (1 + nu) * (1 + nu) / (7 + 12 * nu + 4 * nu * nu);
  const double shear = M_PI / 2 * std::sqrt(k / (2 * (1 + nu)) / L2);
  const double radius2 = I / area + section.cell_width() * section.cell_width() / 6;
  const double exact =
      1 / std::sqrt((1 + 4.648 * radius2 / L2) / (euler * euler) + 1 / (shear * shear));
  const Vibration free = vibration(bar, bar.problem, Bending{bar.length}, 0, 1e-4);
  WARN("frequency over Euler's " << free.frequency / euler << ", over Timoshenko's "
                                 << free.frequency / exact << ", lost " << free.lost);
  const double alpha = 0.2 * euler;
  Bar other(6, 0.5);
  const Vibration damped = vibration(other, other.problem, Bending{bar.length}, alpha, 1e-4);
  WARN("decay " << damped.decay / (0.5 * alpha) << " lost " << damped.lost << " freq "
                << damped.frequency / free.frequency);
}

TEST_CASE("a solid bar vibrates along itself with a quarter of its wave") {
  Bar bar(6, 0.5);
  const double exact = M_PI / (2 * bar.length);
  const Vibration free = vibration(bar, bar.problem, Stretching{bar.length}, 0, 1e-4);
  WARN("frequency " << free.frequency / exact << ", lost " << free.lost);
}

TEST_CASE("a solid falls freely, and turns and drifts with the momentum that it has") {
  SolidParameters parameters = smooth();
  parameters.gravity = {0, -2e-3, 1e-3};
  Bar bar(3, 0.5, parameters);
  const Vector3 drift(1e-3, 2e-3, 0), turn(2e-3, 0, 1e-3), middle(0, 0, 1.5);
  const Vector v =
      bar.velocity([&](const Vector3& X) -> Vector3 { return drift + turn.cross(X - middle); });
  MotionParameters motion_parameters;
  motion_parameters.options.tolerance = 1e-4;
  const auto motion = bar.problem.release(v, motion_parameters);
  const double weight = bar.mass.sum() / 3, time = 100;
  const Vector3 before = bar.momentum(v);
  const double energy = motion->energy();
  REQUIRE(motion->go(time));
  const Vector3 gained = bar.momentum(motion->v()) - before;
  CHECK((gained - weight * time * parameters.gravity).norm() < 1e-9 * gained.norm());
  const Vector3 centre = bar.momentum(motion->x()) / weight;
  const Vector3 fallen = middle + time * drift + 0.5 * time * time * parameters.gravity;
  WARN("centre off " << (centre - fallen).norm() << " of " << fallen.norm() << " steps "
                     << motion->steps() << " momentum off "
                     << (gained - weight * time * parameters.gravity).norm() << " energy "
                     << motion->energy() / energy - 1 << " kin " << motion->kinetic_energy()
                     << " spin "
                     << bar.spin(motion->x(), motion->v()) -
                            weight * centre.cross(Vector3(bar.momentum(motion->v()) / weight))
                     << " was " << bar.spin(bar.problem.state(), v) - weight * middle.cross(drift));
}
