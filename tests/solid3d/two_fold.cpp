#include "solid3d/two_fold.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "solid3d/effects.h"
#include "solid3d/effects/grip.h"
#include "tests/derivatives.h"
#include "tests/solid3d/shapes.h"

using namespace bight;
using namespace bight::solid3d;

namespace {

/// Two turns and a bit of a helix about z, whose middle lies on a two-fold axis and touches both
/// its neighbours.
struct Helix {
  Mesh mesh = test::straight_mesh(12, 26.6, 1.0);
  std::vector<Vector3> start;

  Helix() {
    const Vector x = test::helix_state(mesh, 2.0, 0.99, 0);
    for (int n = 0; n < mesh.nodes(); ++n) start.push_back(x.segment<3>(3 * n));
  }
  Vector in_frame(const TwoFold& symmetry, int internal) const {
    Vector x = Vector::Zero(3 * mesh.nodes() + internal);
    const Matrix3 back = Eigen::AngleAxisd(-symmetry.angle(), Vector3::UnitZ()).toRotationMatrix();
    for (int n = 0; n < mesh.nodes(); ++n)
      x.segment<3>(3 * n) = back * (start[n] - symmetry.origin());
    return x;
  }
};

}  // namespace

TEST_CASE("a helix has a two-fold axis through its middle, a shaken one has none") {
  Helix helix;
  REQUIRE(helix.mesh.layers() % 2 == 1);
  const auto symmetry = TwoFold::find(helix.mesh, helix.start);
  REQUIRE(symmetry);
  CHECK(symmetry->first_layer() == helix.mesh.layers() / 2);
  for (int n = 0; n < helix.mesh.nodes(); ++n) {
    CHECK(symmetry->image(symmetry->image(n)) == n);
    const int layer = n / helix.mesh.points_per_layer();
    CHECK(symmetry->image(n) / helix.mesh.points_per_layer() == helix.mesh.layers() - 1 - layer);
  }
  helix.start[5].x() += 1e-4;
  CHECK(!TwoFold::find(helix.mesh, helix.start));
}

TEST_CASE("imposing the symmetry leaves a symmetric state alone and makes another one symmetric") {
  const Helix helix;
  const TwoFold symmetry = *TwoFold::find(helix.mesh, helix.start);
  const Vector x = helix.in_frame(symmetry, 0);
  Vector imposed = x;
  symmetry.impose(helix.mesh, imposed);
  CHECK((imposed - x).cwiseAbs().maxCoeff() < 1e-10);

  imposed = test::shaken(x, 3 * helix.mesh.nodes(), 0.01);
  symmetry.impose(helix.mesh, imposed);
  CHECK((imposed - x).cwiseAbs().maxCoeff() > 1e-3);
  for (int n = 0; n < helix.mesh.nodes(); ++n) {
    const Vector3 p = imposed.segment<3>(3 * n), q = imposed.segment<3>(3 * symmetry.image(n));
    CHECK(p == Vector3(q.x(), -q.y(), -q.z()));
  }
}

TEST_CASE("one half of a symmetric state carries half of every energy") {
  const Helix helix;
  const TwoFold symmetry = *TwoFold::find(helix.mesh, helix.start);
  SolidParameters parameters;
  parameters.material.bulk_to_shear = 20;
  // Three samples a patch along the rod, and two: with and without samples on the symmetry plane.
  parameters.sample_spacing = GENERATE(0.09, 0.13);
  const int internal_begin = 3 * helix.mesh.nodes();
  const Vector x = helix.in_frame(symmetry, 2 * static_cast<int>(helix.mesh.cells.size()));
  const auto whole = make_effects(helix.mesh, parameters, internal_begin);
  const auto half = make_effects(helix.mesh, parameters, internal_begin, symmetry.first_layer());
  for (size_t i = 0; i < whole.list.size(); ++i) {
    CAPTURE(whole.list[i]->name());
    const Vector zero = Vector::Zero(x.size());
    const double energy = test::evaluate(*whole.list[i], x, zero).energy;
    REQUIRE(energy > 0);
    CHECK(2 * test::evaluate(*half.list[i], x, zero).energy == Approx(energy).epsilon(1e-9));
    CHECK(half.list[i]->stencils() < 0.6 * whole.list[i]->stencils());
  }
}

