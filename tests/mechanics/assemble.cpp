#include "mechanics/assemble.h"

#include <omp.h>

#include <catch2/catch.hpp>
#include <random>

#include "tests/mechanics/toy_effects.h"

using namespace bight;

namespace {

/// Twelve points of three coordinates and two angles that turn the last three about axes askew.
struct Problem {
  Vector x;
  std::vector<int> blocks;
  std::vector<bool> held;
  std::vector<Turn> turns{2};
  std::vector<Image> images;
  EffectList effects;

  Problem() {
    const int points = 12;
    std::mt19937 generator(2);
    std::normal_distribution<double> normal;
    x.resize(3 * points + 2);
    for (double& value : x) value = normal(generator);
    x[3 * points] = x[3 * points + 1] = 0;
    for (int i = 0; i < points; ++i) blocks.push_back(3 * i);
    for (int angle : {0, 1}) blocks.push_back(3 * points + angle);
    held.assign(x.size(), false);
    held[0] = held[1] = held[2] = true;  // a whole point
    held[7] = true;                      // one coordinate of another
    const Vector3 axis = Vector3(1, 2, -0.5).normalized();
    turns[0] = {{0.3, -0.2, 0.1}, axis, 3 * points, {3 * (points - 2), 3 * (points - 1)}};
    turns[1] = {{-0.1, 0.4, 0.2}, Vector3::UnitX(), 3 * points + 1, {3 * (points - 3)}};
    std::vector<test::Springs::Spring> springs;
    for (int i = 0; i + 1 < points; ++i) springs.push_back({3 * i, 3 * i + 3, 1.0 + 0.1 * i, 0.7});
    for (int i = 0; i + 5 < points; ++i) springs.push_back({3 * i + 15, 3 * i, 0.5, 1.2});
    effects.push_back(std::make_unique<test::Springs>(springs));
  }
  Unknowns unknowns() const {
    return Unknowns(blocks, static_cast<int>(x.size()), held, turns, images);
  }
  /// Two points become images of others under half a turn about x, their neighbours among them;
  /// the second turn goes against the first.
  void fold() {
    images.resize(x.size());
    images[turns[1].angle] = {turns[0].angle, -1};
    for (const auto& [image, source] : {std::pair{3, 4}, std::pair{5, 8}})
      for (int c = 0; c < 3; ++c) {
        images[3 * image + c] = {3 * source + c, c == 0 ? 1.0 : -1.0};
        x[3 * image + c] = images[3 * image + c].sign * x[3 * source + c];
      }
  }
};

}  // namespace

TEST_CASE(
    "gradient and Hessian by unknowns are derivatives of the energy, turned points and images "
    "included") {
  Problem problem;
  const bool folded = GENERATE(false, true);
  CAPTURE(folded);
  if (folded) problem.fold();
  const Unknowns unknowns = problem.unknowns();
  CHECK(unknowns.size() == 3 * 9 - 3 - 1 + 2 - (folded ? 7 : 0));
  Assembler assembler(unknowns, problem.effects);
  const int n = unknowns.size();
  const auto moved = [&](const Vector& step) {
    Vector x = problem.x;
    unknowns.advance(x, unknowns.expand(problem.x, step));
    return x;
  };
  // Along a direction from x: the energy's first and second derivative.
  Vector gradient;
  assembler.refresh(problem.x);
  assembler.assemble(problem.x, Order::hessian, gradient);
  const Vector g = unknowns.reduce(problem.x, gradient);
  const Eigen::MatrixXd H = test::dense(assembler.hessian());
  for (int trial = 0; trial < 5; ++trial) {
    Vector v = Vector::Zero(n);
    if (trial == 0)
      v[n - 1] = 1;  // an angle alone
    else
      for (int i = 0; i < n; ++i) v[i] = std::sin(1.0 + i * trial);
    double slope_error[2], curvature_error[2];
    for (const int k : {0, 1}) {
      const double h = k ? 5e-3 : 1e-2;
      const double up = assembler.energy(moved(h * v)), down = assembler.energy(moved(-h * v));
      const double here = assembler.energy(problem.x);
      slope_error[k] = std::abs((up - down) / (2 * h) - g.dot(v));
      curvature_error[k] = std::abs((up - 2 * here + down) / (h * h) - v.dot(H * v));
    }
    INFO("direction " << trial);
    CHECK(slope_error[0] / slope_error[1] == Approx(4).epsilon(0.1));
    CHECK(curvature_error[0] / curvature_error[1] == Approx(4).epsilon(0.1));
  }
}

