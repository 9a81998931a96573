#include "solid3d/elements.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "tests/derivatives.h"
#include "tests/solid3d/verification.h"

using namespace bight;
using namespace bight::solid3d;

// What every element of the list must do; bending and torsion are in straight_rod.cpp, large
// strains in verification.cpp.

namespace {

/// With a U that is not quadratic.
const Material material = CompressibleNeoHookean{1.0 / 3, 20.0 / 3};
const Matrix3 linear = (Matrix3() << 1.1, 0.2, 0.0, 0.1, 0.95, 0.1, 0.05, -0.1, 0.98).finished();

struct Patch {
  test::HexProblem problem;
  EffectList effects;
  explicit Patch(const HexElement& element)
      : problem(test::distorted_patch(element.degree), material, element),
        effects(problem.solid_effects()) {}

  /// Energy and gradient of all effects together.
  test::Evaluation all(const Vector& x) const {
    test::Evaluation sum{0, Vector::Zero(x.size()), Vector::Zero(x.size())};
    for (const auto& effect : effects) {
      const auto one = test::evaluate(*effect, x, Vector::Zero(x.size()));
      sum.energy += one.energy;
      sum.gradient += one.gradient;
    }
    return sum;
  }
  Vector moved(const Matrix3& F, const Vector& from) const {
    Vector x = from;
    for (int c = 0; c < problem.positions(); c += 3)
      x.segment<3>(c) = F * from.segment<3>(c) + Vector3(3, -2, 5);
    return x;
  }
  Vector shaken(double size) const {
    Vector x = problem.x;
    std::mt19937 generator(5);
    std::normal_distribution<double> normal(0, size);
    for (int c = 0; c < problem.positions(); ++c) x[c] += normal(generator);
    return x;
  }
};

}  // namespace

TEST_CASE("derivatives of every element converge with the square of the step") {
  for (const HexElement& element : hex_elements()) {
    CAPTURE(element.name);
    Patch patch(element);
    const int positions = patch.problem.positions();
    for (const double size : {0.0, 1e-8, 0.02})
      for (const auto& effect : patch.effects)
        test::check_derivatives(*effect, patch.moved(linear, patch.shaken(size)), positions,
                                {1e-3, 6, 3.0});
  }
}

TEST_CASE("every element is at rest at rest, and feels no rigid motion") {
  const Matrix3 R = Eigen::AngleAxisd(2.5, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  for (const HexElement& element : hex_elements()) {
    CAPTURE(element.name);
    const Patch patch(element);
    const auto rest = patch.all(patch.moved(R, patch.problem.x));
    CHECK(std::abs(rest.energy) < 1e-15);
    CHECK(rest.gradient.norm() < 1e-13);
    const Vector strained = patch.shaken(0.02);
    const auto here = patch.all(strained), there = patch.all(patch.moved(R, strained));
    CHECK(here.energy > 1e-5);
    CHECK(there.energy == Approx(here.energy).epsilon(1e-11));
    Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
    for (int c = 0; c < patch.problem.positions(); c += 3) {
      const Vector3 f = here.gradient.segment<3>(c), r = strained.segment<3>(c);
      force += f, torque += r.cross(f);
    }
    CHECK(force.norm() < 1e-13);
    CHECK(torque.norm() < 1e-13);
  }
}

TEST_CASE("every element strains a distorted patch of cells alike") {
  for (const HexElement& element : hex_elements()) {
    CAPTURE(element.name);
    Patch patch(element);
    test::HexProblem& problem = patch.problem;
    const Vector exact = patch.moved(linear, problem.x);
    problem.x.head(problem.positions()) =
        patch.moved(linear, patch.shaken(0.01)).head(problem.positions());
    problem.each([](const Vector3& X) { return X.minCoeff() == 0 || X.maxCoeff() == 1; },
                 [&](int n) {
                   problem.hold(n);
                   problem.x.segment<3>(3 * n) = exact.segment<3>(3 * n);
                 });
    problem.solve();
    CHECK((problem.x - exact).head(problem.positions()).norm() < 1e-9);
    const Strain strain = problem.strain();
    const Matrix3 first = strain.stress(problem.x, 0).cauchy;
    REQUIRE(first.norm() > 0.1);
    for (int cell = 1; cell < strain.cells(); ++cell)
      CHECK((strain.stress(problem.x, cell).cauchy - first).norm() < 1e-8 * first.norm());
  }
}

TEST_CASE("a cell of every element resists all but rigid motion") {
  for (const HexElement& element : hex_elements()) {
    CAPTURE(element.name);
    const HexMesh cell = test::brick(element.degree, {1, 1, 1}, [](const Vector3& u) {
      return Vector3(u.x() + 0.2 * u.y() * u.z(), 0.7 * u.y() + 0.1 * u.x(), 1.5 * u.z());
    });
    const test::HexProblem problem(cell, material, element);
    const int positions = problem.positions();
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(positions, positions);
    for (const auto& effect : problem.solid_effects()) {
      Vector gradient = Vector::Zero(positions);
      Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(positions, positions);
      ElementSlot slot{0, gradient.data(), hessian.data()};
      effect->element(problem.x, 0, Order::hessian, slot);
      H += hessian;
    }
    const Vector stiffness = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(H).eigenvalues();
    CHECK(stiffness.head<6>().cwiseAbs().maxCoeff() < 1e-14);
    CHECK(stiffness[6] > 0.01 / 3);
  }
}

TEST_CASE("an inverted corner is seen whatever the points of an element") {
  for (const HexElement& element : hex_elements()) {
    CAPTURE(element.name);
    test::HexProblem problem(
        test::brick(element.degree, {1, 1, 1}, [](const Vector3& u) { return u; }), material,
        element);
    CHECK(problem.strain().stress(problem.x, 0).least_jacobian == Approx(1));
    problem.x.segment<3>(0) = Vector3(0.9, 0.9, 0.9);
    CHECK(problem.strain().stress(problem.x, 0).least_jacobian < 0);
  }
}
