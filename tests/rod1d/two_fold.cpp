#include "rod1d/two_fold.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "mechanics/assemble.h"
#include "rod1d/effects.h"
#include "rod1d/overhand.h"
#include "rod1d/polyline.h"
#include "rod1d/remesh.h"
#include "rod1d/tie.h"
#include "tests/mechanics/toy_effects.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

constexpr int segments = 170;
constexpr double length = 42.17;

Polyline start(TwoFold::Kind kind) {
  if (kind == TwoFold::Kind::half_turn) return overhand_start(length, 28, segments);
  return tied(tie_protocol("figure-eight"), length, 29);
}

/// A loose knot, drawn together until it touches, twisted, exactly symmetric: by half a turn (an
/// overhand knot) or by inversion (a figure-eight).
struct SymmetricKnot {
  TwoFold symmetry;
  RodParameters parameters;
  Rod rod = uniform_rod(length, segments, 0.5);
  Frames source;
  Vector x = Vector::Zero(3 * rod.nodes() + segments);
  RodEffects effects;
  EffectList halves;

  explicit SymmetricKnot(TwoFold::Kind kind) : symmetry(kind, segments) {
    parameters.twist = true;
    Polyline line = chord_on_axis(start(kind));
    const auto found = TwoFold::find(line, segments);
    REQUIRE(found);
    REQUIRE(found->kind() == kind);
    line = resampled(line, segments);
    for (int i = 0; i < rod.nodes(); ++i)
      x.segment<3>(3 * i) = line[i].cwiseProduct(Vector3(0.85, 0.85, 1));
    for (int j = 0; j < segments; ++j)
      x[rod.angle(j)] = 0.3 * std::sin(0.05 * (j - 84.5) + (kind == TwoFold::Kind::inversion));
    symmetry.impose(x);
    source = twist_free_frames(rod, x);
    symmetry.align(source);
    effects = make_effects(rod, parameters, source);
    effects.contact->set_law({0.3, 0.2});
    for (const auto& effect : effects.list)
      halves.push_back(std::make_unique<HalfEffect>(*effect, symmetry, false));
  }
};

const auto both = {TwoFold::Kind::half_turn, TwoFold::Kind::inversion};

Vector image_of(TwoFold::Kind kind, const Vector& x) {
  const Vector3 signs = kind == TwoFold::Kind::half_turn ? Vector3(1, -1, -1) : Vector3(-1, -1, -1);
  Vector out = x;
  for (int i = 0; i <= segments; ++i)
    out.segment<3>(3 * i) = x.segment<3>(3 * (segments - i)).cwiseProduct(signs);
  return out;
}

}  // namespace

TEST_CASE("a symmetric start is turned so that its axis is x, another one has none") {
  Polyline line = chord_on_axis(start(TwoFold::Kind::half_turn));
  const Matrix3 turn = Eigen::AngleAxisd(1.1, Vector3::UnitZ()).toRotationMatrix();
  for (Vector3& p : line) p = (turn * p).eval();
  const auto found = TwoFold::find(line, segments);
  REQUIRE(found);
  CHECK(found->kind() == TwoFold::Kind::half_turn);
  const size_t last = line.size() - 1;
  CHECK(last % 2 == 0);
  CHECK(line[last / 2].tail<2>().norm() < 1e-14);
  CHECK(line[last / 2].x() > 1);
  CHECK_FALSE(TwoFold::find(line, segments + 1));  // no node in the middle
  // A little beside: made symmetric. Much: not.
  line[60] += Vector3(0, 0, 0.01);
  CHECK(TwoFold::find(line, segments));
  const size_t end = line.size() - 1;
  for (size_t i = 0; i <= end; ++i)
    CHECK((line[i] - line[end - i].cwiseProduct(Vector3(1, -1, -1))).norm() < 1e-12);
  line[60] += Vector3(0, 0, 0.2);
  CHECK_FALSE(TwoFold::find(line, segments));
}

TEST_CASE("half a rod and its image have the energy, gradient and Hessian of the whole") {
  SymmetricKnot knot(GENERATE(values(both)));
  const int count = static_cast<int>(knot.x.size());
  std::vector<bool> held(count, false);
  knot.symmetry.hold_middle(held);
  const auto images = knot.symmetry.images(true);
  const Unknowns unknowns(knot.rod.blocks(true), count, held, {}, images);
  CHECK(unknowns.size() < count / 2 + 4);
  Assembler whole(unknowns, knot.effects.list), half(unknowns, knot.halves);
  Vector whole_gradient, half_gradient;
  whole.refresh(knot.x), half.refresh(knot.x);
  const double energy = whole.assemble(knot.x, Order::hessian, whole_gradient);
  CHECK(half.assemble(knot.x, Order::hessian, half_gradient) == Approx(energy).epsilon(1e-12));
  CHECK(whole.energy_by_effect().at("contact") > 0);
  CHECK(whole.energy_by_effect().at("twist") > 0);
  for (const auto& [name, value] : whole.energy_by_effect())
    CHECK(half.energy_by_effect().at(name) == Approx(value).epsilon(1e-11));
  const Vector g = unknowns.reduce(knot.x, whole_gradient);
  CHECK((unknowns.reduce(knot.x, half_gradient) - g).norm() < 1e-11 * g.norm());
  const Eigen::MatrixXd H = test::dense(whole.hessian());
  CHECK((test::dense(half.hessian()) - H).norm() < 1e-12 * H.norm());
}

