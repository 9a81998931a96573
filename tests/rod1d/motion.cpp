#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "rod1d/rod_problem.h"
#include "tests/crossing.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

/// A rod of unit length, bending stiffness and mass along z, hardly extensible, clamped in the
/// middle of its first segment.
struct Cantilever {
  static Rod rod(int segments) {
    Rod rod = uniform_rod(1, segments, 0.5);
    rod.rest_length.assign(segments, 1 / (segments - 0.5));
    rod.bending_stiffness = 1;
    rod.stretching_stiffness = 1e6;
    rod.mass_per_length = 1;
    return rod;
  }
  static double place(int node, int segments) { return (node - 0.5) / (segments - 0.5); }
  /// First mode of vibration, cos k cosh k = -1.
  static double mode(double z) {
    const double k = 1.8751040687, c = (std::cosh(k) + std::cos(k)) / (std::sinh(k) + std::sin(k));
    z = std::max(z, 0.0);
    return std::cosh(k * z) - std::cos(k * z) - c * (std::sinh(k * z) - std::sin(k * z));
  }
};

struct Vibration {
  double frequency, decay;  ///< angular frequency; rate of the envelope
};

/// Of the first mode, over some periods.
Vibration vibration(int segments, double alpha, double tolerance) {
  const double size = 1e-3;
  // Every segment has its undeformed length: no axial waves to begin with.
  const double h = 1 / (segments - 0.5);
  Polyline line{Vector3(0, 0, -0.5 * h)};
  for (int i = 1; i <= segments; ++i) {
    const auto at = [&](int node) {
      return size * Cantilever::mode(Cantilever::place(node, segments));
    };
    const double dx = i > 1 ? at(i) - at(i - 1) : 0;
    line.push_back(line.back() + Vector3(dx, 0, std::sqrt(h * h - dx * dx)));
  }
  RodProblem problem(Cantilever::rod(segments), line, false);
  problem.hold(0), problem.hold(1);
  MotionParameters parameters;
  parameters.damping.alpha = alpha;
  parameters.options.tolerance = tolerance * size;
  parameters.options.velocity_scale = 3.5;
  const auto motion = problem.release(parameters);
  const auto projection = [&](const Vector& values) {
    double sum = 0;
    for (int i = 2; i <= segments; ++i)
      sum += (i == segments ? 0.5 : 1) * Cantilever::mode(Cantilever::place(i, segments)) *
             values[Rod::position(i)];
    return sum;
  };
  // Zero crossings downwards, each with the speed there.
  std::vector<std::pair<double, double>> zeros;
  double t0 = 0, q0 = projection(motion->x()), v0 = 0;
  while (zeros.size() < 4) {
    REQUIRE(motion->step(100));
    const double t = motion->time(), q = projection(motion->x()),
                 v = projection(motion->dynamics().v());
    if (q0 > 0 && q <= 0) {
      const double h = t - t0, low = test::crossing(q0, v0, q, v, h);
      zeros.push_back({t0 + low * h, v0 + low * (v - v0)});
    }
    t0 = t, q0 = q, v0 = v;
  }
  const double time = zeros.back().first - zeros.front().first;
  return {2 * M_PI * static_cast<double>(zeros.size() - 1) / time,
          std::log(zeros.front().second / zeros.back().second) / time};
}

}  // namespace

TEST_CASE("a cantilever vibrates with 3.516 sqrt(B/(rho A L^4)) and decays with alpha/2") {
  const double exact = 3.5160152685;
  const double coarse = vibration(10, 0, 1e-4).frequency / exact - 1;
  const double fine = vibration(20, 0, 1e-4).frequency / exact - 1;
  INFO("errors " << coarse << ", " << fine);
  CHECK(std::abs(fine) < 2e-3);
  CHECK(coarse / fine == Approx(4).epsilon(0.2));
  const double alpha = 0.6;
  const Vibration damped = vibration(20, alpha, 1e-4);
  CHECK(damped.decay == Approx(0.5 * alpha).epsilon(0.01));
  CHECK(damped.frequency == Approx(std::sqrt(exact * exact - 0.25 * alpha * alpha)).epsilon(2e-3));
}

TEST_CASE("a swinging rod keeps its energy, and damping takes what is lost") {
  // Clamped level, it falls under its weight through a large angle.
  const auto swing = [](double alpha, double tolerance) {
    const int segments = 12;
    Polyline line;
    for (int i = 0; i <= segments; ++i) line.push_back({0, 0, Cantilever::place(i, segments)});
    RodProblem problem(Cantilever::rod(segments), line, false);
    problem.hold(0), problem.hold(1);
    problem.weigh(Vector3(-5, 0, 0));
    MotionParameters parameters;
    parameters.damping.alpha = alpha;
    parameters.options.tolerance = tolerance;
    parameters.options.velocity_scale = 1;
    const auto motion = problem.release(parameters);
    const double before = motion->energy();
    double lowest = 0, fastest = 0;
    for (const double time : {0.4, 0.8, 1.2, 1.6, 2.0}) {
      REQUIRE(motion->go(time));
      lowest = std::min(lowest, motion->node(segments).x());
      fastest = std::max(fastest, motion->dynamics().kinetic_energy());
    }
    CHECK(lowest < -0.6);
    CHECK(fastest > 0.3);
    return before - motion->energy() - motion->dissipated();
  };
  const double scale = 5 * 0.6;  // weight times fall
  const double coarse = swing(0, 1e-5) / scale, fine = swing(0, 1e-6) / scale;
  const double damped = swing(0.5, 1e-6) / scale;
  INFO("lost " << coarse << ", " << fine << ", damped " << damped);
  CHECK(coarse > 0);  // the integrator is L-stable: it never gives energy
  CHECK(std::abs(fine) < 1e-3);
  CHECK(std::abs(fine) < 0.3 * coarse);
  CHECK(std::abs(damped) < 1e-3);
}
