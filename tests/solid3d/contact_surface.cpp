#include "solid3d/contact_surface.h"

#include <catch2/catch.hpp>

#include "solid3d/surface_pairs.h"
#include "tests/solid3d/shapes.h"

using namespace bight;
using namespace bight::solid3d;

TEST_CASE("the skin of a straight rod is a cylinder of diameter D") {
  for (const auto& [cells, ripple] : std::vector<std::pair<int, double>>{{12, 2e-3}, {32, 2e-4}}) {
    const Mesh mesh = test::straight_mesh(cells, 3.0, 1.0);
    const ContactSurface surface(mesh);
    const Vector x = test::reference_state(mesh, 0);
    for (double u = 0; u < surface.sides(); u += 0.13) {
      const SurfacePoint p = surface.evaluate(x, surface.weights(u, 4.3));
      CHECK(p.y.head<2>().norm() + surface.skin() == Approx(0.5).margin(ripple));
      CHECK(p.normal.dot(Vector3(p.y.x(), p.y.y(), 0).normalized()) > 0.999);
    }
    double area = 0;
    for (int patch = 0; patch < surface.patches(); ++patch)
      if (surface.has_patch(surface.along(patch))) area += surface.area(patch);
    CHECK(area == Approx(M_PI * (3.0 - (mesh.s[1] - mesh.s[0]))).epsilon(1e-9));
  }
}

TEST_CASE("a projection is nearest and leaves the surface at its ends") {
  const Mesh mesh = test::straight_mesh(12, 3.0, 1.0);
  const ContactSurface surface(mesh);
  const Vector x = test::shaken(test::reference_state(mesh, 0), 3 * mesh.nodes(), 5e-3);
  const Vector3 point(0.6, 0.2, 1.4);
  const auto uv = surface.project(x, point, {0, 4});
  REQUIRE(uv);
  const double nearest = (surface.evaluate(x, surface.weights(uv->x(), uv->y())).y - point).norm();
  for (double du : {-0.3, 0.3})
    for (double dv : {-0.3, 0.3})
      CHECK((surface.evaluate(x, surface.weights(uv->x() + du, uv->y() + dv)).y - point).norm() >
            nearest);
  CHECK_FALSE(surface.project(x, Vector3(0.6, 0.2, -2), {0, 2}));
}

TEST_CASE("near patches are other stretches of the rod, found both ways") {
  const Mesh mesh = test::straight_mesh(12, 2.12 * M_PI * 2, 1.0);
  const ContactSurface surface(mesh);
  const auto near = near_patches(surface, test::helix_state(mesh, 2, 1.0, 0), 0.1, 1.5);
  int pairs = 0;
  for (int p = 0; p < surface.patches(); ++p)
    for (int q : near[p]) {
      ++pairs;
      CHECK(std::abs(surface.arc_length(surface.along(p)) - surface.arc_length(surface.along(q))) >=
            1.5);
      CHECK(std::binary_search(near[q].begin(), near[q].end(), p));
    }
  CHECK(pairs > 20);
  const auto straight = near_patches(surface, test::reference_state(mesh, 0), 0.1, 1.5);
  for (const auto& list : straight) CHECK(list.empty());
}
