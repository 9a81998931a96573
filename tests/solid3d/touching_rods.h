#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "solid3d/measure.h"
#include "solid3d/solid_problem.h"

/// Problems of two touching strands whose answer is known, each as a function of the mesh.
namespace bight::test {

using solid3d::SolidParameters;
using solid3d::SolidProblem;

/// Where a straight strand along z begins: its axis along x or along y, its middle at a height.
inline std::function<Vector3(const Vector3&)> along_x(double length, double height) {
  return [=](const Vector3& X) { return Vector3(X.z() - 0.5 * length, X.y(), height - X.x()); };
}
inline std::function<Vector3(const Vector3&)> along_y(double length, double height) {
  return [=](const Vector3& X) { return Vector3(X.x(), X.z() - 0.5 * length, height - X.y()); };
}

inline double cell_width(const solid3d::Section& section) {
  return std::sqrt(section.area() / static_cast<double>(section.quads.size()));
}

/// Contact that is almost hard, for small overlaps.
inline SolidParameters hard_contact(double stiffness, double sample_spacing) {
  SolidParameters parameters;
  parameters.contact_stiffness = stiffness;
  parameters.contact_onset = 0.02 / stiffness;
  parameters.sample_spacing = sample_spacing;
  parameters.penetration = 1;  // never stiffened
  return parameters;
}

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

/// Two straight rods of 6 D crossed at right angles, ends clamped, the upper one's pushed down by
/// 2 D in equal steps: each bends and stretches around the other.
struct CrossedClasp {
  explicit CrossedClasp(int cells, double bulk_to_shear) {
    SolidParameters parameters;
    parameters.material.bulk_to_shear = bulk_to_shear;
    const solid3d::Section section = solid3d::make_section(cells);
    const double width = cell_width(section);
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
    const auto layers = UBend::layers(cell_width(section));
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
  const double width = cell_width(section);
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
    const double fine = 0.8 * cell_width(section);
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

/// Patch test of round surfaces: a rod in a bore, concentric and overlapping by 0.02 D, with sides
/// and layers that do not match. (The bore is the skin of a strand turned inside out by a mirror;
/// only its surface has a meaning.) The pressure should be the same everywhere, and so should be
/// the forces on all nodes around: the largest differences over the mean, in the middle.
struct PatchErrors {
  double pressure, rod_forces, bore_forces;
};
inline PatchErrors patch(int rod_cells, int bore_cells) {
  constexpr double overlap = 0.02, length = 2;
  const solid3d::Section section = solid3d::make_section(rod_cells);
  const auto layers = [](double spacing) {
    return solid3d::graded_layers(length, spacing, spacing, 0, length);
  };
  // Inside out, the skin of the bore lies on the other side of its spline.
  solid3d::Section around = solid3d::make_section(bore_cells);
  const double skin = solid3d::ContactSurface(solid3d::make_mesh(around, layers(0.2))).skin();
  around = solid3d::scaled(around, (1 - 2 * overlap) / (1 - 4 * skin));
  std::vector<solid3d::Mesh> strands{solid3d::make_mesh(section, layers(0.1))};
  strands.push_back(solid3d::make_mesh(around, layers(0.13), strands[0].nodes()));
  solid3d::Contact::Options options;
  options.sample_spacing = 0.02;
  solid3d::Contact contact(strands, {1, 1e-4}, options);

  const int nodes = strands[0].nodes() + strands[1].nodes();
  Vector x(3 * nodes), forces = Vector::Zero(3 * nodes);
  for (const solid3d::Mesh& mesh : strands)
    for (int n = mesh.first_node; n < mesh.first_node + mesh.nodes(); ++n) {
      x.segment<3>(3 * n) = mesh.reference(n);
      if (mesh.first_node > 0) x[3 * n] *= -1;
    }
  contact.refresh(x);
  for (int i = 0; i < contact.stencils(); ++i) {
    Eigen::Matrix<double, 54, 1> gradient = Eigen::Matrix<double, 54, 1>::Zero();
    ElementSlot slot{0, gradient.data(), nullptr};
    contact.element(x, i, Order::gradient, slot);
    const auto at = contact.coordinates(i);
    for (int c = 0; c < 54; ++c) forces[at[c]] += gradient[c];
  }

  struct Spread {
    double least = 1e300, most = 0;
    void add(double value) { least = std::min(least, value), most = std::max(most, value); }
    double relative() const { return 2 * (most - least) / (most + least); }
  } pressure, on[2];
  for (const auto& sample : contact.samples()) {
    const double z = contact.surface().arc_length(contact.surface().along(sample.patch));
    if (sample.faces && std::abs(z - 0.5 * length) < 0.25 * length) pressure.add(-sample.gap);
  }
  for (const int strand : {0, 1}) {
    const solid3d::Mesh& mesh = strands[strand];
    for (int k = 0; k < mesh.layers(); ++k)
      for (const int p : mesh.section.rim)
        if (std::abs(mesh.s[k] - 0.5 * length) < 0.25 * length)
          on[strand].add(forces.segment<3>(3 * mesh.node(k, p)).norm());
  }
  return {pressure.relative(), on[0].relative(), on[1].relative()};
}

}  // namespace bight::test
