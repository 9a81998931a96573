#include "rod1d/effects/friction.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "rod1d/run_rod.h"
#include "tests/derivatives.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

/// One rod whose ends lie on each other: strand a along x, strand b above it at the angle `across`,
/// the way between them far away.
struct TwoStrands {
  static constexpr int each = 12;
  Rod rod;
  Vector x;
  FrictionHistory history;
  RubbingPoint middle;

  explicit TwoStrands(double across, double bend = 0) {
    Polyline line;
    const Vector3 along(std::cos(across), std::sin(across), 0);
    for (int i = 0; i <= each; ++i) {
      const double s = 0.25 * (i - 0.5 * each);
      line.push_back(Vector3(s, 0, -bend * s * s));
    }
    line.push_back(Vector3(9, 9, 9));
    for (int i = 0; i <= each; ++i) {
      const double s = 0.25 * (i - 0.5 * each);
      line.push_back(s * along + Vector3(0, 0, 1 + bend * s * s));
    }
    for (size_t i = 1; i < line.size(); ++i)
      rod.rest_length.push_back((line[i] - line[i - 1]).norm());
    x = Vector::Zero(3 * rod.nodes() + rod.segments());
    for (int i = 0; i < rod.nodes(); ++i) x.segment<3>(3 * i) = line[i];
    history = {x, twist_free_frames(rod, x), {}};
    middle = {rod.arc_length()[each / 2], rod.arc_length()[each + 2 + each / 2], 0.01, {}};
  }
  bool first(int node) const { return node <= each; }
  FrictionSpot spot_at(const Vector& now, SlipOf of = SlipOf::surface) const {
    return friction_spots(rod, {middle}, now, carried_frames(rod, history.frames, now), history, of)
        .front();
  }
  void spin(Vector& now, bool strand_a, double angle) const {
    for (int i = 0; i < rod.segments(); ++i)
      if (first(i) == strand_a) now[rod.angle(i)] += angle;
  }
};

double tbar(double tension) { return tension * 16 / M_PI; }

}  // namespace

TEST_CASE("friction sticks elastically, then slides at mu N against the slip") {
  const FrictionLaw law{2.0, 0.01};  // elastic slip 0.005
  const Vector2 direction = Vector2(3, -4) / 5;
  const auto stick = friction_element(0.002 * direction, law);
  CHECK((stick.gradient - 0.004 * direction).norm() < 1e-15);
  const auto slide = friction_element(0.3 * direction, law);
  CHECK((slide.gradient - 0.01 * direction).norm() < 1e-15);
  CHECK(slide.energy == Approx(0.01 * (0.3 - 0.0025)));
  for (const double size : {0.0, 1e-8, 0.002, 0.00499, 0.00501, 0.3}) {
    const Vector2 s = size * direction;
    const auto at = friction_element(s, law);
    for (const int c : {0, 1}) {
      const Vector2 h = 1e-6 * Vector2::Unit(c);
      const auto plus = friction_element(s + h, law), minus = friction_element(s - h, law);
      CHECK((plus.energy - minus.energy) / 2e-6 == Approx(at.gradient[c]).margin(1e-8));
      CHECK(((plus.gradient - minus.gradient) / 2e-6 - at.hessian.col(c)).norm() < 1e-5);
    }
  }
}

TEST_CASE("slip of two strands: pushed along, spun, rolled, and moved together") {
  const TwoStrands strands(GENERATE(0.0, 0.7, M_PI / 2), 0.05);
  SECTION("strand a pushed along itself") {
    Vector now = strands.x;
    for (int i = 0; i <= TwoStrands::each; ++i) now[3 * i] += 0.2;
    // A curved strand moves off its own line by bend s^2.
    const Vector2 slip = strands.spot_at(now).slip;
    CHECK(slip[0] == Approx(0.2).epsilon(0.02));
    CHECK(std::abs(slip[1]) < 0.005);
  }
  SECTION("strand a spun about its axis: the surface moves D/2 times the angle") {
    Vector now = strands.x;
    strands.spin(now, true, 0.1);
    const Vector2 slip = strands.spot_at(now).slip;
    CHECK(std::abs(slip[1]) == Approx(0.05).epsilon(0.005));
    CHECK(std::abs(slip[0]) < 1e-3);
  }
  SECTION("both moved rigidly, by a large turn") {
    const Matrix3 turn = Eigen::AngleAxisd(1.3, Vector3(1, 2, -1).normalized()).toRotationMatrix();
    Vector now = strands.x;
    for (int i = 0; i < strands.rod.nodes(); ++i)
      now.segment<3>(3 * i) = turn * strands.x.segment<3>(3 * i) + Vector3(1, 2, 3);
    const Frames carried = carried_frames(strands.rod, strands.history.frames, now);
    for (int i = 0; i < strands.rod.segments(); ++i) {
      const Vector3 d = turn * strands.history.frames.normal[i];
      now[strands.rod.angle(i)] = std::atan2(d.dot(carried.binormal(i)), d.dot(carried.normal[i]));
    }
    CHECK(strands.spot_at(now).slip.norm() < 1e-12);
  }
}