TEST_CASE("a carried point keeps its distance from the axis, however far it turns") {
  Problem problem;
  const Unknowns unknowns = problem.unknowns();
  Vector dx = Vector::Zero(problem.x.size());
  dx[problem.turns[0].angle] = 2.0;
  Vector x = problem.x;
  unknowns.advance(x, dx);
  for (const int first : problem.turns[0].carried) {
    const Vector3 before = problem.x.segment<3>(first) - problem.turns[0].point;
    const Vector3 after = x.segment<3>(first) - problem.turns[0].point;
    CHECK(after.norm() == Approx(before.norm()));
    CHECK(after.dot(problem.turns[0].axis) == Approx(before.dot(problem.turns[0].axis)));
    CHECK((after - before).norm() > 0.1);
  }
}

TEST_CASE("the pattern is kept while it covers the stencils, and grows when it does not") {
  Problem problem;
  const Unknowns unknowns = problem.unknowns();
  Assembler assembler(unknowns, problem.effects);
  Vector gradient;
  assembler.assemble(problem.x, Order::hessian, gradient);
  const int version = assembler.pattern_version();
  assembler.assemble(problem.x, Order::hessian, gradient);
  CHECK(assembler.pattern_version() == version);
  const double before = test::dense(assembler.hessian()).norm();
  // A spring between points that were not coupled.
  problem.effects.push_back(
      std::make_unique<test::Springs>(std::vector<test::Springs::Spring>{{3, 24, 2.0, 0.1}}));
  assembler.assemble(problem.x, Order::hessian, gradient);
  CHECK(assembler.pattern_version() == version + 1);
  CHECK(test::dense(assembler.hessian()).norm() != Approx(before));
}

TEST_CASE("the sums do not depend on the number of threads") {
  std::vector<test::Springs::Spring> springs;
  const int points = 900;
  for (int i = 0; i + 1 < points; ++i) springs.push_back({3 * i, 3 * i + 3, 1, 0.5});
  EffectList effects;
  effects.push_back(std::make_unique<test::Springs>(springs));
  std::vector<int> blocks;
  for (int i = 0; i < points; ++i) blocks.push_back(3 * i);
  const Unknowns unknowns(blocks, 3 * points, std::vector<bool>(3 * points, false));
  Vector x(3 * points);
  for (int i = 0; i < x.size(); ++i) x[i] = std::sin(0.37 * i);
  double energy[2];
  Vector gradient[2];
  std::vector<double> value[2];
  for (const int k : {0, 1}) {
    omp_set_num_threads(k + 1);
    Assembler assembler(unknowns, effects);
    energy[k] = assembler.assemble(x, Order::hessian, gradient[k]);
    value[k] = assembler.hessian().value;
  }
  omp_set_num_threads(omp_get_num_procs());
  CHECK(energy[0] == energy[1]);
  CHECK(gradient[0] == gradient[1]);
  CHECK(value[0] == value[1]);
}

TEST_CASE("an effect costs the unknowns and entries that no effect before it needs") {
  // Four points in a row; the second effect couples the first point with the third.
  EffectList effects;
  effects.push_back(std::make_unique<test::Springs>(
      std::vector<test::Springs::Spring>{{0, 3, 1, 1}, {3, 6, 1, 1}}));
  effects.push_back(std::make_unique<test::Springs>(
      std::vector<test::Springs::Spring>{{3, 6, 1, 1}, {0, 6, 1, 1}, {6, 9, 1, 1}}));
  const Unknowns unknowns({0, 3, 6, 9}, 12, std::vector<bool>(12, false));
  const Assembler assembler(unknowns, effects);
  const auto costs = assembler.costs({{"springs", 2.5}});
  REQUIRE(costs.size() == 2);
  CHECK(costs[0].stencils == 2);
  CHECK(costs[0].unknowns == 9);
  CHECK(costs[0].entries == 9 * (3 + 2));  // blocks on the diagonal and below it
  CHECK(costs[1].stencils == 3);
  CHECK(costs[1].unknowns == 3);
  CHECK(costs[1].entries == 9 * (1 + 2));
  CHECK(costs[0].seconds == 2.5);
}
