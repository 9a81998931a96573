#include "solid3d/effects/friction.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "solid3d/effects.h"
#include "tests/derivatives.h"
#include "tests/solid3d/shapes.h"

using namespace bight;
using namespace bight::solid3d;
using test::helix_state;
using test::shaken;

namespace {

/// A rod wound so that its ends lie on each other, with friction of its surface.
struct Wound {
  Mesh mesh = test::straight_mesh(12, 2.12 * M_PI * 2.0, 1.0);
  int positions = 3 * mesh.nodes();
  int internal = 2 * static_cast<int>(mesh.cells.size());
  SolidEffects effects;
  Vector start = helix_state(mesh, 2.0, 0.99, internal);

  Wound() {
    SolidParameters parameters;
    parameters.material.bulk_to_shear = 20;
    parameters.sample_spacing = 0.15;
    parameters.friction = 0.4;
    effects = make_effects(mesh, parameters, positions);
  }
  Friction& frozen(const Vector& at) {
    effects.contact->refresh(at);
    effects.friction->freeze(at, start);
    return *effects.friction;
  }
  /// Sum of mu N of the samples, by contact itself.
  double limit(const Vector& at) {
    effects.contact->refresh(at);
    double sum = 0;
    for (const auto& sample : effects.contact->samples())
      if (sample.faces) sum -= 0.4 * sample.weight * effects.contact->law().slope(sample.gap);
    return sum;
  }
};

Vector zero(const Vector& x) { return Vector::Zero(x.size()); }

/// The start of the rod moved along its tangents, its last turn left alone: its surface slides.
Vector slid(const Wound& rod, double by) {
  Vector x = rod.start;
  for (int k = 0; k < rod.mesh.layers() / 4; ++k)
    for (int p = 0; p < rod.mesh.points_per_layer(); ++p) {
      const int at = 3 * rod.mesh.node(k, p);
      // Half a turn away from the other strand the motion fades out.
      const double fade = std::cos(0.5 * M_PI * k / (rod.mesh.layers() / 4));
      const double angle = -by * fade * fade / 2.0;
      const Matrix3 turn = Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix();
      x.segment<3>(at) = (turn * x.segment<3>(at)).eval();
    }
  return x;
}

}  // namespace

TEST_CASE("friction's derivatives converge with the square of the step, sticking and sliding") {
  const double motion = GENERATE(1e-5, 0.05);
  CAPTURE(motion);
  Wound rod;
  const Vector x = slid(rod, motion);
  Friction& friction = rod.frozen(x);
  REQUIRE(friction.stencils() > 0);
  CHECK(friction.sliding_share(x) == Approx(motion > 1e-3 ? 1.0 : 0.0).margin(0.05));
  test::check_derivatives(friction, shaken(x, rod.positions, 1e-7), rod.positions,
                          {motion > 1e-3 ? 1e-4 : 1e-6, 4, 3.0});
}

TEST_CASE("sliding surfaces are held by mu N, against their motion, and the forces balance") {
  Wound rod;
  const Vector x = slid(rod, 0.05);
  const auto friction = test::evaluate(rod.frozen(x), x, zero(x));
  // The power of friction in a motion on: - mu N times the slip.
  const Vector on = (slid(rod, 0.0501) - x) / 0.0001;
  const double power = -friction.gradient.dot(on);
  CHECK(power < 0);
  // At the samples the strand moves by `by` nearly, as the first layers hardly fade.
  CHECK(-power == Approx(rod.limit(x)).epsilon(0.1));
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < rod.positions; i += 3) sum += friction.gradient.segment<3>(i);
  CHECK(sum.norm() < 1e-12 * friction.gradient.cwiseAbs().sum());
}

TEST_CASE("what slides is dissipated, what sticks is stored and remembered") {
  Wound rod;
  const double slip = 0.05;
  const Vector x = slid(rod, slip);
  Friction& friction = rod.frozen(x);
  const double limit = rod.limit(x);
  CHECK(friction.stored(x) == Approx(0.5 * limit * largest_elastic_slip).epsilon(1e-6));
  friction.accept(x);
  CHECK(friction.dissipated() == Approx(limit * (slip - largest_elastic_slip)).epsilon(0.1));

  // The next step starts with the elastic slip: the same state is held by the same forces.
  rod.start = x;
  const auto held = test::evaluate(rod.frozen(x), x, zero(x));
  CHECK(held.gradient.norm() > 0);
  CHECK(friction.stored(x) == Approx(0.5 * limit * largest_elastic_slip).epsilon(1e-6));
  const double before = friction.dissipated();
  friction.accept(x);
  CHECK(friction.dissipated() == Approx(before).epsilon(1e-9));
}