TEST_CASE("slip of centerlines: pushed along, but not spun") {
  const TwoStrands strands(0.7, 0.05);
  Vector now = strands.x;
  strands.spin(now, true, 0.1);
  const FrictionSpot spun = strands.spot_at(now, SlipOf::centerline);
  CHECK(spun.slip.norm() < 1e-12);
  CHECK(spun.gradient.bottomRows<2>().norm() == 0);
  for (int i = 0; i <= TwoStrands::each; ++i) now[3 * i] += 0.2;
  const FrictionSpot pushed = strands.spot_at(now, SlipOf::centerline);
  CHECK(pushed.slip[0] == Approx(0.2).epsilon(0.02));
  CHECK(std::abs(pushed.slip[1]) < 0.005);
  // Force in one direction, and none that loads twist or bends about the centerline.
  CHECK(pushed.gradient.topRows<3>().col(0).norm() == Approx(1));
  CHECK(pushed.gradient.middleRows<6>(3).norm() == 0);
}

TEST_CASE("parallel strands that turn against each other like wheels roll without slip") {
  const TwoStrands strands(0);
  Vector now = strands.x;
  strands.spin(now, true, 0.2);
  strands.spin(now, false, -0.2);
  CHECK(strands.spot_at(now).slip.norm() < 1e-12);
  strands.spin(now, false, 0.4);  // both the same way: they rub
  CHECK(strands.spot_at(now).slip.norm() == Approx(0.2).epsilon(0.02));
}

TEST_CASE("the frozen slip agrees with the exact one to second order") {
  const TwoStrands strands(0.6, 0.04);
  // A smooth motion: sections between segments spin as the mean of these.
  Vector v = strands.x;
  const auto s = strands.rod.arc_length();
  for (int i = 0; i < strands.rod.nodes(); ++i)
    v.segment<3>(3 * i) = Vector3(std::sin(s[i]), std::cos(0.7 * s[i]), std::sin(0.8 * s[i] + 1));
  for (int i = 0; i < strands.rod.segments(); ++i)
    v[strands.rod.angle(i)] = std::cos(0.5 * (s[i] + s[i + 1]));
  const FrictionSpot spot = strands.spot_at(strands.x);
  CHECK(spot.slip.norm() < 1e-14);
  const auto stencil = friction_stencil(strands.rod, spot.a, spot.b);
  Eigen::Matrix<double, friction_coordinates, 1> along;
  for (int k = 0; k < friction_coordinates; ++k) along[k] = v[stencil[k]];
  const Vector2 slope = spot.gradient.transpose() * (spot.map * along);
  CHECK(slope.norm() > 0.3);
  double last = 0;
  for (const double h : {0.04, 0.02, 0.01}) {
    const double error = (strands.spot_at(strands.x + h * v).slip - h * slope).norm();
    INFO("h " << h << " error " << error << " after " << last << " slope " << slope.norm());
    if (last > 0) CHECK(error < last / 3.3);
    last = error;
  }
}

TEST_CASE("a spot remembers its elastic slip, another one does not") {
  TwoStrands strands(0.7);
  strands.history.memory = {
      {strands.middle.arc_a, strands.middle.arc_b + 0.02, Vector2(0.001, -0.0005)}};
  CHECK((strands.spot_at(strands.x).slip - Vector2(0.001, -0.0005)).norm() < 1e-12);
  strands.history.memory[0].arc_b += 3;
  CHECK(strands.spot_at(strands.x).slip.norm() < 1e-12);
}

TEST_CASE("tightened or loosened, what the ends give to a knot is stored or dissipated") {
  RodParameters parameters;
  parameters.segments = 170;
  parameters.friction = 0.1;
  parameters.twist = true;
  parameters.path.waypoints = GENERATE(std::vector<double>{26, 24}, std::vector<double>{24, 26});
  const RodResult result = run_rod(parameters);
  INFO(result.outcome.reason);
  REQUIRE(result.outcome.status == PathStatus::finished);
  CHECK(result.effects ==
        std::vector<std::string>{"stretch", "bend", "twist", "contact", "friction"});
  double work = 0;
  for (size_t i = 0; i < result.steps.size(); ++i) {
    const StepRow& row = result.steps[i];
    INFO("ebar " << row.ebar);
    CHECK(row.max_penetration < 0.0025);
    CHECK(row.reaction_mismatch < 1e-6);  // nothing but the grips holds the knot
    if (i == 0) continue;
    const StepRow& before = result.steps[i - 1];
    CHECK(row.dissipated > before.dissipated);
    work += 0.5 * (row.tension + before.tension) * (before.ebar - row.ebar);
  }
  const StepRow &first = result.steps.front(), &last = result.steps.back();
  const double stored = last.energy - first.energy;
  CHECK(last.dissipated - first.dissipated == Approx(work - stored).epsilon(0.015));
}

