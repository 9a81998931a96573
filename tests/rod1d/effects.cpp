#include "rod1d/effects.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <random>

#include "rod1d/effects/bend.h"
#include "rod1d/effects/inertia.h"
#include "rod1d/effects/stretch.h"
#include "rod1d/overhand.h"
#include "tests/derivatives.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

/// Every effect that a rod can have, on the same rod: straight when free, or curved and twisted.
struct EveryEffect {
  RodParameters parameters;
  Rod rod;
  Frames source;
  RodEffects effects;
  explicit EveryEffect(bool curved) {
    parameters.segments = 170;
    parameters.twist = true;
    parameters.friction = 0.3;
    parameters.gravity = Vector3(0.01, -0.03, 0.02);
    parameters.magnetic = Vector3(0.1, 0.2, -0.1);
    rod = uniform_rod(parameters.length, parameters.segments, parameters.poissons_ratio);
    if (curved) {
      rod.rest_curvature.assign(rod.nodes(), Vector2(0.06, -0.03));
      rod.rest_twist.assign(rod.nodes(), 0.02);
    }
    effects = make_effects(rod, parameters, source);
    // A wide onset, so that a difference step stays inside it.
    effects.contact->set_law({0.3, 0.2});
  }

  /// Lets friction slide: everything that touches at x has moved since the last accepted state.
  void rub(const Vector& x) {
    Vector before = x;
    for (int i = 0; i < rod.nodes(); ++i) before[3 * i + 2] += std::sin(0.3 * i);
    const FrictionHistory history{before, carried_frames(rod, source, before), {}};
    effects.contact->refresh(x);
    effects.friction->set_spots(friction_spots(rod, rubbing_points(rod, effects.contact->points(x)),
                                               x, carried_frames(rod, source, x), history));
  }
};

Vector straight(const Rod& rod) {
  Vector x = Vector::Zero(3 * rod.nodes() + rod.segments());
  const auto s = rod.arc_length();
  for (int i = 0; i < rod.nodes(); ++i) x[3 * i + 2] = s[i];
  return x;
}

/// A loose overhand knot, drawn together in the plane across the axis until its braid touches.
Vector knotted(const Rod& rod, double across) {
  const Polyline line = overhand_start(42.17, 28, rod.segments());
  Vector x(3 * rod.nodes() + rod.segments());
  for (int i = 0; i < rod.nodes(); ++i)
    x.segment<3>(3 * i) = line[i].cwiseProduct(Vector3(across, across, 1));
  for (int i = 0; i < rod.segments(); ++i) x[rod.angle(i)] = std::sin(0.2 * i);
  return x;
}

Vector shaken(Vector x, double size) {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  for (double& value : x) value += size * normal(generator);
  return x;
}

struct State {
  const char* name;
  Vector x;
};

std::vector<State> states(const Rod& rod) {
  return {{"rest", straight(rod)},
          {"almost rest", shaken(straight(rod), 1e-8)},
          {"generic", shaken(knotted(rod, 0.74), 0.01)},
          {"just touching", knotted(rod, 0.88)}};
}

}  // namespace

TEST_CASE("derivatives of every effect of the rod converge with second order") {
  const bool curved = GENERATE(false, true);
  EveryEffect every(curved);
  for (const State& state : states(every.rod)) {
    // The tangents turn between the source and the state.
    every.source = twist_free_frames(every.rod, shaken(state.x, 0.02));
    for (const auto& effect : every.effects.list) {
      INFO(state.name);
      effect->refresh(state.x);
      if (effect->name() == "friction") {
        every.rub(state.x);
        if (std::string(state.name) == "generic") CHECK(effect->stencils() > 0);
      }
      if (effect->name() == "contact" && std::string(state.name).find("rest") == std::string::npos)
        CHECK(effect->stencils() > 0);
      // Contact knows no angles.
      const bool angles = effect->name() != "contact";
      test::check_derivatives(*effect, state.x,
                              3 * every.rod.nodes() + (angles ? every.rod.segments() : 0));
    }
  }
}

