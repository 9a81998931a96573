#include "rod1d/rod_problem.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "rod1d/measure.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

Polyline line_along_z(double length, int segments) {
  Polyline line;
  for (int i = 0; i <= segments; ++i) line.push_back(Vector3(0, 0, length * i / segments));
  return line;
}

/// Unit length and bending stiffness, hardly extensible, B/C = 1.5.
Rod slender(int segments) {
  Rod rod = uniform_rod(1, segments, 0.5);
  rod.bending_stiffness = 1;
  rod.stretching_stiffness = 1e6;
  rod.twisting_stiffness = 1 / 1.5;
  return rod;
}

/// Largest `load` below `high` at which a problem made for it is stable.
template <class Make>
double critical(Make&& make, double high) {
  double low = 0;
  for (int i = 0; i < 30; ++i) {
    const double load = 0.5 * (low + high);
    (make(load)->stable() ? low : high) = load;
  }
  return low;
}

/// Turn at which a closed ring leaves its plane. The first and the last segment lie on each other
/// and are held; the node opposite may not leave the plane, so that the ring cannot flap.
double critical_turn_of_ring(int segments) {
  return critical(
      [&](double turn) {
        Rod rod = slender(segments + 1);
        const double corner = 2 * M_PI / segments, side = 1.0 / segments;
        rod.rest_length.assign(segments + 1, side);
        Polyline ring;
        for (int i = 0; i <= segments + 1; ++i)
          ring.push_back(0.5 * side / std::sin(0.5 * corner) *
                         Vector3(std::cos(corner * i), std::sin(corner * i), 0));
        auto problem = std::make_unique<RodProblem>(rod, ring, true);
        for (const int node : {0, 1, segments, segments + 1}) problem->hold(node);
        problem->hold(segments / 2, 2);
        problem->hold_angle(0), problem->hold_angle(segments);
        problem->twist_uniformly(turn);
        return problem;
      },
      30);
}

/// Torque at which a straight rod, clamped at both ends, buckles when one end is turned.
double critical_torque(int segments) {
  double torque = 0;
  critical(
      [&](double turn) {
        // Half of the end segments is inside the clamps.
        const double length = 1 + 1.0 / (segments - 1);
        Rod rod = slender(segments);
        rod.rest_length.assign(segments, length / segments);
        auto problem = std::make_unique<RodProblem>(rod, line_along_z(length, segments), true);
        for (const int node : {0, 1, segments - 1, segments}) problem->hold(node);
        problem->hold_angle(0), problem->hold_angle(segments - 1);
        problem->twist_uniformly(turn);
        torque = problem->torque(segments - 1);
        return problem;
      },
      40);
  return torque;
}

}  // namespace

TEST_CASE("a twisted ring buckles at 2 pi sqrt(3) B/C (Michell 1889, Zajac 1962)") {
  const double exact = 2 * M_PI * std::sqrt(3.0) * 1.5;
  const double coarse = critical_turn_of_ring(48) - exact;
  const double fine = critical_turn_of_ring(96) - exact;
  INFO("errors " << coarse / exact << ", " << fine / exact);
  CHECK(std::abs(fine) < 0.005 * exact);
  CHECK(coarse / fine == Approx(4).epsilon(0.15));
}

TEST_CASE("a clamped column buckles under the torque 8.9868 B/L (Greenhill 1883)") {
  const double exact = 2 * 4.493409458;  // tan(ML/2B) = ML/2B
  const double coarse = critical_torque(21) - exact, fine = critical_torque(41) - exact;
  INFO("errors " << coarse / exact << ", " << fine / exact);
  CHECK(std::abs(fine) < 0.01 * exact);
  CHECK(coarse / fine == Approx(4).epsilon(0.2));
}

