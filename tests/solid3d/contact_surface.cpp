#include "solid3d/contact_surface.h"

#include <catch2/catch.hpp>
#include <set>

#include "solid3d/surface_pairs.h"
#include "tests/solid3d/shapes.h"

using namespace bight;
using namespace bight::solid3d;

TEST_CASE("the skin of a straight rod is a cylinder of diameter D") {
  for (const int cells : {12, 32}) {
    const Mesh mesh = test::straight_mesh(cells, 3.0, 1.0);
    const ContactSurface surface(mesh);
    const Vector x = test::reference_state(mesh, 0);
    for (double u = 0; u < surface.sides(); u += 0.13) {
      const SurfacePoint p = surface.evaluate(x, surface.weights(u, 4.3));
      CHECK(p.y.head<2>().norm() + surface.skin() == Approx(0.5).epsilon(1e-12));
      CHECK(p.normal.dot(Vector3(p.y.x(), p.y.y(), 0).normalized()) == Approx(1).epsilon(1e-12));
    }
    double area = 0;
    for (int patch = 0; patch < surface.patches(); ++patch)
      if (surface.has_patch(surface.along(patch))) area += surface.area(patch);
    CHECK(area == Approx(M_PI * (3.0 - (mesh.s[1] - mesh.s[0]))).epsilon(1e-9));
  }
}

TEST_CASE("faces of quadratic cells are round, and load their nodes as Simpson weighs them") {
  for (const auto& [cells, ripple] : std::vector<std::pair<int, double>>{{5, 3e-3}, {12, 2e-4}}) {
    const Mesh mesh = test::straight_mesh(cells, 3.0, 1.0, 2);
    const ContactSurface surface(mesh);
    const Vector x = test::reference_state(mesh, 0);
    std::vector<double> load(static_cast<size_t>(surface.patches()), 0.0);
    constexpr int per_patch = 20;
    for (int k = 3; k < 11; ++k)
      for (int i = 0; i < per_patch * surface.sides(); ++i) {
        const double u = (i + 0.5) / per_patch;
        for (int j = 0; j < per_patch; ++j) {
          const PatchWeights w = surface.face_weights(u, k - 0.5 + (j + 0.5) / per_patch);
          const SurfacePoint p = surface.evaluate(x, w);
          CHECK(p.y.head<2>().norm() + surface.face_skin() == Approx(0.5).margin(ripple));
          for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
              load[static_cast<size_t>(surface.patch(w.around + a - 1, w.along + b - 1))] +=
                  w.u[a] * w.v[b] / (per_patch * per_patch);
        }
      }
    for (const int around : {0, 1, 2, 3})
      for (const int along : {6, 7}) {
        const double share = (around % 2 ? 4.0 / 3 : 2.0 / 3) * (along % 2 ? 4.0 / 3 : 2.0 / 3);
        CHECK(load[static_cast<size_t>(surface.patch(around, along))] ==
              Approx(share).epsilon(2e-3));
      }
  }
}

TEST_CASE("the patches of unequal layers share the area of the cylinder") {
  const Mesh mesh = make_mesh(make_section(12), {0, 0.1, 0.4, 0.5, 0.9});
  const ContactSurface surface(mesh);
  for (int k = 1; k < 4; ++k) {
    const double from = 0.5 * (mesh.s[k - 1] + mesh.s[k]), to = 0.5 * (mesh.s[k] + mesh.s[k + 1]);
    CHECK(surface.sides() * surface.area(surface.patch(0, k)) == Approx(M_PI * (to - from)));
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
  // The surface ends half a layer inside the rod.
  const double layer = mesh.s[1];
  const Vector straight = test::reference_state(mesh, 0);
  for (const double inside : {0.3, 0.7}) {
    const Vector3 first(0.6, 0.2, inside * layer), last(0.6, 0.2, mesh.s.back() - inside * layer);
    CHECK(surface.project(straight, first, {0, 2}).has_value() == (inside > 0.5));
    CHECK(surface.project(straight, last, {0, mesh.layers() - 3}).has_value() == (inside > 0.5));
  }
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

TEST_CASE("a patch is near all whose nine nodes come within the reach") {
  const Mesh mesh = test::straight_mesh(12, 6.0, 1.0);
  const ContactSurface surface(mesh);
  const int half = mesh.layers() / 2;
  const double width = 2 * mesh.section.points[mesh.section.rim[0]].norm();
  const double apart = GENERATE(0.095, 0.105), reach = 0.1;
  // The rod broken in two halves, side by side.
  Vector x = test::reference_state(mesh, 0);
  for (int n = mesh.node(half, 0); n < mesh.nodes(); ++n)
    x.segment<3>(3 * n) += Vector3(width + apart, 0, -mesh.s[half]);
  std::set<int> one, other;
  const auto near = near_patches(surface, x, reach, 1.5);
  for (int p = 0; p < surface.patches(); ++p)
    for (int q : near[p])
      if (surface.along(p) < half - 1 && surface.along(q) > half) {
        one.insert(surface.around(p));
        other.insert(surface.around(q));
      }
  // The node that faces the other half, and its two neighbours.
  CHECK(one.size() == (apart < reach ? 3 : 0));
  CHECK(other.size() == one.size());
}