TEST_CASE("the gradient of a symmetric rod is symmetric: its equilibria are those of the whole") {
  const auto kind = GENERATE(values(both));
  SymmetricKnot knot(kind);
  const Unknowns unknowns(knot.rod.blocks(true), static_cast<int>(knot.x.size()),
                          std::vector<bool>(knot.x.size(), false));
  Assembler whole(unknowns, knot.effects.list);
  Vector gradient;
  whole.refresh(knot.x);
  whole.assemble(knot.x, Order::gradient, gradient);
  const Vector image = image_of(kind, gradient);
  CHECK((image - gradient).head(3 * knot.rod.nodes()).norm() < 1e-11 * gradient.norm());
  for (int j = 0; j < segments / 2; ++j)
    CHECK(gradient[knot.rod.angle(j)] ==
          Approx(knot.symmetry.angle_sign() * gradient[knot.rod.angle(segments - 1 - j)])
              .margin(1e-14));
}

TEST_CASE("one half simulated or the whole: the same knot, with friction and without") {
  RodParameters parameters;
  parameters.knot = GENERATE("overhand", "figure-eight");
  parameters.from_straight = parameters.knot == "figure-eight";
  if (parameters.knot == "overhand") parameters.friction = GENERATE(0.0, 0.2);
  parameters.twist = parameters.friction > 0;
  parameters.segments = 200;
  parameters.path.waypoints = {24, 23};
  const RodResult half = run_rod(parameters);
  parameters.symmetry = false;
  const RodResult whole = run_rod(parameters);
  REQUIRE(half.outcome.status == PathStatus::finished);
  REQUIRE(whole.outcome.status == PathStatus::finished);
  CHECK(half.unknowns < 0.52 * whole.unknowns);
  const double same = parameters.friction > 0 ? 1e-3 : 1e-5;
  const StepRow &a = half.steps.back(), &b = whole.steps.back();
  CHECK(a.tension == Approx(b.tension).epsilon(same));
  CHECK(a.energy == Approx(b.energy).epsilon(same));
  CHECK(a.dissipated == Approx(b.dissipated).epsilon(0.01));
  CHECK(a.end_turn == Approx(b.end_turn).margin(0.02));
}

TEST_CASE("a state on other nodes keeps its shape, its directors and its twist") {
  const double radius = 4, pitch = 3;
  double last_point = 0, last_director = 0;
  for (const int n : {60, 120, 240}) {
    // A helix of one and a half turns; directors that turn about it, at an uneven rate.
    const double total = 1.5 * std::hypot(2 * M_PI * radius, pitch);
    std::vector<double> arc, wanted;
    for (int i = 0; i <= n; ++i) {
      arc.push_back(total * i / n);
      wanted.push_back(total * (i / double(n) + 0.02 * std::sin(4 * M_PI * i / n)));
    }
    const auto curve = [&](double s) {
      const double phi = s / std::hypot(radius, pitch / (2 * M_PI));
      return Vector3(radius * std::cos(phi), radius * std::sin(phi), pitch * phi / (2 * M_PI));
    };
    Rod rod;
    Vector x = Vector::Zero(3 * (n + 1) + n);
    for (int i = 0; i <= n; ++i) x.segment<3>(3 * i) = curve(arc[i]);
    for (int i = 0; i < n; ++i) {
      rod.rest_length.push_back(arc[i + 1] - arc[i]);
      const double s = 0.5 * (arc[i] + arc[i + 1]);
      x[3 * (n + 1) + i] = 9 * s / total + std::sin(0.3 * s);
    }
    const Frames frames = twist_free_frames(rod, x);
    Vector y = remeshed(arc, x, wanted);
    const Frames on_y = remeshed(arc, frames, wanted, y);
    keep_twist(arc, x, frames, wanted, on_y, 0, true, false, y);
    double point = 0, director = 0;
    for (int i = 0; i <= n; ++i)
      point = std::max(point, (y.segment<3>(3 * i) - curve(wanted[i])).norm());
    CHECK(total_twist(rod, on_y, y) == Approx(total_twist(rod, frames, x)).epsilon(1e-12));
    const std::vector<double> before = twist_angles(rod, frames, x);
    Rod other;
    for (int i = 0; i < n; ++i) other.rest_length.push_back(wanted[i + 1] - wanted[i]);
    const std::vector<double> now = twist_angles(other, on_y, y);
    for (int i = 1; i + 1 < n; ++i) {
      const double s = 0.5 * (wanted[i] + wanted[i + 1]), exact = 9 * s / total + std::sin(0.3 * s);
      director = std::max(director, std::abs(now[i] - now[0] - exact + before[0]));
    }
    INFO(n << " " << point << " " << director);
    if (last_point > 0) {
      CHECK(point < last_point / 7);        // third order
      CHECK(director < last_director / 3);  // second order
    }
    last_point = point, last_director = director;
  }
}
