// Two strands of one rod, plied by its twist: hard, frictionless contact along two helices.
#include <catch2/catch.hpp>
#include <cmath>

#include "rod1d/measure.h"
#include "rod1d/polyline.h"
#include "rod1d/rod_problem.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

struct Ply {
  double angle;   ///< of the strands to the ply's axis, in its middle [rad]
  double radius;  ///< of the helices [D]
  double torque;  ///< twisting moment Q [E D^3]
  double bending_stiffness;

  /// The load F at which a plectoneme of that angle grows: what the twist gives less what bending
  /// takes, per length of strand. (Thompson, van der Heijden and Neukirch, Proc. R. Soc. A 458,
  /// 959, 2002.)
  ///
  ///   F = Q sin 2a/(2 r) - B sin^4 a/(2 r^2)
  double load() const {
    return torque * std::sin(2 * angle) / (2 * radius) -
           0.5 * bending_stiffness * std::pow(std::sin(angle) / std::sqrt(radius), 4);
  }
  /// The same with the moment of an ideal ply, Q = (B/r) sin^2 a tan 2a:
  ///
  ///   F r^2/B = sin^3 a (cos a tan 2a - sin a/2)
  double ideal_load() const {
    const double s = std::sin(angle);
    return bending_stiffness / (radius * radius) * s * s * s *
           (std::cos(angle) * std::tan(2 * angle) - 0.5 * s);
  }
};

/// A rod whose two halves are helices of that angle, joined by a loop at the end of the ply and
/// clamped at its mouth, with the twist that an ideal ply of that angle has. The loop turns and the
/// ply winds up or down until it is in equilibrium.
Ply plied(double angle, int per_diameter) {
  constexpr double radius = 0.5, turns = 3, bulge = 8;
  const double along = turns * 2 * M_PI * radius / std::sin(angle);
  const auto phase = [&](double s, double first) { return s * std::sin(angle) / radius + first; };
  const auto place = [&](double s, double first) {
    const double p = phase(s, first);
    return Vector3(radius * std::cos(p), radius * std::sin(p), s * std::cos(angle));
  };
  const auto tangent = [&](double s, double first) {
    const double p = phase(s, first), t = std::sin(angle);
    return Vector3(-t * std::sin(p), t * std::cos(p), std::cos(angle));
  };
  Polyline line;
  constexpr int points = 2000;
  for (int i = 0; i <= points; ++i) line.push_back(place(along * i / points, 0));
  const Vector3 p0 = line.back(), p1 = place(along, M_PI);
  const Vector3 t0 = bulge * tangent(along, 0), t1 = -bulge * tangent(along, M_PI);
  for (int i = 1; i < points; ++i) {  // Hermite's cubic
    const double u = static_cast<double>(i) / points, v = 1 - u;
    line.push_back((1 + 2 * u) * v * v * p0 + u * v * v * t0 + (3 - 2 * u) * u * u * p1 -
                   u * u * v * t1);
  }
  for (int i = points; i >= 0; --i) line.push_back(place(along * i / points, M_PI));

  const double length = polyline_length(line);
  const int segments = static_cast<int>(length * per_diameter);
  const Rod rod = uniform_rod(length, segments, 0.5);
  const RodProblem::Touch touch{{50, 0.004}};
  RodProblem problem(rod, resampled(line, segments), true, touch);
  for (const int node : {0, 1, segments - 1, segments}) problem.hold(node);
  problem.hold_angle(0), problem.hold_angle(segments - 1);
  // Strands that wind to the right are plied by twist to the left.
  const double moment =
      rod.bending_stiffness / radius * std::pow(std::sin(angle), 2) * std::tan(2 * angle);
  problem.twist_uniformly(-moment / rod.twisting_stiffness * length);
  const NewtonResult result = problem.solve(400);
  INFO(result.reason);
  REQUIRE(result.ok());

  const Polyline nodes = problem.nodes();
  Vector x(3 * rod.nodes());
  for (int i = 0; i < rod.nodes(); ++i) x.segment<3>(3 * i) = nodes[i];
  const std::vector<double> kappa = curvature(rod, x), s = rod.arc_length();
  double mean = 0;
  int count = 0;
  for (int i = 0; i < rod.nodes(); ++i)
    if (s[i] > 0.35 * along && s[i] < 0.65 * along) mean += kappa[i], ++count;
  mean /= count;
  Ply ply;
  ply.radius = 0.5 * (1 - problem.overlap());
  ply.angle = std::asin(std::sqrt(mean * ply.radius));  // curvature of a helix: sin^2 a/r
  ply.torque = std::abs(problem.torque(segments - 1));
  ply.bending_stiffness = rod.bending_stiffness;
  return ply;
}

double error(const Ply& ply) { return std::abs(ply.load() / ply.ideal_load() - 1); }

}  // namespace

TEST_CASE("a ply under twist carries the load of a hard, frictionless plectoneme") {
  // The formula itself, as tabled.
  CHECK(Ply{M_PI / 12, 1, 0, 1}.ideal_load() == Approx(0.00743).margin(5e-6));
  CHECK(Ply{M_PI / 9, 1, 0, 1}.ideal_load() == Approx(0.02470).margin(5e-6));
  CHECK(Ply{25 * M_PI / 180, 1, 0, 1}.ideal_load() == Approx(0.06558).margin(5e-6));
  const Ply coarse = plied(25 * M_PI / 180, 4), fine = plied(25 * M_PI / 180, 8);
  INFO(error(coarse) << " " << error(fine) << " at " << fine.angle * 180 / M_PI);
  CHECK(fine.angle * 180 / M_PI == Approx(25.2).margin(0.3));
  CHECK(error(coarse) < 0.025);
  CHECK(error(fine) < 0.015);
  CHECK(error(fine) < 0.7 * error(coarse));
  CHECK(error(plied(M_PI / 9, 4)) < 0.01);
}

TEST_CASE("slender plies carry the load of a plectoneme within 0.5 %", "[.long]") {
  CHECK(error(plied(M_PI / 12, 8)) < 0.005);
  CHECK(error(plied(M_PI / 9, 8)) < 0.005);
}
