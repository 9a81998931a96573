#include "mechanics/path.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace bight;

namespace {

/// Solves whenever the step is not longer than `limit(ebar)`; counts what it is asked.
struct FakeModel final : PathModel {
  std::function<double(double)> limit = [](double) { return 100.0; };
  int iterations = 4, solves = 0;
  double at = 0;
  std::vector<double> accepted;
  Vector predict(double ebar) const override { return Vector::Constant(1, ebar); }
  NewtonResult solve(const Vector& guess, double ebar) override {
    ++solves;
    CHECK(guess[0] == ebar);
    NewtonResult result;
    result.iterations = iterations;
    const bool first = accepted.empty();
    const bool fine = first ? limit(ebar) > 0 : std::abs(ebar - at) <= limit(ebar) + 1e-12;
    result.status = fine ? NewtonStatus::converged : NewtonStatus::stalled;
    if (!fine) result.reason = "too far";
    return result;
  }
  StepRow accept(const NewtonResult&, double ebar) override {
    at = ebar;
    accepted.push_back(ebar);
    return {};
  }
};

struct Seen {
  std::vector<StepRow> rows;
  std::vector<double> records;
  PathObserver observer;
  Seen() {
    observer.on_step = [this](const StepRow& row) { rows.push_back(row); };
    observer.on_record = [this](double ebar) { records.push_back(ebar); };
  }
};

}  // namespace

TEST_CASE("the path lands on waypoints and records, in both directions, with steps in bounds") {
  FakeModel model;
  Seen seen;
  Path path;
  path.waypoints = {10, 7.3, 9};
  path.max_step = 0.5;
  path.record = {10, 8.05, 7.3, 50};
  const PathOutcome outcome = follow(path, model, seen.observer);
  CHECK(outcome.status == PathStatus::finished);
  CHECK(seen.records == std::vector<double>{10, 8.05, 7.3, 8.05});
  CHECK(model.accepted.front() == 10);
  CHECK(model.accepted.back() == 9);
  CHECK(outcome.steps == static_cast<int>(seen.rows.size()));
  for (size_t i = 1; i < seen.rows.size(); ++i) {
    CHECK(std::abs(seen.rows[i].increment) <= 0.5 + 1e-12);
    CHECK(seen.rows[i].ebar == Approx(seen.rows[i - 1].ebar + seen.rows[i].increment));
  }
}

TEST_CASE("a step that fails is cut, and steps grow again where it is easy") {
  FakeModel model;
  model.limit = [](double ebar) { return ebar > 8 && ebar < 9 ? 0.1 : 100.0; };
  Seen seen;
  Path path;
  path.waypoints = {10, 5};
  path.max_step = 0.8;
  const PathOutcome outcome = follow(path, model, seen.observer);
  CHECK(outcome.status == PathStatus::finished);
  CHECK(outcome.cutbacks > 0);
  double smallest = 1, last = 0;
  bool reason = false;
  for (const StepRow& row : seen.rows) {
    if (row.increment != 0) smallest = std::min(smallest, std::abs(row.increment));
    last = std::abs(row.increment);
    if (row.cutbacks > 0) reason = reason || row.cut_reason == "too far";
    if (row.cutbacks == 0) CHECK(row.cut_reason.empty());
    CHECK(std::abs(row.increment) <= path.max_step * std::pow(0.5, row.cutbacks) + 1e-12);
  }
  CHECK(smallest <= 0.1);
  CHECK(last > 0.3);
  CHECK(reason);
}

TEST_CASE("after a cut, steps grow again: where solves are hard later, and more slowly") {
  const auto rows = [](int iterations) {
    FakeModel model;
    model.iterations = iterations;
    model.limit = [](double ebar) { return ebar > 8 && ebar < 9 ? 0.1 : 100.0; };
    Seen seen;
    Path path;
    path.waypoints = {10, 7};
    path.max_step = 0.8;
    CHECK(follow(path, model, seen.observer).status == PathStatus::finished);
    return seen.rows;
  };
  const auto longest = [&](int iterations) {
    double step = 0;
    for (const StepRow& row : rows(iterations))
      if (row.ebar < 8) step = std::max(step, std::abs(row.increment));
    return step;
  };
  CHECK(longest(4) > longest(20));
  CHECK(longest(20) > 0.15);
  CHECK(longest(40) > 0.15);
  const std::vector<StepRow> hard = rows(40);
  bool grew = false;
  for (size_t k = 2; k < hard.size(); ++k) {
    const double growth = hard[k].increment / hard[k - 1].increment;
    if (hard[k - 1].cutbacks > 0) CHECK(growth <= 1 + 1e-12);
    grew = grew || growth > 1.1;
  }
  CHECK(grew);
}

TEST_CASE("a path that cannot go on gives up with the reason, and keeps what it has") {
  FakeModel model;
  model.limit = [](double ebar) { return ebar < 8 ? -1.0 : 100.0; };
  Seen seen;
  Path path;
  path.waypoints = {10, 5};
  path.min_step = 0.01;
  const PathOutcome outcome = follow(path, model, seen.observer);
  CHECK(outcome.status == PathStatus::gave_up);
  CHECK_THAT(outcome.reason, Catch::Contains("too far"));
  CHECK(seen.rows.back().ebar == Approx(8).margin(0.02));

  FakeModel hopeless;
  hopeless.limit = [](double) { return -1.0; };
  CHECK(follow(path, hopeless, seen.observer).status == PathStatus::gave_up);
  CHECK(hopeless.accepted.empty());
}

TEST_CASE("an interrupted path stops after the step at hand") {
  FakeModel model;
  Seen seen;
  seen.observer.interrupted = [&] { return seen.rows.size() >= 3; };
  Path path;
  path.waypoints = {10, 0};
  CHECK(follow(path, model, seen.observer).status == PathStatus::interrupted);
  CHECK(seen.rows.size() == 3);
}