TEST_CASE("friction changes as its normal forces do") {
  EveryEffect every(false);
  const Vector x = states(every.rod)[2].x, v = shaken(Vector::Zero(x.size()), 1);
  every.source = twist_free_frames(every.rod, x);
  every.rub(x);
  Friction& friction = *every.effects.friction;
  REQUIRE(friction.spots().size() > 10);
  Vector change = Vector::Zero(x.size());
  friction.add_change(v, change);
  REQUIRE(change.norm() > 0);
  // The same spots, with the normal forces that they have a little to either side.
  const std::vector<FrictionSpot> spots = friction.spots();
  const auto gradient_at = [&](double h) {
    every.effects.contact->refresh(x + h * v);
    const auto points = rubbing_points(every.rod, every.effects.contact->points(x + h * v));
    REQUIRE(points.size() == spots.size());
    std::vector<FrictionSpot> pressed = spots;
    for (FrictionSpot& spot : pressed) {
      const auto nearest =
          std::min_element(points.begin(), points.end(), [&](const auto& l, const auto& r) {
            const auto off = [&](const RubbingPoint& p) {
              return std::abs(p.arc_a - spot.at.arc_a) + std::abs(p.arc_b - spot.at.arc_b);
            };
            return off(l) < off(r);
          });
      spot.at.force = nearest->force;
    }
    friction.set_spots(pressed);
    Vector gradient = Vector::Zero(x.size());
    for (int i = 0; i < friction.stencils(); ++i) {
      std::array<double, friction_coordinates> g{};
      ElementSlot slot{0, g.data()};
      friction.element(x, i, Order::gradient, slot);
      for (int k = 0; k < friction_coordinates; ++k) gradient[friction.coordinates(i)[k]] += g[k];
    }
    return gradient;
  };
  const double h = 1e-7;
  const Vector difference = (gradient_at(h) - gradient_at(-h)) / (2 * h);
  CHECK((difference - change).norm() < 1e-4 * change.norm());
}

TEST_CASE("a rigid motion changes no energy, and internal forces and torques balance") {
  const bool curved = GENERATE(false, true);
  EveryEffect every(curved);
  const Rod& rod = every.rod;
  const Matrix3 turn = Eigen::AngleAxisd(1.1, Vector3(1, -2, 0.4).normalized()).toRotationMatrix();
  for (const State& state : states(rod)) {
    every.source = twist_free_frames(rod, state.x);
    Vector moved = state.x;
    for (int i = 0; i < rod.nodes(); ++i)
      moved.segment<3>(3 * i) = turn * state.x.segment<3>(3 * i) + Vector3(3, -1, 7);
    // Carrying leaves out the spin of the motion about the tangent: the angles take it.
    const Frames carried = carried_frames(rod, every.source, moved);
    for (int i = 0; i < rod.segments(); ++i) {
      const Vector3 d = turn * every.source.normal[i];
      moved[rod.angle(i)] += std::atan2(d.dot(carried.binormal(i)), d.dot(carried.normal[i]));
    }
    for (const auto& effect : every.effects.list) {
      if (effect->from_outside()) continue;
      if (effect->name() == "friction") every.rub(state.x);
      INFO(state.name << ", " << effect->name());
      const auto here = test::evaluate(*effect, state.x, Vector::Zero(state.x.size()));
      const auto there = test::evaluate(*effect, moved, Vector::Zero(state.x.size()));
      // Frozen slip is expanded to second order: only small motions leave it as it is.
      if (effect->name() != "friction")
        CHECK(there.energy == Approx(here.energy).epsilon(1e-9).margin(1e-20));
      Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
      for (int i = 0; i < rod.nodes(); ++i) {
        const Vector3 g = here.gradient.segment<3>(3 * i);
        force += g;
        torque += state.x.segment<3>(3 * i).cross(g);
      }
      for (int i = 0; i < rod.segments(); ++i)
        torque += here.gradient[rod.angle(i)] * every.source.tangent[i];
      const double scale = here.gradient.cwiseAbs().sum() + 1e-12;
      CHECK(force.norm() < 1e-12 * scale);
      // Friction takes the spin of a section from its neighbours' by interpolation.
      CHECK(torque.norm() < (effect->name() == "friction" ? 1e-3 : 1e-11) * scale);
    }
  }
}

