#include "mechanics/newton.h"

#include <catch2/catch.hpp>

#include "tests/mechanics/toy_effects.h"

using namespace bight;

namespace {

/// A chain of springs with its first and last point held.
struct Chain {
  EffectList effects;
  Unknowns unknowns;
  Assembler assembler;
  SparseCholesky cholesky;
  System system;
  Vector x;

  explicit Chain(double end_to_end, int points = 20)
      : effects(springs(points)),
        unknowns(blocks(points), 3 * points, held(points)),
        assembler(unknowns, effects),
        system{assembler, cholesky, Ordering::natural,
               [this](Vector& at, const Vector& dx) { unknowns.advance(at, dx); }} {
    x = Vector::Zero(3 * points);
    for (int i = 0; i < points; ++i) x[3 * i + 2] = end_to_end * i / (points - 1);
  }
  static EffectList springs(int points) {
    std::vector<test::Springs::Spring> list;
    for (int i = 0; i + 1 < points; ++i) list.push_back({3 * i, 3 * i + 3, 1, 1});
    EffectList effects;
    effects.push_back(std::make_unique<test::Springs>(list));
    return effects;
  }
  static std::vector<int> blocks(int points) {
    std::vector<int> first;
    for (int i = 0; i < points; ++i) first.push_back(3 * i);
    return first;
  }
  static std::vector<bool> held(int points) {
    std::vector<bool> is(3 * points, false);
    for (int c = 0; c < 3; ++c) is[c] = is[3 * points - 1 - c] = true;
    return is;
  }
  NewtonOptions options() const {
    NewtonOptions options;
    options.energy_tolerance = 1e-14;
    options.force_tolerance = 1e-9;
    return options;
  }
};

}  // namespace

TEST_CASE("a stretched chain: quadratic convergence to equal springs, reactions on what is held") {
  Chain chain(19 * 1.5);
  for (int i = 3; i < 57; ++i) chain.x[i] += 0.05 * std::sin(2.0 * i);
  std::vector<double> residual;
  const NewtonResult result =
      newton(chain.system, chain.x, chain.options(),
             [&](const NewtonMonitor& m) { residual.push_back(m.residual); });
  REQUIRE(result.ok());
  CHECK(result.residual < 1e-9);
  CHECK(result.iterations <= 8);
  CHECK(chain.system.shift == 0);
  for (int i = 0; i < 20; ++i) CHECK(result.x[3 * i + 2] == Approx(1.5 * i).margin(1e-9));
  // k (l^2 - 1) l with l = 1.5
  CHECK(result.gradient[59] == Approx(1.25 * 1.5));
  CHECK(result.gradient[2] == Approx(-1.25 * 1.5));
  REQUIRE(residual.size() >= 3);
  CHECK(residual.back() < 1e-2 * residual[residual.size() - 2]);
}

TEST_CASE("a pressed chain: the tangent is indefinite, a shift leads it to a stable shape") {
  Chain chain(19 * 0.6);
  for (int i = 3; i < 57; ++i) chain.x[i] += 0.01 * std::sin(2.0 * i);
  NewtonOptions options = chain.options();
  options.max_iterations = 300;
  bool shifted = false;
  double last = inadmissible;
  const NewtonResult result = newton(chain.system, chain.x, options, [&](const NewtonMonitor& m) {
    shifted = shifted || m.shift > 0;
    CHECK(m.energy <= last);
    last = m.energy;
  });
  INFO(result.reason);
  CHECK(shifted);
  CHECK(result.energy < 1e-8);  // springs of their own length fit in many ways
}

namespace {

/// Much energy that no force comes from, with the round-off of a sum of many terms.
class Store final : public Effect {
 public:
  std::string_view name() const override { return "store"; }
  int stencils() const override { return 1; }
  std::span<const int> coordinates(int) const override { return coordinates_; }
  void element(const Vector& x, int, Order, ElementSlot& slot) const override {
    slot.energy = 1e4 * (1 + std::numeric_limits<double>::epsilon() * std::sin(1e12 * x[3]));
  }

 private:
  std::vector<int> coordinates_{3};
};

}  // namespace

TEST_CASE("forces are balanced beyond what two energies can tell apart") {
  Chain chain(19 * 1.5);
  chain.effects.push_back(std::make_unique<Store>());
  for (int i = 3; i < 57; ++i) chain.x[i] += 0.05 * std::sin(2.0 * i);
  NewtonOptions options = chain.options();
  options.force_tolerance = 1e-12;
  const NewtonResult result = newton(chain.system, chain.x, options);
  INFO(result.reason);
  CHECK(result.ok());
  CHECK(result.residual < 1e-12);
}

TEST_CASE("what fails says so") {
  Chain chain(19 * 1.5);
  for (int i = 3; i < 57; ++i) chain.x[i] += 0.05 * std::sin(2.0 * i);
  NewtonOptions options = chain.options();
  options.max_iterations = 1;
  CHECK(newton(chain.system, chain.x, options).status == NewtonStatus::too_many_iterations);
  Vector x = chain.x;
  x[10] = std::nan("");
  CHECK(newton(chain.system, x, options).status == NewtonStatus::not_finite);
}

TEST_CASE("no coordinate moves farther in an iteration than allowed") {
  Chain chain(19 * 1.5);
  chain.x[30] += 3;
  NewtonOptions options = chain.options();
  options.largest_move = 0.1;
  options.max_iterations = 200;
  Vector before = chain.x;
  chain.system.advance = [&](Vector& x, const Vector& dx) {
    CHECK(dx.cwiseAbs().maxCoeff() <= 0.1 + 1e-12);
    x += dx;
  };
  CHECK(newton(chain.system, chain.x, options).ok());
}
