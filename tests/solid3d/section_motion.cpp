#include "solid3d/section_motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "solid3d/travelling_guess.h"
#include "tests/solid3d/shapes.h"

using namespace bight;
using namespace bight::solid3d;

namespace {

/// The straight rod turned by `angle` about an oblique axis.
Vector turned(const Mesh& mesh, double angle) {
  const Matrix3 R = Eigen::AngleAxisd(angle, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  Vector x = test::reference_state(mesh, 2);
  for (int n = 0; n < mesh.nodes(); ++n) x.segment<3>(3 * n) = R * mesh.reference(n);
  return x;
}

}  // namespace

TEST_CASE("sections of a turned rod lie where they were turned to") {
  const Mesh mesh = test::straight_mesh(12, 2.0, 1.0);
  const Matrix3 R = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  const auto places = section_places(mesh, turned(mesh, 0.7));
  for (int k = 0; k < mesh.layers(); ++k) {
    CHECK((places[k].rotation - R).norm() < 1e-12);
    CHECK((places[k].centre - R * Vector3(0, 0, mesh.s[k])).norm() < 1e-12);
  }
}

TEST_CASE("a linear step of rotation is taken as a rotation, sections keep their size") {
  const Mesh mesh = test::straight_mesh(12, 2.0, 1.0);
  Vector x = test::reference_state(mesh, 2), dx = Vector::Zero(x.size());
  const Vector3 w(0.2, -0.1, 0.4);
  for (int n = 0; n < mesh.nodes(); ++n) dx.segment<3>(3 * n) = w.cross(mesh.reference(n));
  dx[dx.size() - 1] = 0.5;
  advance_sections(mesh, x, dx);
  CHECK(x[x.size() - 1] == 0.5);
  for (int k = 0; k < mesh.layers(); ++k) {
    const Vector3 a = x.segment<3>(3 * mesh.node(k, mesh.section.rim[0]));
    const Vector3 b = x.segment<3>(3 * mesh.node(k, mesh.section.rim[4]));
    const double width =
        (mesh.section.points[mesh.section.rim[0]] - mesh.section.points[mesh.section.rim[4]])
            .norm();
    CHECK((a - b).norm() == Approx(width).epsilon(1e-12));
  }
}

TEST_CASE("a step of translation, rotation and strain is taken as such, section by section") {
  const Mesh mesh = test::straight_mesh(12, 2.0, 1.0);
  Vector x = test::reference_state(mesh, 2), dx = Vector::Zero(x.size());
  const Vector3 w(0.2, -0.1, 0.4), shift(0.1, 0.3, -0.2);
  const double swelling = 0.05;
  const auto in_section = [&](int n) {
    const Vector3 X = mesh.reference(n);
    return Vector3(X.x(), X.y(), 0);
  };
  for (int n = 0; n < mesh.nodes(); ++n)
    dx.segment<3>(3 * n) = w.cross(mesh.reference(n)) + shift + swelling * in_section(n);
  advance_sections(mesh, x, dx);
  const Matrix3 R = Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix();
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Vector3 centre = mesh.reference(n) - in_section(n);
    const Vector3 expected =
        centre + w.cross(centre) + shift + (1 + swelling) * (R * in_section(n));
    CHECK((x.segment<3>(3 * n) - expected).norm() < 1e-13);
  }
}

TEST_CASE("a steady screw is extrapolated exactly, from two states and from three") {
  const Mesh mesh = test::straight_mesh(12, 2.0, 1.0);
  const std::vector<Station> two{{10.0, turned(mesh, 0.1)}, {9.5, turned(mesh, 0.2)}};
  CHECK((extrapolate_sections(mesh, two, 9.0) - turned(mesh, 0.3)).norm() < 1e-11);
  const std::vector<Station> three{
      {10.5, turned(mesh, 0.0)}, {10.0, turned(mesh, 0.1)}, {9.5, turned(mesh, 0.2)}};
  CHECK((extrapolate_sections(mesh, three, 9.0) - turned(mesh, 0.3)).norm() < 1e-11);
}

TEST_CASE("a screw that gains speed is extrapolated exactly over unequal steps") {
  const Mesh mesh = test::straight_mesh(12, 2.0, 1.0);
  const auto at = [&](double ebar) {
    const double e = 10 - ebar, angle = 0.3 * e + 0.2 * e * e, rise = e - 0.5 * e * e;
    const Matrix3 R = Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix();
    Vector x = test::reference_state(mesh, 2);
    for (int n = 0; n < mesh.nodes(); ++n)
      x.segment<3>(3 * n) = R * mesh.reference(n) + rise * Vector3::UnitZ();
    x.tail<2>() = Vector2(2 * ebar, 1 - ebar);
    return Station{ebar, x};
  };
  const Vector guess = extrapolate_sections(mesh, {at(10.5), at(10), at(9.7)}, 9.5);
  CHECK((guess - at(9.5).x).norm() < 1e-11);
}

