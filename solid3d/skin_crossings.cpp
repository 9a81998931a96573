#include "solid3d/skin_crossings.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <vector>

namespace bight::solid3d {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangle = std::array<int, 3>;

struct Skin {
  std::vector<Kernel::Point_3> points;
  std::vector<Triangle> triangles;
};

/// Points of a strand around it and between two layers along it, at least.
constexpr int least_around = 32, per_layer = 3;

/// A grid of points over the patches of every strand, each cell of it as two triangles.
Skin make_skin(const ContactSurface& surface, const Vector& x, double inward) {
  Skin skin;
  int row = 0, row_before = 0;  // first point of each
  for (int k = 0; k < surface.layers(); ++k) {
    if (!surface.has_patch(k)) continue;
    const int sides = surface.sides(k);
    const int around = sides * std::max(1, (least_around + sides - 1) / sides);
    const bool begins = !surface.has_patch(k - 1);
    for (int j = begins ? 0 : 1; j <= per_layer; ++j) {
      row_before = row;
      row = static_cast<int>(skin.points.size());
      for (int i = 0; i < around; ++i) {
        const double u = static_cast<double>(i) * sides / around;
        const double v = k - 0.5 + static_cast<double>(j) / per_layer;
        const SurfacePoint p = surface.evaluate(x, surface.weights(u, v));
        const Vector3 y = p.y + (surface.skin(k) - inward) * p.normal;
        skin.points.emplace_back(y.x(), y.y(), y.z());
      }
      if (begins && j == 0) continue;
      for (int i = 0; i < around; ++i) {
        const int next = (i + 1) % around;
        skin.triangles.push_back({row_before + i, row_before + next, row + next});
        skin.triangles.push_back({row_before + i, row + next, row + i});
      }
    }
  }
  return skin;
}

bool share_a_point(const Triangle& a, const Triangle& b) {
  return std::ranges::any_of(a, [&](int point) { return std::ranges::find(b, point) != b.end(); });
}

}  // namespace

int skin_crossings(const ContactSurface& surface, const Vector& x, double inward) {
  const Skin skin = make_skin(surface, x, inward);
  const auto triangle = [&](int t) {
    const Triangle& corner = skin.triangles[static_cast<size_t>(t)];
    return Kernel::Triangle_3(skin.points[static_cast<size_t>(corner[0])],
                              skin.points[static_cast<size_t>(corner[1])],
                              skin.points[static_cast<size_t>(corner[2])]);
  };
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;
  std::vector<Box> boxes;
  for (int t = 0; t < static_cast<int>(skin.triangles.size()); ++t)
    boxes.emplace_back(triangle(t).bbox(), t);
  int crossings = 0;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    if (share_a_point(skin.triangles[static_cast<size_t>(a.info())],
                      skin.triangles[static_cast<size_t>(b.info())]))
      return;
    if (CGAL::do_intersect(triangle(a.info()), triangle(b.info()))) ++crossings;
  });
  return crossings;
}

}  // namespace bight::solid3d