TEST_CASE("gravity draws the whole mass of the rod, and gains what it falls") {
  EveryEffect every(false);
  const Rod& rod = every.rod;
  const Vector x = knotted(rod, 1);
  Vector fallen = x;
  for (int i = 0; i < rod.nodes(); ++i) fallen.segment<3>(3 * i) += Vector3(0, -2, 1);
  const Vector3 weight = M_PI / 4 * 42.17 * every.parameters.gravity;
  for (const auto& effect : every.effects.list) {
    if (effect->name() != "gravity") continue;
    const auto here = test::evaluate(*effect, x, Vector::Zero(x.size()));
    const auto there = test::evaluate(*effect, fallen, Vector::Zero(x.size()));
    Vector3 force = Vector3::Zero();
    for (int i = 0; i < rod.nodes(); ++i) force -= here.gradient.segment<3>(3 * i);
    CHECK((force - weight).norm() < 1e-12);
    CHECK(here.energy - there.energy == Approx(weight.dot(Vector3(0, -2, 1))));
  }
  CHECK(lumped_mass(rod, true).sum() == Approx((3 * M_PI / 4 + M_PI / 32) * 42.17));
}

TEST_CASE("a folded or vanished segment is inadmissible") {
  Eigen::Matrix<double, 9, 1> fold;
  fold << 0, 0, 0, 0, 0, 1, 0, 0.01, 0;
  CHECK(bend_element(fold, 1, 1).energy == inadmissible);
  CHECK(stretch_element(Eigen::Matrix<double, 6, 1>::Zero(), 1, 1).energy == inadmissible);
}

TEST_CASE("crossed straight strands press with the integral of the law over the plane") {
  // Two lines at right angles, a distance 1 + g apart: W = int law(sqrt((1+g)^2 + r^2) - 1) 2 pi r
  // dr.
  const ContactLaw law{2.0, 0.004};
  const double gap = -0.0015;
  const CurveSegment curve(0.5, 0.5, 0.5);
  const SegmentSamples line(curve, 25, 0), other(curve, 25, 100);
  Eigen::Matrix<double, 24, 1> x = Eigen::Matrix<double, 24, 1>::Zero();
  for (int k = 0; k < 4; ++k) {
    x[3 * k] = 0.5 * k - 0.753;
    x[12 + 3 * k + 1] = 0.5 * k - 0.748;
    x[12 + 3 * k + 2] = 1 + gap;
  }
  double energy = 0, force = 0;
  const double dr = 1e-5;
  for (double r = 0.5 * dr; r < 0.2; r += dr) {
    const double distance = std::hypot(1 + gap, r), weight = 2 * M_PI * r * dr;
    energy += weight * law.energy(distance - 1);
    force -= weight * law.slope(distance - 1) * (1 + gap) / distance;
  }
  std::vector<PointRun> runs;
  for (int i = 0; i < 25; ++i) runs.push_back({i, 0, 24});
  Element<24> element;
  ElementSlot slot{0, element.gradient.data(), element.hessian.data()};
  contact_element(x, line, other, runs, law, Order::gradient, slot);
  element.energy = slot.energy;
  CHECK(element.energy == Approx(energy).epsilon(0.005));
  double upper = 0, lower = 0;
  for (int k = 0; k < 4; ++k)
    lower += element.gradient[3 * k + 2], upper += element.gradient[12 + 3 * k + 2];
  CHECK(-upper == Approx(force).epsilon(0.005));
  CHECK(upper == Approx(-lower));
}