TEST_CASE("a rod with natural curvature and twist springs into its helix") {
  const double kappa = 4, tau = 3;  // per length 1
  const auto radius_and_pitch = [&](int segments) {
    Rod rod = slender(segments);
    const double h = 1.0 / segments;
    rod.rest_curvature.assign(rod.nodes(), Vector2(kappa * h, 0));
    rod.rest_twist.assign(rod.nodes(), tau * h);
    RodProblem problem(rod, line_along_z(1, segments), true);
    problem.hold(0), problem.hold(1), problem.hold_angle(0);
    const NewtonResult result = problem.solve(1000);
    INFO(result.reason);
    REQUIRE(result.ok());
    CHECK(problem.reaction(0).norm() < 1e-5);
    // Distance between nodes a quarter of the length apart, on a helix of radius r and rise p.
    const Polyline nodes = problem.nodes();
    return (nodes[3 * segments / 4] - nodes[segments / 4]).norm();
  };
  const double square = kappa * kappa + tau * tau, r = kappa / square;
  const double phase = 0.5 * std::sqrt(square), rise = tau / std::sqrt(square) * 0.5;
  const double exact = std::hypot(2 * r * std::sin(0.5 * phase), rise);
  const double coarse = radius_and_pitch(20) - exact, fine = radius_and_pitch(40) - exact;
  INFO("errors " << coarse / exact << ", " << fine / exact);
  CHECK(std::abs(fine) < 1e-3 * exact);
  CHECK(coarse / fine == Approx(4).epsilon(0.2));
}

TEST_CASE("the 45 degree bend under a force out of its plane (Bathe and Bolourchi 1979)") {
  // R = 100, section 1 x 1, E = 1e7, nu = 0, C = G/6; the tip of an inextensible, unshearable rod.
  const Vector3 exact(15.685, 47.151, 53.469);
  const auto tip = [](int segments) {
    const double radius = 100, corner = 0.25 * M_PI / (segments - 0.5);
    Rod rod;
    rod.rest_length.assign(segments, 2 * radius * std::sin(0.5 * corner));
    rod.stretching_stiffness = 1e9;
    rod.bending_stiffness = 1e7 / 12;
    rod.twisting_stiffness = 5e6 / 6;
    Polyline arc;
    // The middle of the first segment is where the clamp ends.
    for (int i = 0; i <= segments; ++i) {
      const double a = (i - 0.5) * corner;
      arc.push_back(radius * Vector3(1 - std::cos(a), std::sin(a), 0));
    }
    // d1 of the frames is across the first tangent; the curvature is about -z.
    const Vector3 t = (arc[1] - arc[0]).normalized(), d1 = t.unitOrthogonal();
    const Vector3 kb(0, 0, -2 * std::tan(0.5 * corner));
    rod.rest_curvature.assign(rod.nodes(), Vector2(kb.dot(d1), kb.dot(t.cross(d1))));
    RodProblem problem(rod, arc, true);
    problem.hold(0), problem.hold(1), problem.hold_angle(0);
    REQUIRE(problem.solve().ok());
    CHECK((problem.nodes().back() - arc.back()).norm() < 1e-6);  // nothing loads it yet
    problem.load(segments, Vector3(0, 0, 600));
    const NewtonResult result = problem.solve(1000);
    INFO(result.reason);
    REQUIRE(result.ok());
    return problem.nodes().back();
  };
  const double coarse = (tip(8) - exact).norm(), fine = (tip(32) - exact).norm();
  INFO("tip " << tip(32).transpose() << ", errors " << coarse << ", " << fine);
  CHECK(fine < 0.07);
  CHECK(coarse > 12 * fine);  // second order: 16
}

TEST_CASE("supports carry what is loaded") {
  RodProblem problem(slender(40), line_along_z(1, 40), true);
  problem.hold(0), problem.hold(1), problem.hold_angle(0);
  problem.weigh(Vector3(3, 0, 0));
  problem.load(40, Vector3(0, 1, -2));
  REQUIRE(problem.solve().ok());
  const Vector3 support = problem.reaction(0) + problem.reaction(1);
  CHECK((support + Vector3(3, 1, -2)).norm() < 1e-5);
}
