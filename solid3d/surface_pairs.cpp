#include "solid3d/surface_pairs.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace bight::solid3d {

namespace {

struct Box {
  Vector3 low, high;
  bool meets(const Box& other) const {
    return (low.array() <= other.high.array() && other.low.array() <= high.array()).all();
  }
};

/// Of a patch, grown by `margin`: a B-spline lies in the convex hull of its control points.
Box patch_box(const ContactSurface& surface, const Vector& x, int patch, double margin) {
  const int a = surface.around(patch), k = surface.along(patch);
  const Vector3 middle = x.segment<3>(surface.coordinate(a, k));
  Box box{middle, middle};
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i) {
      const Vector3 c = x.segment<3>(surface.coordinate(a + i, k + j));
      box.low = box.low.cwiseMin(c);
      box.high = box.high.cwiseMax(c);
    }
  box.low.array() -= margin;
  box.high.array() += margin;
  return box;
}

/// For every layer, those apart whose boxes meet its own, ascending.
std::vector<std::vector<int>> near_layers(const ContactSurface& surface,
                                          const std::vector<Box>& layers, double exclusion) {
  using LayerBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;
  std::vector<LayerBox> boxes;
  for (int k = 0; k < surface.layers(); ++k) {
    if (!surface.has_patch(k)) continue;
    const auto& [low, high] = layers[k];
    boxes.emplace_back(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()), k);
  }
  std::vector<std::vector<int>> near(layers.size());
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(),
                                [&](const LayerBox& a, const LayerBox& b) {
                                  if (surface.apart(a.info(), b.info()) < exclusion) return;
                                  near[a.info()].push_back(b.info());
                                  near[b.info()].push_back(a.info());
                                });
  // The package reports pairs in an order of its own; ours must not depend on it.
  for (auto& list : near) std::sort(list.begin(), list.end());
  return near;
}

}  // namespace

std::vector<std::vector<int>> near_patches(const ContactSurface& surface, const Vector& x,
                                           double reach, double exclusion) {
  std::vector<Box> patches(static_cast<size_t>(surface.patches()));
  std::vector<Box> layers(static_cast<size_t>(surface.layers()));
#pragma omp parallel for schedule(static)
  for (int k = 0; k < surface.layers(); ++k) {
    if (!surface.has_patch(k)) continue;
    for (int a = 0; a < surface.sides(k); ++a) {
      const int patch = surface.patch(a, k);
      patches[patch] = patch_box(surface, x, patch, 0.5 * reach);
      Box& layer = layers[k];
      if (a == 0) layer = patches[patch];
      layer.low = layer.low.cwiseMin(patches[patch].low);
      layer.high = layer.high.cwiseMax(patches[patch].high);
    }
  }
  const std::vector<std::vector<int>> beside = near_layers(surface, layers, exclusion);
  std::vector<std::vector<int>> near(patches.size());
#pragma omp parallel for schedule(dynamic, 4)
  for (int k = 0; k < surface.layers(); ++k) {
    if (!surface.has_patch(k)) continue;
    for (int a = 0; a < surface.sides(k); ++a) {
      const int patch = surface.patch(a, k);
      for (const int other_layer : beside[k]) {
        if (!patches[patch].meets(layers[other_layer])) continue;
        for (int b = 0; b < surface.sides(other_layer); ++b)
          if (const int other = surface.patch(b, other_layer); patches[patch].meets(patches[other]))
            near[patch].push_back(other);
      }
    }
  }
  return near;
}

}  // namespace bight::solid3d