TEST_CASE("a start takes over how another model has rubbed, whatever slips while it is relaxed") {
  Wound rod;
  const Vector x = slid(rod, 0.05);
  Friction& friction = rod.frozen(x);
  friction.accept(x);
  const std::vector<Rub> rubs = friction.rubs(x);
  rod.start = x;
  const auto held = test::evaluate(rod.frozen(x), x, zero(x));

  Wound other;
  other.start = x;
  other.effects.contact->refresh(x);
  other.effects.friction->prescribe(rubs, x);
  const auto taken = test::evaluate(other.frozen(x), x, zero(x));
  CHECK((taken.gradient - held.gradient).norm() < 1e-9 * held.gradient.norm());
  const Vector back = slid(other, -0.03);
  const auto still = test::evaluate(other.frozen(back), back, zero(back));
  const Vector further = slid(other, 1e-4) - x;
  CHECK(still.gradient.dot(further) / other.limit(back) ==
        Approx(held.gradient.dot(further) / rod.limit(x)).epsilon(0.02));
  test::check_derivatives(other.frozen(back), shaken(back, rod.positions, 1e-7), rod.positions,
                          {1e-4, 4, 3.0});

  // What then slips counts from the accepted state.
  other.effects.friction->accept(back);
  CHECK(other.effects.friction->dissipated() == 0);
  other.start = back;
  const auto after = test::evaluate(other.frozen(back), back, zero(back));
  CHECK((after.gradient - still.gradient).norm() < 1e-9 * still.gradient.norm());
  const Vector on = slid(other, -0.02);
  const auto turned = test::evaluate(other.frozen(on), on, zero(on));
  CHECK(turned.gradient.dot(after.gradient) < 0);
}

TEST_CASE("a step that only moves and turns the whole rod makes no friction") {
  Wound rod;
  const Matrix3 R = Eigen::AngleAxisd(0.7, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  Vector moved = rod.start;
  for (int i = 0; i < rod.positions; i += 3)
    moved.segment<3>(i) = R * rod.start.segment<3>(i) + Vector3(3, -2, 5);
  Friction& friction = rod.frozen(moved);
  REQUIRE(friction.stencils() > 0);
  CHECK(friction.stored(moved) < 1e-12);
}

TEST_CASE("without contact there is no friction to be built") {
  SolidParameters parameters;
  parameters.contact = false;
  parameters.friction = 0.3;
  const Mesh mesh = test::straight_mesh(12, 1.0, 1.0);
  const SolidEffects effects = make_effects(mesh, parameters, 3 * mesh.nodes());
  CHECK(effects.list.size() == 1);
  CHECK(effects.friction == nullptr);
}

TEST_CASE("what freezing leaves out of friction's tangent is what add_change says") {
  Wound rod;
  const Vector x = slid(rod, 0.05);
  Vector pressed = zero(x);  // the first turns on the last
  for (int n = 0; n < rod.mesh.node(rod.mesh.layers() / 2, 0); ++n) pressed[3 * n + 2] = 1;
  Vector bent = zero(x);
  for (int n = 0; n < rod.mesh.nodes(); ++n) {
    const Vector3 at = x.segment<3>(3 * n);
    bent.segment<3>(3 * n) = Vector3(std::sin(at.z() + at.y()), at.x() * at.z(), std::cos(at.x()));
  }
  for (const Vector& dx : {pressed, bent}) {
    const auto rate = [&](bool follow, double h) {
      Vector g[2];
      for (const int side : {0, 1}) {
        const Vector at = x + (side ? h : -h) * dx;
        g[side] = test::evaluate(rod.frozen(follow ? at : x), at, zero(x)).gradient;
      }
      return Vector((g[1] - g[0]) / (2 * h));
    };
    Vector change = zero(x);
    rod.frozen(x).add_change(x, dx, change);
    CHECK(change.norm() > 1e-3);
    const double h = 1e-6;
    const double off = (rate(true, h) - rate(false, h) - change).norm();
    CHECK(off < 1e-5 * change.norm());
  }
}
