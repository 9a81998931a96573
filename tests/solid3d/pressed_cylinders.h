#pragma once

#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/solid3d/touching_rods.h"

/// Cylinders pressed on each other, as Hertz solved it, each as a function of the mesh.
namespace bight::test {

/// One state of two cylinders that are pressed together.
struct Pressed {
  double approach;  ///< less the overlap that the contact law asks for, a spring in series [D]
  double force;     ///< [E D^2]
  double radius;    ///< of the patch, or its half-width [D]
  double peak;      ///< pressure [E]
};

/// Radius and peak of a Hertzian pressure from its moments: r^2 = `by_square` times the mean square
/// distance from the middle, p_0 = `by_mean` times the mean pressure, both weighted by pressure.
inline Pressed pressed(const std::vector<SolidProblem::Touch>& touches, double approach,
                       double force, double by_square, double by_mean) {
  double sum = 0, squares = 0, pressures = 0, overlaps = 0;
  for (const SolidProblem::Touch& touch : touches) {
    const double f = touch.pressure * touch.area;  // of both surfaces, so twice
    sum += f;
    squares += f * touch.position.head<2>().squaredNorm();
    pressures += f * touch.pressure;
    overlaps -= f * touch.gap;
  }
  return {approach - overlaps / sum, force, std::sqrt(by_square * squares / sum),
          by_mean * pressures / sum};
}

/// Cylinders of diameter 1 crossed at right angles, held at their backs, approached in steps, each
/// to twice the approach of the one before.
/// Hertz, incompressible, E* = E/(2 (1 - nu^2)) = 2/3: a contact of two equal crossed cylinders of
/// radius R is that of a sphere of radius R on a plane,
///   F = 4/3 E* R^(1/2) d^(3/2),   a^3 = 3 F R/(4 E*),   p_0 = 3 F/(2 pi a^2).
inline std::vector<Pressed> crossed_cylinders(int cells, double until, int steps, double k = 3) {
  constexpr double length = 2.4, gap = 1e-3, fine_half = 0.25;
  const solid3d::Section section = solid3d::make_section(cells);
  const double fine = 0.8 * M_PI / static_cast<double>(section.rim.size());
  const auto layers = solid3d::graded_layers(length, fine, 6 * fine, 0.5 * length - fine_half,
                                             0.5 * length + fine_half);
  SolidProblem problem(
      {{section, layers, along_y(length, -0.5)}, {section, layers, along_x(length, 0.5 + gap)}},
      hard_contact(k / fine, 0.25 * fine));
  const auto upper = problem.nodes(1, [](const Vector3& X) { return X.x() < -0.25; });
  problem.hold(problem.nodes(0, [](const Vector3& X) { return X.y() > 0.25; }));
  problem.move(upper, solid3d::RigidMotion{.shift = {0, 0, -1}});
  std::vector<Pressed> states;
  for (int step = 1; step <= steps; ++step) {
    const double approach = until * std::pow(0.5, steps - step);
    const PathOutcome outcome = problem.go(gap + approach, 1);
    if (outcome.status != PathStatus::finished) throw std::runtime_error(outcome.reason);
    states.push_back(
        pressed(problem.touches(), approach, -problem.reaction(upper).z(), 2.5, 4.0 / 3));
  }
  return states;
}

/// Cylinders along each other in plane strain, held at their backs, with layers that do not match;
/// approached in steps, each to twice the approach of the one before. Per length, incompressible,
/// E* = 2/3 (Hertz):  a^2 = 2 F' R/(pi E*),   p_0 = 2 F'/(pi a).
inline std::vector<Pressed> parallel_cylinders(int cells, double until, int steps, double k = 3) {
  constexpr double length = 1.2, gap = 1e-3;
  const solid3d::Section section = solid3d::make_section(cells);
  const double fine = 0.8 * M_PI / static_cast<double>(section.rim.size());
  const auto layers = [](double spacing) {
    return solid3d::graded_layers(length, spacing, spacing, 0, length);
  };
  SolidProblem problem({{section, layers(0.1), along_y(length, -0.5)},
                        {section, layers(0.13), along_y(length, 0.5 + gap)}},
                       hard_contact(k / fine, 0.25 * fine));
  const auto back = [&](int strand, double side) {
    return problem.nodes(strand, [=](const Vector3& X) { return side * X.y() > 0.25; });
  };
  const auto everywhere = [](const Vector3&) { return true; };
  for (const int strand : {0, 1}) problem.hold(problem.nodes(strand, everywhere), 1);
  problem.hold(back(0, 1));
  problem.move(back(1, -1), solid3d::RigidMotion{.shift = {0, 0, -1}});
  std::vector<Pressed> states;
  for (int step = 1; step <= steps; ++step) {
    const double approach = until * std::pow(0.5, steps - step);
    const PathOutcome outcome = problem.go(gap + approach, 1);
    if (outcome.status != PathStatus::finished) throw std::runtime_error(outcome.reason);
    // The middle half, away from the ends, where the surfaces end.
    std::vector<SolidProblem::Touch> middle;
    double force = 0;
    for (SolidProblem::Touch touch : problem.touches()) {
      if (std::abs(touch.position.y()) > 0.25 * length) continue;
      force += 0.5 * touch.pressure * touch.area * std::abs(touch.normal.z()) / (0.5 * length);
      touch.position.y() = 0;
      middle.push_back(touch);
    }
    states.push_back(pressed(middle, approach, force, 4, 3 * M_PI / 8));
  }
  return states;
}

}  // namespace bight::test
