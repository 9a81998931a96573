#include "solid3d/effects/gravity.h"

#include <catch2/catch.hpp>

#include "solid3d/solid_problem.h"

using namespace bight;
using namespace bight::solid3d;

TEST_CASE("a bar that hangs is pulled by its weight, and longer by rho g L^2/(2 E)") {
  constexpr double length = 4, g = 1e-4;
  SolidParameters parameters;
  parameters.contact = false;
  parameters.gravity = {0, 0, g};
  SolidProblem problem({{make_section(12), graded_layers(length, 0.25, 0.25, 0, length),
                         [](const Vector3& X) { return X; }}},
                       parameters);
  const Mesh& mesh = problem.strands()[0];
  const std::vector<int> top = problem.section(0, 0);
  problem.hold(top, 2);
  const auto middle = [](const Vector3& X) { return X.head<2>().norm() < 1e-9; };
  const auto beside = [](const Vector3& X) { return std::abs(X.y()) < 1e-9; };
  problem.hold(problem.nodes(0, middle), 0);
  problem.hold(problem.nodes(0, beside), 1);
  REQUIRE(problem.go(0, 1).status == PathStatus::finished);
  const double weight = g * length * mesh.section.area();
  CHECK(problem.reaction(top).z() == Approx(-weight).epsilon(1e-6));
  double longer = 0;
  for (const int n : problem.section(0, mesh.layers() - 1))
    longer += (problem.position(n).z() - length) / mesh.points_per_layer();
  CHECK(longer == Approx(g * length * length / 2).epsilon(0.01));
}
