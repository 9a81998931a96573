#include "solid3d/transfer.h"

#include <catch2/catch.hpp>

#include "tests/solid3d/shapes.h"

using namespace bight;
using namespace bight::solid3d;

namespace {

/// Of the nodes of `to`: the largest distance between the transferred and the true place.
double largest_error(const Mesh& from, const Mesh& to, Vector3 (*place)(const Vector3&)) {
  std::vector<Vector3> nodes;
  for (int n = 0; n < from.nodes(); ++n) nodes.push_back(place(from.reference(n)));
  const std::vector<Vector3> found = transferred(from, nodes, to);
  REQUIRE(found.size() == static_cast<size_t>(to.nodes()));
  double largest = 0;
  for (int n = 0; n < to.nodes(); ++n)
    largest = std::max(largest, (found[static_cast<size_t>(n)] - place(to.reference(n))).norm());
  return largest;
}

/// An affine map of the sections, which move along a cubic.
Vector3 affine_along(const Vector3& X) {
  const double s = X.z();
  return {1.1 * X.x() + 0.2 * X.y() + 0.01 * s * s * s, 0.9 * X.y() - 0.02 * s * s, s};
}

/// A circular arc, with sections that bend anticlastically.
Vector3 bent(const Vector3& X) {
  const double kappa = 0.5, angle = kappa * X.z(), r = 1 / kappa - X.x();
  return {1 / kappa - r * std::cos(angle), X.y() * (1 + 0.3 * X.x()), r * std::sin(angle)};
}

}  // namespace

TEST_CASE("the map between meshes is exact for affine sections along a cubic") {
  const auto [coarse, fine] = GENERATE(std::pair(12, 60), std::pair(32, 21), std::pair(12, 108));
  CHECK(largest_error(test::straight_mesh(coarse, 5, 1.3), test::straight_mesh(fine, 5, 0.8),
                      affine_along) < 1e-12);
}

TEST_CASE("a mesh is mapped on itself as it is") {
  const Mesh mesh = test::straight_mesh(12, 3, 1);
  CHECK(largest_error(mesh, mesh, bent) < 1e-13);
}

TEST_CASE("what the map loses of a bent rod falls with the square of the cells") {
  const Mesh fine = test::straight_mesh(108, 5, 0.8);
  const double by_12 = largest_error(test::straight_mesh(12, 5, 0.8), fine, bent);
  const double by_60 = largest_error(test::straight_mesh(60, 5, 0.8), fine, bent);
  CHECK(by_12 < 0.01);
  CHECK(by_60 < by_12 / 3);  // cells are sqrt(5) times as wide
}