TEST_CASE("a section that deforms while it turns is extrapolated in its own frame") {
  const Mesh mesh = test::straight_mesh(12, 2.0, 1.0);
  const auto at = [&](double ebar) {
    const double e = 10 - ebar, angle = 0.3 * e + 0.2 * e * e;
    const double swelling = 0.05 * e - 0.03 * e * e, warp = 0.02 * e + 0.01 * e * e;
    const Matrix3 R = Eigen::AngleAxisd(angle, Vector3(1, 2, 2) / 3).toRotationMatrix();
    Vector x = test::reference_state(mesh, 2);
    for (int n = 0; n < mesh.nodes(); ++n) {
      const Vector3 X = mesh.reference(n);
      x.segment<3>(3 * n) =
          Vector3(0, 0, X.z()) +
          R * Vector3((1 + swelling) * X.x(), (1 - swelling) * X.y(), warp * X.x() * X.y());
    }
    return Station{ebar, x};
  };
  const Vector guess = extrapolate_sections(mesh, {at(10.5), at(10), at(9.7)}, 9.5);
  CHECK((guess - at(9.5).x).norm() < 1e-11);
}

namespace {

/// A rod that slides along a curve at rest in space, past a dent at rest there: pulled by e, the
/// material point s lies at s + 0.6 e. The curve has a bend of 0.15 D over 0.5 D, the dent takes a
/// tenth of the section over as much; cells behind the 2 turns of the ends know where they are.
Station sliding(const Mesh& mesh, double ebar) {
  const double e = 10 - ebar, middle = 0.5 * mesh.s.back();
  const auto hump = [&](double z) { return std::exp(-std::pow((z - middle) / 0.5, 2)); };
  const auto slope = [&](double z) { return -2 * (z - middle) / 0.25 * hump(z); };
  const int cells = mesh.section.cells();
  Vector x = test::reference_state(mesh, 2 + 2 * static_cast<int>(mesh.cells.size()));
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Vector3 X = mesh.reference(n);
    const double z = X.z() + 0.6 * e;
    const Matrix3 R =
        Eigen::AngleAxisd(std::atan(0.15 * slope(z)), Vector3::UnitY()).toRotationMatrix();
    x.segment<3>(3 * n) = Vector3(0.15 * hump(z), 0, z) +
                          R * Vector3((1 - 0.1 * hump(z)) * X.x(), X.y(), 0.05 * hump(z) * X.x());
  }
  for (size_t c = 0; c < mesh.cells.size(); ++c) {
    const int layer = static_cast<int>(c) / cells;
    const double z = 0.5 * (mesh.s[layer] + mesh.s[layer + 1]) + 0.6 * e;
    x.segment<2>(3 * mesh.nodes() + 2 + 2 * static_cast<int>(c)) =
        Vector2(0.001, 0.3) * hump(z) * (1 + static_cast<int>(c) % cells);
  }
  return {ebar, x};
}

}  // namespace

TEST_CASE("a guess travels with the rod past what stays at rest in space") {
  const Mesh mesh = test::straight_mesh(12, 8.0, 0.7);
  const std::vector<Station> states{sliding(mesh, 10.4), sliding(mesh, 10.0)};
  const Vector expected = sliding(mesh, 9.5).x;
  const Vector by_section = extrapolate_sections(mesh, states, 9.5);
  const int internal = 3 * mesh.nodes() + 2;
  const Vector travelling = travelling_guess(mesh, states, 9.5, by_section, internal);
  const auto error = [&](const Vector& x) {
    return (x - expected).head(internal).cwiseAbs().maxCoeff();
  };
  const auto error_inside = [&](const Vector& x) {
    return (x - expected).tail(x.size() - internal).cwiseAbs().maxCoeff();
  };
  CHECK(error(by_section) > 0.05);
  CHECK(error(travelling) < 0.1 * error(by_section));
  CHECK(error_inside(travelling) < 0.1 * error_inside(by_section));
}

TEST_CASE("next to its grips a rod keeps the other guess: what a grip does moves with it") {
  const Mesh mesh = test::straight_mesh(12, 8.0, 0.4);
  const std::vector<Station> states{sliding(mesh, 10.4), sliding(mesh, 10.0)};
  const Vector other = extrapolate_sections(mesh, states, 9.5);
  const Vector guess = travelling_guess(mesh, states, 9.5, other, 3 * mesh.nodes() + 2);
  for (int k = 0; k < mesh.layers(); ++k) {
    const int first = 3 * mesh.node(k, 0), count = 3 * mesh.points_per_layer();
    const double change = (guess - other).segment(first, count).norm();
    const double to_grip = std::min(mesh.s[k], mesh.s.back() - mesh.s[k]);
    if (to_grip < 1.5) CHECK(change == 0);
    if (to_grip > 3) CHECK(change > 0);
  }
}

