#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "tests/solid3d/touching_rods.h"

/// Rods that slide or hold by friction, whose forces are known, each as a function of the mesh.
namespace bight::test {

/// A rod that hangs over a rigid drum by half a turn, a dead load T_0 on its one end, its other end
/// pulled until it slides everywhere.
///
/// A rope: T_1 = T_0 exp(mu pi). A rod of radius a that lies on a drum at a constant curvature
/// 1/rho: friction acts at its surface, so that with the normal force n per length goes a moment
/// mu n a per length. With M constant, Q = -mu n a; forces balance along, T' = mu n + Q/rho, and
/// across, n = T/rho + Q'. So T grows as exp(lambda phi),
///   lambda = mu (1 - a/rho)/(1 + lambda mu a/rho).
struct Capstan {
  Capstan(int cells, double mu, double drum)
      : mu(mu), rho(0.5 * drum + 0.5), enough(0.4 + 0.3 * rho) {
    SolidParameters parameters;
    parameters.material.bulk_to_shear = 100;
    parameters.friction = mu;
    parameters.expected_tension = hanging;
    const solid3d::Section section = solid3d::make_section(cells);
    const double length = M_PI * rho + 2 * arm;
    const double fine = 0.8 * section.cell_width();
    const auto layers =
        solid3d::graded_layers(length, fine, 2 * fine, arm - 0.5, length - arm + 0.5);
    const auto over = [this, length](const Vector3& X) -> Vector3 {
      const double angle = std::clamp((X.z() - arm) / rho, 0.0, M_PI);
      const double beyond = X.z() < arm ? X.z() - arm : std::max(X.z() - length + arm, 0.0);
      const Vector3 out(-std::cos(angle), 0, std::sin(angle));
      const Vector3 on(std::sin(angle), 0, std::cos(angle));
      return (rho + 0.005) * out + beyond * on + X.x() * out - X.y() * Vector3::UnitY();
    };
    const auto wheel = solid3d::scaled(solid3d::make_section(60), drum);
    problem = std::make_unique<SolidProblem>(
        std::vector<SolidProblem::Strand>{{section, layers, over},
                                          {wheel, {0, 0.5, 1, 1.5, 2, 2.5, 3}, along_y(3, 0)}},
        parameters);
    problem->hold(problem->nodes(1, [](const Vector3&) { return true; }));
    hung = problem->section(0, 0);
    pulled = problem->section(0, problem->strands()[0].layers() - 1);
    problem->move(pulled, solid3d::RigidMotion{.shift = {0, 0, -1}});
    problem->load(hung, {0, 0, -hanging});
  }
  /// Of the rod's tension, by the turn about the drum.
  double growth() const {
    const double part = 0.5 / rho;
    double lambda = mu;
    for (int i = 0; i < 30; ++i) lambda = mu * (1 - part) / (1 + lambda * mu * part);
    return lambda;
  }
  /// Pull over the dead load.
  double ratio() const { return -problem->reaction(pulled).z() / hanging; }
  static constexpr double arm = 4, hanging = 0.04;
  double mu, rho;  ///< radius of the axis of the rod on the drum [D]
  double enough;   ///< time until which it slides everywhere
  std::unique_ptr<SolidProblem> problem;
  std::vector<int> hung, pulled;
};

/// A rod that lies across two rigid rails and may slide along its axis, under a dead weight.
struct OnRails {
  explicit OnRails(double mu) {
    constexpr double length = 3, overlap = 1e-3;
    SolidParameters parameters;
    parameters.friction = mu;
    parameters.expected_tension = weight;
    const solid3d::Section section = solid3d::make_section(12);
    const auto layers = [](double along) {
      return solid3d::graded_layers(along, 0.2, 0.2, 0, along);
    };
    const auto rail = [](double x) {
      return
          [=](const Vector3& X) -> Vector3 { return along_y(1, -0.5)(X) + x * Vector3::UnitX(); };
    };
    problem = std::make_unique<SolidProblem>(
        std::vector<SolidProblem::Strand>{{section, layers(length), along_x(length, 0.5 - overlap)},
                                          {section, layers(1), rail(-0.8)},
                                          {section, layers(1), rail(0.8)}},
        parameters);
    const auto everywhere = [](const Vector3&) { return true; };
    for (const int strand : {1, 2}) problem->hold(problem->nodes(strand, everywhere));
    rod = problem->nodes(0, everywhere);
    end = problem->section(0, 0);
    // Neither aside nor rolling.
    problem->hold(end, 1);
    problem->hold(problem->section(0, problem->strands()[0].layers() - 1), 1);
    problem->load(rod, {0, 0, -weight});
    const PathOutcome outcome = problem->go(1, 1);
    if (outcome.status != PathStatus::finished) throw std::runtime_error(outcome.reason);
  }
  /// Whether it stays when the weight is as on a slope along its axis.
  bool holds(double slope) {
    problem->load(rod, {slope * weight, 0, -weight});
    return problem->go(problem->time() + 1, 1).status == PathStatus::finished;
  }
  /// Force along its axis over that on the rails, when an end is pulled by that distance [D].
  double drag(double distance) {
    problem->move(end, solid3d::RigidMotion{.shift = {1, 0, 0}});
    const PathOutcome outcome = problem->go(problem->time() + distance, 0.25 * distance);
    if (outcome.status != PathStatus::finished) throw std::runtime_error(outcome.reason);
    const Vector3 pull = problem->reaction(end);
    return pull.x() / (weight - pull.z());
  }
  static constexpr double weight = 5e-4;
  std::unique_ptr<SolidProblem> problem;
  std::vector<int> rod, end;
};

}  // namespace bight::test
