#include "solid3d/surface_pairs.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace bight::solid3d {

std::vector<std::vector<int>> near_patches(const ContactSurface& surface, const Vector& x,
                                           double reach, double exclusion) {
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;
  std::vector<Box> boxes;
  for (int patch = 0; patch < surface.patches(); ++patch) {
    const int a = surface.around(patch), k = surface.along(patch);
    if (!surface.has_patch(k)) continue;
    // A B-spline lies in the convex hull of its control points.
    Vector3 low = x.segment<3>(surface.coordinate(a, k)), high = low;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) {
        const Vector3 c = x.segment<3>(surface.coordinate(a + i, k + j));
        low = low.cwiseMin(c);
        high = high.cwiseMax(c);
      }
    low.array() -= 0.5 * reach;
    high.array() += 0.5 * reach;
    boxes.emplace_back(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()),
                       patch);
  }
  std::vector<std::vector<int>> near(static_cast<size_t>(surface.patches()));
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    const int p = a.info(), q = b.info();
    if (surface.apart(surface.along(p), surface.along(q)) < exclusion) return;
    near[p].push_back(q);
    near[q].push_back(p);
  });
  // The package reports pairs in an order of its own; ours must not depend on it.
  for (auto& list : near) std::sort(list.begin(), list.end());
  return near;
}

}  // namespace bight::solid3d