TEST_CASE("a rod that turns about itself and slides is foreseen exactly") {
  const Mesh mesh = test::straight_mesh(12, 8.0, 0.7);
  const int internal = 3 * mesh.nodes() + 2;
  const auto at = [&](double ebar) {
    const Matrix3 R = Eigen::AngleAxisd(0.2 * (10 - ebar), Vector3::UnitZ()).toRotationMatrix();
    Vector x = test::reference_state(mesh, 2 + 2 * static_cast<int>(mesh.cells.size()));
    for (int n = 0; n < mesh.nodes(); ++n)
      x.segment<3>(3 * n) = R * mesh.reference(n) + Vector3(0, 0, 0.3 * ebar);
    x.tail(x.size() - internal).setConstant(0.01 * ebar);
    return Station{ebar, x};
  };
  const std::vector<Station> states{at(10.0), at(9.5)};
  const Vector guess =
      travelling_guess(mesh, states, 9.2, extrapolate_sections(mesh, states, 9.2), internal);
  CHECK((guess - at(9.2).x).norm() < 1e-10);
}

TEST_CASE("before anything has moved, sections slide along the rod as far as its ends are moved") {
  const Mesh mesh = test::straight_mesh(12, 8.0, 0.7);
  const int internal = 3 * mesh.nodes() + 2;
  Vector x = test::reference_state(mesh, 2 + 2 * static_cast<int>(mesh.cells.size()));
  x.tail(x.size() - internal).setConstant(0.01);
  Vector ends = x;
  const int last = mesh.layers() - 1;
  for (int p = 0; p < mesh.points_per_layer(); ++p) {
    ends[3 * mesh.node(0, p) + 2] -= 0.5;
    ends[3 * mesh.node(last, p) + 2] += 1.5;
  }
  const Vector guess = sliding_guess(mesh, x, ends, internal);
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Vector3 X = mesh.reference(n);
    const bool held = n < mesh.points_per_layer() || n >= mesh.node(last, 0);
    const double wide = held ? 1 : 1 / std::sqrt(1.25);
    CHECK(
        (guess.segment<3>(3 * n) - Vector3(wide * X.x(), wide * X.y(), 1.25 * X.z() - 0.5)).norm() <
        1e-10);
  }
  CHECK((guess - x).tail(x.size() - internal).norm() < 1e-12);
}

TEST_CASE("sliding, sections follow the bends of the rod") {
  // A quarter of a circle between straight ends, 20 D long; both ends are pulled out by 0.3 D.
  const Mesh mesh = test::straight_mesh(12, 20.0, 0.4);
  const int internal = 3 * mesh.nodes() + 2;
  const double radius = 5, arc = 0.5 * std::numbers::pi * radius, begin = 10 - 0.5 * arc;
  const auto place = [&](double s) {
    const double turn = std::clamp((s - begin) / radius, 0.0, 0.5 * std::numbers::pi);
    const Vector3 tangent(std::sin(turn), 0, std::cos(turn));
    const double straight = s - std::clamp(s, begin, begin + arc);
    return SectionPlace{
        Vector3(radius * (1 - std::cos(turn)), 0, radius * std::sin(turn)) + straight * tangent,
        Eigen::AngleAxisd(turn, Vector3::UnitY()).toRotationMatrix()};
  };
  const auto put = [&](Vector& x, int layer, double s) {
    for (int p = 0; p < mesh.points_per_layer(); ++p) {
      const Vector3 X = mesh.reference(mesh.node(layer, p));
      x.segment<3>(3 * mesh.node(layer, p)) =
          place(s).centre + place(s).rotation * Vector3(X.x(), X.y(), 0);
    }
  };
  Vector x = test::reference_state(mesh, 2 + 2 * static_cast<int>(mesh.cells.size()));
  for (int k = 0; k < mesh.layers(); ++k) put(x, k, mesh.s[k]);
  Vector ends = x;
  put(ends, 0, -0.3), put(ends, mesh.layers() - 1, 20.3);
  const auto guess = section_places(mesh, sliding_guess(mesh, x, ends, internal));
  for (int k = 0; k < mesh.layers(); ++k) {
    const SectionPlace expected = place(1.03 * mesh.s[k] - 0.3);
    CHECK((guess[k].centre - expected.centre).norm() < 0.01);
    CHECK((guess[k].rotation - expected.rotation).norm() < 0.03);
  }
}