TEST_CASE("a loop of loosening and tightening closes, and its area is what friction dissipates") {
  RodParameters parameters;
  parameters.friction = 0.1;
  parameters.twist = true;
  parameters.path.waypoints = {25, 22, 25, 22};
  parameters.path.max_step = 0.25;
  const RodResult result = run_rod(parameters);
  REQUIRE(result.outcome.status == PathStatus::finished);
  const std::vector<StepRow>& rows = result.steps;
  const auto tight = std::find_if(
      rows.begin(), rows.end(), [](const StepRow& row) { return std::abs(row.ebar - 22) < 1e-9; });
  REQUIRE(tight != rows.end());
  double area = 0, loosest = 22;
  for (auto row = tight + 1; row != rows.end(); ++row) {
    area += 0.5 * (row->tension + (row - 1)->tension) * ((row - 1)->ebar - row->ebar);
    loosest = std::max(loosest, row->ebar);
    CHECK(row->dissipated >= (row - 1)->dissipated);
  }
  CHECK(loosest == Approx(25));
  const StepRow& last = rows.back();
  CHECK(last.ebar == Approx(22));
  CHECK(last.tension == Approx(tight->tension).epsilon(2e-3));
  CHECK(last.energy == Approx(tight->energy).epsilon(2e-3));
  CHECK(area == Approx(last.dissipated - tight->dissipated).epsilon(0.02));
  // Loosened, the ends are pulled less by much more than that.
  const auto back = std::find_if(
      tight, rows.end(), [](const StepRow& row) { return std::abs(row.ebar - 23.5) < 1e-9; });
  CHECK(back->tension < 0.8 * tight->tension);
}

TEST_CASE("strong friction: a smooth curve while the knot is tightened") {
  RodParameters parameters;
  parameters.friction = 0.32;
  parameters.twist = true;
  parameters.path.waypoints = {22, 20};
  const RodResult result = run_rod(parameters);
  REQUIRE(result.outcome.status == PathStatus::finished);
  CHECK(tbar(result.steps.front().tension) == Approx(0.0608).epsilon(0.02));
  CHECK(result.steps.front().end_turn == Approx(0).margin(0.005));
  CHECK(std::abs(result.steps.back().end_turn) > 0.05);  // the rod rolls
  // A smooth curve: d log T/debar changes little from step to step.
  const auto slope = [&](size_t k) {
    const StepRow &a = result.steps[k - 1], &b = result.steps[k];
    return std::log(b.tension / a.tension) / (b.ebar - a.ebar);
  };
  for (size_t k = 2; k < result.steps.size(); ++k)
    CHECK(slope(k) == Approx(slope(k - 1)).epsilon(0.05));
}

TEST_CASE("weak friction splits the curve of a loose knot by mu times the contact forces") {
  // Virtual work: the strands slide past each other by what is pulled out.
  RodParameters parameters;
  parameters.length = 266.6;
  parameters.segments = 400;
  parameters.path.max_step = 2.5;
  parameters.path.waypoints = {200, 195};
  parameters.path.record = {195};
  parameters.follow_knot = false;  // equal segments
  const RodResult none = run_rod(parameters);
  parameters.friction = 0.05;
  parameters.twist = true;
  const RodResult tightened = run_rod(parameters);
  parameters.path.waypoints = {190, 195};
  const RodResult loosened = run_rod(parameters);
  for (const RodResult* result :
       std::initializer_list<const RodResult*>{&none, &tightened, &loosened})
    REQUIRE(result->outcome.status == PathStatus::finished);
  const double up = tightened.steps.back().tension, down = loosened.steps.back().tension;
  double contact = 0;  // every force acts on two strands
  for (const double force : none.states.front().contact_force)
    contact += 0.5 * force * parameters.length / parameters.segments;
  CHECK(0.5 * (up - down) == Approx(0.05 * contact).epsilon(0.03));
  CHECK(0.5 * (up + down) == Approx(none.steps.back().tension).epsilon(0.03));
}

TEST_CASE("friction acts in a short rod from where there is room for its knot") {
  // 130 mm: 2 D before the path begins, its ends would be 2.2 D apart.
  RodParameters parameters;
  parameters.length = 130 / 8.3;
  parameters.segments = 126;
  parameters.path.waypoints = {11.5, 11};
  const RodResult none = run_rod(parameters);
  parameters.friction = 0.32;
  parameters.twist = true;
  const RodResult whole = run_rod(parameters);
  parameters.path.waypoints = {11};
  const RodResult end = run_rod(parameters);
  for (const RodResult* result : std::initializer_list<const RodResult*>{&none, &whole, &end})
    REQUIRE(result->outcome.status == PathStatus::finished);
  CHECK(whole.steps.back().tension > 1.5 * none.steps.back().tension);
  CHECK(end.steps.back().tension == Approx(whole.steps.back().tension).epsilon(0.01));
}
