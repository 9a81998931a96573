#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

#include "solid3d/measure.h"
#include "tests/solid3d/touching_rods.h"

/// Rods that cross or hang in each other and bend, each problem as a function of the mesh.
namespace bight::test {

/// Two straight rods of 6 D crossed at right angles, ends clamped, the upper one's pushed down by
/// 2 D in equal steps: each bends and stretches around the other.
struct CrossedClasp {
  explicit CrossedClasp(int cells, double bulk_to_shear) {
    SolidParameters parameters;
    parameters.material.bulk_to_shear = bulk_to_shear;
    const solid3d::Section section = solid3d::make_section(cells);
    const double width = section.cell_width();
    const auto layers = solid3d::graded_layers(length, width, width, 0, length);
    problem = std::make_unique<SolidProblem>(
        std::vector<SolidProblem::Strand>{{section, layers, along_x(length, -0.5)},
                                          {section, layers, along_y(length, 0.501)}},
        parameters);
    const int last = problem->strands()[0].layers() - 1;
    for (const int layer : {0, last}) {
      problem->hold(problem->section(0, layer));
      for (const int n : problem->section(1, layer)) grips.push_back(n);
    }
    problem->move(grips, solid3d::RigidMotion{.shift = {0, 0, -1}});
  }
  static constexpr double length = 6, pushed = 2;
  std::unique_ptr<SolidProblem> problem;
  std::vector<int> grips;  ///< ends of the upper rod
};

/// How an end of a straight rod goes when the rod is bent to a U: along the end of a circular arc
/// until t = 1, to parallel arms that are 2 D apart until t = 2, and on along the arms by 1 D per
/// t. `out` points along the rod to its end, `up` to where the arms will point, both from `middle`.
struct UBend {
  static constexpr double length = 7, apart = 1;  // of the rod; of an arm from the middle
  Vector3 out, up, middle;
  Vector3 operator()(const Vector3& from, double t) const {
    const double angle = M_PI / 2 * std::clamp(t, 1e-9, 1.0);
    const double radius = 0.5 * length / angle, height = 0.5 * length - (M_PI / 2 - 1) * apart;
    const double together = std::clamp(t - 1, 0.0, 1.0), pulled = std::max(t - 2, 0.0);
    const Vector3 end =
        (1 - together) * radius * (std::sin(angle) * out + (1 - std::cos(angle)) * up) +
        together * (apart * out + height * up) + pulled * up;
    return middle + end +
           Eigen::AngleAxisd(angle, out.cross(up)) * (from - 0.5 * length * out - middle);
  }
  /// Layers that are fine where the bend is.
  static std::vector<double> layers(double cell_width) {
    return solid3d::graded_layers(length, 0.7 * cell_width, 2 * cell_width, 0.5 * length - 1.5,
                                  0.5 * length + 1.5);
  }
};

/// The orthogonal clasp: two rods bent to a U in planes across each other, each hung in the bend of
/// the other, their parallel arms pulled apart (Grandgeorge et al., PNAS 118, e2021684118, 2021).
/// Frictionless; in contact from t = 2 on.
struct OrthogonalClasp {
  explicit OrthogonalClasp(int cells) {
    SolidParameters parameters;
    parameters.expected_tension = 1e-2;
    const solid3d::Section section = solid3d::make_section(cells);
    const auto layers = UBend::layers(section.cell_width());
    problem = std::make_unique<SolidProblem>(
        std::vector<SolidProblem::Strand>{{section, layers, along_x(UBend::length, -lowest)},
                                          {section, layers, along_y(UBend::length, lowest)}},
        parameters);
    const int last = problem->strands()[0].layers() - 1;
    for (const int strand : {0, 1})
      for (const int end : {-1, 1}) {
        const Vector3 out = end * (strand == 0 ? Vector3::UnitX() : Vector3::UnitY());
        const Vector3 up = (strand == 0 ? 1 : -1) * Vector3::UnitZ();
        const auto nodes = problem->section(strand, end < 0 ? 0 : last);
        problem->move(nodes, UBend{out, up, -lowest * up});
        if (strand == 0) grips.insert(grips.end(), nodes.begin(), nodes.end());
      }
  }
  /// Pull of both arms [E D^2], and the largest flattening of a section.
  double force() const { return problem->reaction(grips).z(); }
  double flattening() const {
    double largest = 0;
    for (const auto& mesh : problem->strands())
      for (const double f : solid3d::flattening(mesh, problem->state()))
        largest = std::max(largest, f);
    return largest;
  }
  /// Mean pressure at the four ends of the patch, where each rod leaves the other, and in its
  /// middle [E].
  double tip_pressure() const {
    const auto tip = [](double far, double aside) { return far > 0.4 && aside < 0.2; };
    return pressure([&](const Vector3& at) { return tip(at.x(), at.y()) || tip(at.y(), at.x()); });
  }
  double middle_pressure() const {
    return pressure([](const Vector3& at) { return at.head<2>().norm() < 0.15; });
  }
  double pressure(const std::function<bool(const Vector3&)>& there) const {
    double sum = 0, area = 0;
    for (const SolidProblem::Touch& touch : problem->touches()) {
      if (!there(touch.position.cwiseAbs())) continue;
      sum += touch.pressure * touch.area;
      area += touch.area;
    }
    return area > 0 ? sum / area : 0;
  }
  static constexpr double lowest = 0.52;  ///< of the axes from the plane between them
  std::unique_ptr<SolidProblem> problem;
  std::vector<int> grips;  ///< ends of the rod that is pulled up
};

/// A rod around another, pulled as in the clasp until its ends are held; then the other, straight
/// and held at its ends, is turned about its axis by a side of its section. Frictionless: nothing
/// should change but what its surface is not round by. Forces on the loop [E D^2].
inline std::vector<double> turned_in_loop(int cells, int steps) {
  constexpr double length = 4, pulled = 2.25, height = 0.52;
  SolidParameters parameters;
  parameters.expected_tension = 1e-2;
  const solid3d::Section section = solid3d::make_section(cells);
  const double width = section.cell_width();
  const auto layers = solid3d::graded_layers(length, 0.7 * width, 2 * width, 1.2, length - 1.2);
  SolidProblem problem({{section, UBend::layers(width), along_x(UBend::length, -height)},
                        {section, layers, along_y(length, height)}},
                       parameters);
  std::vector<int> loop, rod;
  for (const int end : {-1, 1}) {
    const auto of_loop = problem.section(0, end < 0 ? 0 : problem.strands()[0].layers() - 1);
    problem.move(of_loop,
                 UBend{end * Vector3::UnitX(), Vector3::UnitZ(), -height * Vector3::UnitZ()});
    loop.insert(loop.end(), of_loop.begin(), of_loop.end());
    const auto of_rod = problem.section(1, end < 0 ? 0 : problem.strands()[1].layers() - 1);
    rod.insert(rod.end(), of_rod.begin(), of_rod.end());
  }
  problem.hold(rod);
  const auto go = [&](double t, double step) {
    const PathOutcome outcome = problem.go(t, step);
    if (outcome.status != PathStatus::finished) throw std::runtime_error(outcome.reason);
  };
  go(pulled, 0.125);
  problem.release(loop);
  problem.hold(loop);
  const double side = 2 * M_PI / static_cast<double>(section.rim.size());
  problem.move(rod, solid3d::RigidMotion{.turn = {0, side, 0}, .centre = {0, 0, height}});
  std::vector<double> forces;
  for (int step = 1; step <= steps; ++step) {
    go(pulled + static_cast<double>(step) / steps, 1);
    forces.push_back(problem.reaction(loop).z());
  }
  return forces;
}

}  // namespace bight::test
