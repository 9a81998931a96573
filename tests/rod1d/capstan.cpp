#include <catch2/catch.hpp>
#include <cmath>

#include "rod1d/rod_problem.h"

using namespace bight;
using namespace bight::rod1d;

namespace {

constexpr double mu = 0.32;

/// A thin rope around a drum, as two strands of one rod: the drum is a ring of the same tube that
/// is held, the rope lies on the outside of it, in the same plane but for a pitch that keeps its
/// tails apart, and cannot leave that height.
class Capstan {
 public:
  Capstan(double drum, double angle, double friction) {
    const double pitch = 2, margin = 3 / drum;
    Polyline line;
    const auto at = [&](double radius, double phi) {
      return Vector3(radius * std::cos(phi), radius * std::sin(phi), pitch * phi / (2 * M_PI));
    };
    const auto along = [](double phi) { return Vector3(-std::sin(phi), std::cos(phi), 0); };
    const auto arc = [&](double radius, double from, double to) {
      const int count = static_cast<int>(std::ceil(radius * (to - from) / spacing));
      for (int i = 0; i <= count; ++i) line.push_back(at(radius, from + (to - from) * i / count));
    };
    arc(drum, -margin, angle + margin);
    drum_nodes_ = static_cast<int>(line.size());
    // Far around to the rope's loose tail, over right angles.
    const Vector3 from = at(drum, angle + margin), up(0, 0, 40);
    const Vector3 to = at(drum + 1, 0) - tail * along(0);
    for (const double x : {1.0, 3.0, 7.0, 15.0}) line.push_back(from + x * along(angle + margin));
    line.push_back(line.back() + up);
    line.push_back(to - 15 * along(0) + up);
    for (const double x : {15.0, 7.0, 3.0, 1.0}) line.push_back(to - x * along(0));
    first_ = static_cast<int>(line.size());
    const int tail_nodes = static_cast<int>(tail / spacing);
    for (int i = tail_nodes; i > 0; --i) line.push_back(at(drum + 1, 0) - i * spacing * along(0));
    arc(drum + 1, 0, angle);
    for (int i = 1; i <= tail_nodes; ++i)
      line.push_back(at(drum + 1, angle) + i * spacing * along(angle));
    last_ = static_cast<int>(line.size()) - 1;

    Rod rod;
    for (size_t i = 1; i < line.size(); ++i)
      rod.rest_length.push_back((line[i] - line[i - 1]).norm());
    rod.bending_stiffness = rod.twisting_stiffness = 1e-5;
    problem_ =
        std::make_unique<RodProblem>(rod, line, true, RodProblem::Touch{{20, 0.002}, friction});
    for (int i = 0; i <= first_; ++i) problem_->hold(i);
    for (int i = 0; i < first_; ++i) problem_->hold_angle(i);
    for (int i = first_; i <= last_; ++i) problem_->hold(i, 2);
    problem_->hold(last_);
    back_ = -along(0), ahead_ = along(angle);
    place_[0] = line[first_], place_[1] = line[last_];
  }

  /// Moves the tails outwards by that much.
  bool pull(double loose, double taut) {
    place_[0] += loose * back_, place_[1] += taut * ahead_;
    problem_->move(first_, place_[0]), problem_->move(last_, place_[1]);
    const NewtonResult result = problem_->solve(400);
    return result.ok();
  }
  double ratio() const { return tension(last_ - 1) / tension(first_); }