TEST_CASE("a wave is its own image by inversion, and so is whatever the unknowns of one half do") {
  constexpr double length = 13;
  std::vector<double> layers;
  for (int k = 0; k <= 60; ++k) layers.push_back(length * k / 60);
  const Mesh mesh = make_mesh(make_section(GENERATE(12, 21)), layers);
  std::vector<Vector3> start;
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Vector3 X = mesh.reference(n) - Vector3(0, 0, 0.5 * length);
    start.push_back(X + Vector3(0.9 * std::sin(X.z()), 0.4 * std::sin(2 * X.z()), 0));
  }
  const auto symmetry = TwoFold::find(mesh, start);
  REQUIRE(symmetry);
  CHECK(symmetry->kind() == TwoFold::Kind::inversion);

  const Grip grip{false, false, {}};
  const int internal_begin = grip.coordinates(mesh);
  Vector x = Vector::Zero(internal_begin + 2 * static_cast<int>(mesh.cells.size()));
  for (int n = 0; n < mesh.nodes(); ++n) x.segment<3>(3 * n) = start[n];
  SolidParameters parameters;
  const auto whole = make_effects(mesh, parameters, internal_begin);
  const auto half = make_effects(mesh, parameters, internal_begin, symmetry->first_layer());
  const Vector zero = Vector::Zero(x.size());
  const double energy = test::evaluate(*whole.strain, x, zero).energy;
  REQUIRE(energy > 0);
  CHECK(2 * test::evaluate(*half.strain, x, zero).energy == Approx(energy).epsilon(1e-9));

  const Unknowns unknowns = grip.unknowns(mesh, static_cast<int>(x.size()), &*symmetry);
  CHECK(unknowns.size() < 0.51 * 3 * mesh.nodes());
  const Vector step = test::shaken(Vector::Zero(unknowns.size()), unknowns.size(), 0.01);
  Vector moved = x;
  unknowns.advance(moved, unknowns.expand(x, step));
  CHECK((moved - x).cwiseAbs().maxCoeff() > 1e-2);
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Vector3 p = moved.segment<3>(3 * n), q = moved.segment<3>(3 * symmetry->image(n));
    CHECK((p + q).norm() < 1e-10);
  }
  Vector imposed = moved;
  symmetry->impose(mesh, imposed);
  CHECK((imposed - moved).cwiseAbs().maxCoeff() < 1e-10);

  start[5].x() += 1e-4;
  CHECK(!TwoFold::find(mesh, start));
}

TEST_CASE("a rod in a plane that is neither turned nor inverted into itself has no symmetry") {
  const Mesh mesh = test::straight_mesh(12, 13.3, 1.0);
  std::vector<Vector3> start;
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Vector3 X = mesh.reference(n) - Vector3(0, 0, 6.65);
    start.push_back(X + Vector3(0.1 * X.z() * X.z() * X.z(), 0.1 * std::sin(3 * X.z() + 1), 0));
  }
  CHECK(!TwoFold::find(mesh, start));
}

TEST_CASE("whatever the unknowns of one half do, the whole stays symmetric") {
  const Helix helix;
  const TwoFold symmetry = *TwoFold::find(helix.mesh, helix.start);
  const bool turning = GENERATE(false, true);
  const Grip grip{turning, turning, {}};
  const Vector x = helix.in_frame(symmetry, grip.coordinates(helix.mesh) - 3 * helix.mesh.nodes());
  const Unknowns unknowns = grip.unknowns(helix.mesh, static_cast<int>(x.size()), &symmetry);
  const Vector step = test::shaken(Vector::Zero(unknowns.size()), unknowns.size(), 0.01);
  Vector moved = x;
  unknowns.advance(moved, unknowns.expand(x, step));
  CHECK((moved - x).cwiseAbs().maxCoeff() > 1e-2);
  Vector imposed = moved;
  symmetry.impose(helix.mesh, imposed);
  CHECK((imposed - moved).cwiseAbs().maxCoeff() < 1e-10);
  const int last = helix.mesh.node(helix.mesh.layers() - 1, 0);
  CHECK((moved.segment<3>(3 * last) != x.segment<3>(3 * last)) == turning);
}
