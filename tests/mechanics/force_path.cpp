#include "mechanics/force_path.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace bight;

namespace {

/// A knot of the tension `law(ebar)` that solves whenever the step is not longer than `limit`.
struct FakeKnot final : ForceModel {
  std::function<double(double)> law;
  double limit = 100, at = 0;
  int solves = 0;
  std::vector<double> accepted;
  explicit FakeKnot(std::function<double(double)> tension) : law(std::move(tension)) {}
  Vector predict(double ebar) const override { return Vector::Constant(1, ebar); }
  NewtonResult solve(const Vector&, double ebar) override {
    ++solves;
    NewtonResult result;
    result.iterations = 4;
    result.energy = law(ebar);
    result.status = accepted.empty() || std::abs(ebar - at) <= limit ? NewtonStatus::converged
                                                                     : NewtonStatus::stalled;
    return result;
  }
  StepRow accept(const NewtonResult& result, double ebar) override {
    CHECK(result.energy == law(ebar));  // the one that was solved last
    accepted.push_back(at = ebar);
    StepRow row;
    row.tension = result.energy;
    return row;
  }
  double tension(const NewtonResult& result) const override { return result.energy; }
};

struct Record {
  std::vector<double> ebar;
  PathObserver observer;
  Record() {
    observer.on_record = [this](double at) { ebar.push_back(at); };
  }
};

double loose(double ebar) { return 5 / (ebar * ebar); }

}  // namespace

TEST_CASE("forces are met in both directions, and no accepted state lies behind them") {
  FakeKnot knot(loose);
  knot.limit = GENERATE(100.0, 0.3);
  Record record;
  const ForcePath path{{0.02, 0.5, 0.1}, 20, 1, 30, 0.5, 1e-4};
  const PathOutcome outcome = follow_forces(path, knot, record.observer);
  CHECK(outcome.status == PathStatus::finished);
  REQUIRE(record.ebar.size() == 3);
  for (size_t i = 0; i < 3; ++i) {
    CHECK(loose(record.ebar[i]) == Approx(path.forces[i]).epsilon(1.01e-4));
  }
  CHECK(outcome.steps == static_cast<int>(knot.accepted.size()));
  const double tightest = *std::min_element(knot.accepted.begin(), knot.accepted.end());
  CHECK(loose(tightest) < 0.5 * (1 + 1.01e-4));
  for (size_t i = 1; i < knot.accepted.size(); ++i)
    CHECK(std::abs(knot.accepted[i] - knot.accepted[i - 1]) <= 0.5 + 1e-12);
  if (knot.limit > 1) CHECK(knot.solves <= outcome.steps + 3 * 6);
}

TEST_CASE("a force behind a falling branch is met on the rising one") {
  // Falls by a third between ebar 10 and 8.
  FakeKnot knot(
      [](double ebar) { return loose(ebar) - 0.02 * std::exp(-(ebar - 8) * (ebar - 8)); });
  Record record;
  const PathOutcome outcome = follow_forces({{0.06, 0.08}, 20, 1, 30}, knot, record.observer);
  CHECK(outcome.status == PathStatus::finished);
  REQUIRE(record.ebar.size() == 2);
  CHECK(knot.law(record.ebar[1]) == Approx(0.08).epsilon(1.01e-4));
}

TEST_CASE("a force that is jumped over, or never met, ends the path in words") {
  FakeKnot jumping([](double ebar) { return ebar > 7 ? 0.1 : 0.3; });
  const PathOutcome jumped = follow_forces({{0.2}, 20, 1, 30}, jumping, {});
  CHECK(jumped.status == PathStatus::gave_up);
  CHECK_THAT(jumped.reason, Catch::Contains("jumps over"));
  CHECK(jumping.accepted.back() > 7);
  FakeKnot weak(loose);
  const PathOutcome never = follow_forces({{8}, 20, 1, 30}, weak, {});
  CHECK(never.status == PathStatus::gave_up);
  CHECK_THAT(never.reason, Catch::Contains("does not take"));
  CHECK(weak.accepted.back() == Approx(1));
}