 private:
  static constexpr double spacing = 0.5, tail = 4;
  /// Of a segment: the tails are straight.
  double tension(int segment) const {
    const Polyline nodes = problem_->nodes();
    const Rod& rod = problem_->rod();
    return rod.stretching_stiffness *
           ((nodes[segment + 1] - nodes[segment]).norm() / rod.rest_length[segment] - 1);
  }
  int drum_nodes_, first_, last_;
  std::unique_ptr<RodProblem> problem_;
  Vector3 back_, ahead_, place_[2];
};

/// Taut over loose tension of a rope that slides around a drum.
double capstan_ratio(double drum, double angle) {
  Capstan capstan(drum, angle, mu);
  REQUIRE(capstan.pull(0.02, 0.02));
  CHECK(capstan.ratio() == Approx(1).epsilon(1e-3));
  for (const int k : {0, 1}) {
    (void)k;
    REQUIRE(capstan.pull(-0.02, 0.02));
  }
  return capstan.ratio();
}

/// exp(mu angle) is for a rope that is thin against the drum: friction acts at its surface, half a
/// diameter nearer to the drum's axis than its tension. What that changes falls with 1/radius.
void check_capstan(double angle) {
  const double exact = std::exp(mu * angle), radius[2] = {11, 21};  // of the rope's centerline
  const double coarse = capstan_ratio(radius[0] - 1, angle);
  const double fine = capstan_ratio(radius[1] - 1, angle);
  const double thin = (radius[1] * fine - radius[0] * coarse) / (radius[1] - radius[0]);
  INFO("ratios " << coarse << ", " << fine << ", of a thin rope " << thin << ", exact " << exact);
  CHECK((exact - coarse) / (exact - fine) == Approx(radius[1] / radius[0]).epsilon(0.03));
  CHECK(thin == Approx(exact).epsilon(1e-3));
}

/// Steepest slope, as its tangent, on which a straight strand rests that lies along another one:
/// the force that draws it along over its weight, while it slides.
double steepest_slope(double friction) {
  Polyline line;
  for (int i = 0; i <= 24; ++i) line.push_back(Vector3(0.5 * i, 0, 0));
  // Around from one end to the other, and down onto the strand from so high that it neither presses
  // on it nor holds it back.
  for (const double x : {1.0, 3.0, 7.0, 15.0}) line.push_back(Vector3(12 + x, 0, 0));
  line.push_back(Vector3(27, 0, 150));
  line.push_back(Vector3(2, 0, 150));
  const int first = static_cast<int>(line.size());
  for (int i = 0; i <= 16; ++i) line.push_back(Vector3(2 + 0.5 * i, 0, 1));
  const int last = static_cast<int>(line.size()) - 1;
  Rod rod;
  for (size_t i = 1; i < line.size(); ++i)
    rod.rest_length.push_back((line[i] - line[i - 1]).norm());
  rod.bending_stiffness = rod.twisting_stiffness = 1e-6;  // the corners press on nothing
  RodProblem problem(rod, line, true, {{20, 0.002}, friction});
  for (int i = 0; i < first; ++i) problem.hold(i), problem.hold_angle(i);
  for (int i = first; i <= last; ++i) problem.hold(i, 1);
  const double weight = 1e-4;
  for (int i = first; i <= last; ++i) problem.load(i, Vector3(0, 0, -weight));
  problem.hold(last, 0);
  for (int k = 0; k < 6; ++k) {
    if (k > 0) problem.move(last, problem.nodes()[last] + Vector3(0.004, 0, 0));
    const NewtonResult result = problem.solve(400);
    INFO(result.reason);
    REQUIRE(result.ok());
  }
  return problem.reaction(last).x() / (weight * (last - first + 1));
}

}  // namespace

TEST_CASE("a rope around a drum: exp(mu phi) for a quarter turn") { check_capstan(0.5 * M_PI); }

TEST_CASE("a rope around a drum: exp(mu phi) for half a turn and a whole one", "[.long]") {
  check_capstan(M_PI);
  check_capstan(2 * M_PI);
}

TEST_CASE("a strand rests on a slope of 0.495 with friction of 0.50, and not with 0.49") {
  const double smooth = steepest_slope(0.49), rough = steepest_slope(0.50);
  INFO("slopes " << smooth << ", " << rough);
  CHECK(smooth < 0.495);
  CHECK(rough > 0.495);
  CHECK(smooth == Approx(0.49).epsilon(3e-3));
  CHECK(rough == Approx(0.50).epsilon(3e-3));
}
