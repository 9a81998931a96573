#include "mechanics/coupled_newton.h"

#include <catch2/catch.hpp>

#include "mechanics/gmres.h"
#include "tests/mechanics/toy_effects.h"

using namespace bight;

TEST_CASE("gmres solves an unsymmetric system, exactly when it may take all products") {
  const int n = 30;
  std::srand(3);
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n) * 4 + Eigen::MatrixXd::Random(n, n);
  const Vector b = Vector::Random(n);
  int products = 0;
  const auto times = [&](const Vector& v) {
    ++products;
    return Vector(A * v);
  };
  CHECK((A * gmres(times, b, n, 1e-13) - b).norm() < 1e-11 * b.norm());
  products = 0;
  const Vector rough = gmres(times, b, n, 1e-2);
  CHECK(products < n);
  CHECK((A * rough - b).norm() <= 1.01e-2 * b.norm());
  CHECK(gmres(times, Vector::Zero(n), n, 1e-2).norm() == 0);
}

namespace {

/// The force k d along x on a point at the distance d from the origin: no energy has that gradient.
struct Follower final : Effect, FollowingForces {
  double k, force = 0;
  std::vector<int> at;
  explicit Follower(double k, int point) : k(k), at{3 * point, 3 * point + 1, 3 * point + 2} {}
  std::string_view name() const override { return "follower"; }
  int stencils() const override { return 1; }
  std::span<const int> coordinates(int) const override { return at; }
  void element(const Vector& x, int, Order order, ElementSlot& slot) const override {
    slot.energy = -force * x[at[0]];
    if (order >= Order::gradient) slot.gradient[0] = -force;
  }
  void freeze(const Vector& x) override {
    force = k * x.segment<3>(at[0]).norm();
    direction = x.segment<3>(at[0]).normalized();
  }
  void add_change(const Vector& dx, Vector& gradient) const override {
    gradient[at[0]] -= k * direction.dot(dx.segment<3>(at[0]));
  }
  Vector3 direction = Vector3::UnitZ();
};

/// A point between two springs of length 1, 5 apart along z, with a force on it besides.
template <class Force>
struct BetweenSprings {
  EffectList effects;
  Force& force;
  Unknowns unknowns{{0, 3, 6}, 9, {true, true, true, false, false, false, true, true, true}};
  Assembler assembler{unknowns, effects};
  SparseCholesky cholesky;
  System system{assembler, cholesky, Ordering::natural,
                [this](Vector& x, const Vector& dx) { unknowns.advance(x, dx); }};

  explicit BetweenSprings(std::unique_ptr<Force> owned) : force(*owned) {
    effects.push_back(std::make_unique<test::Springs>(
        std::vector<test::Springs::Spring>{{0, 3, 1, 1}, {3, 6, 1, 1}}));
    effects.push_back(std::move(owned));
  }
  NewtonResult solve(double z, const NewtonOptions& options, CoupledSteps steps) {
    Vector x = Vector::Zero(9);
    x[5] = z, x[8] = 5;
    return coupled_newton(system, force, x, options, steps);
  }
};

}  // namespace

TEST_CASE("a force that follows the state is found with the whole tangent, quadratically") {
  // The point is pulled across by k times its distance from the first end.
  BetweenSprings problem(std::make_unique<Follower>(3, 1));
  NewtonOptions options;
  options.energy_tolerance = 1e-20, options.force_tolerance = 1e-10, options.largest_move = 1;
  const NewtonResult result = problem.solve(2.4, options, {.damped = GENERATE(false, true)});
  REQUIRE(result.ok());
  CHECK(result.iterations <= 7);  // dozens when the change of the force is left out
  // The force that the springs carry is k times the length, to round-off.
  const Vector3 p = result.x.segment<3>(3), q(0, 0, 5);
  const auto pull = [](const Vector3& r) { return Vector3((r.squaredNorm() - 1) * r); };
  const Vector3 carried = pull(p) + pull(p - q);
  CHECK(carried.x() == Approx(3 * p.norm()).epsilon(1e-9));
  CHECK(std::abs(carried.z()) < 1e-9);
}

TEST_CASE("an attempt of short steps alone ends before the first one that is not") {
  NewtonOptions options;
  options.energy_tolerance = 1e-20, options.force_tolerance = 1e-10, options.largest_move = 1;
  const auto solve = [&](double short_step) {
    return BetweenSprings(std::make_unique<Follower>(3, 1))
        .solve(2.4, options, {.damped = true, .most_growth = 0, .short_step = short_step});
  };
  double first = 0;
  NewtonObserver observer = [&](const NewtonMonitor& m) {
    if (m.iteration == 0) first = m.decrement;
  };
  BetweenSprings watched(std::make_unique<Follower>(3, 1));
  Vector x = Vector::Zero(9);
  x[5] = 2.4, x[8] = 5;
  REQUIRE(
      coupled_newton(watched.system, watched.force, x, options, {.damped = true}, observer).ok());
  const NewtonResult none = solve(0.99 * first);
  CHECK(none.status == NewtonStatus::stalled);
  CHECK(none.iterations == 0);
  CHECK(none.x == x);
  CHECK(solve(1.01 * first).ok());
}

TEST_CASE("damped steps find a force whose full steps do not settle") {
  // The point is pushed along by a force that saturates: full steps overshoot.
  struct Saturating final : Effect, FollowingForces {
    double force = 0, slope = 0;
    std::vector<int> at{3, 4, 5};
    std::string_view name() const override { return "saturating"; }
    int stencils() const override { return 1; }
    std::span<const int> coordinates(int) const override { return at; }
    void element(const Vector& x, int, Order order, ElementSlot& slot) const override {
      slot.energy = force * x[5];
      if (order >= Order::gradient) slot.gradient[2] = force;
    }
    void freeze(const Vector& x) override {
      const double z = 40 * (x[5] - 2.5);
      force = 30 * std::atan(z), slope = 30 * 40 / (1 + z * z);
    }
    void add_change(const Vector& dx, Vector& gradient) const override {
      gradient[5] += slope * dx[5];
    }
  };
  BetweenSprings problem(std::make_unique<Saturating>());
  NewtonOptions options;
  options.energy_tolerance = 1e-16, options.force_tolerance = 1e-8, options.largest_move = 1;
  options.bound.first_rise = 1e3;
  CHECK_FALSE(problem.solve(3, options, {}).ok());
  const NewtonResult damped = problem.solve(3, options, {.damped = true});
  REQUIRE(damped.ok());
  CHECK(damped.x[5] == Approx(2.5));
}
