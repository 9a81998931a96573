#include "solid3d/mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace bight::solid3d {

Vector3 Mesh::reference(int node) const {
  const int own = node - first_node;
  const Vector2& p = section.points[own % points_per_layer()];
  return {p.x(), p.y(), s[own / points_per_layer()]};
}

HexMesh hexahedra(std::span<const Mesh> strands) {
  HexMesh all;
  for (const Mesh& mesh : strands) {
    assert(mesh.first_node == static_cast<int>(all.nodes.size()));
    for (int n = 0; n < mesh.nodes(); ++n) all.nodes.push_back(mesh.reference(mesh.first_node + n));
    all.cells.insert(all.cells.end(), mesh.cells.begin(), mesh.cells.end());
  }
  return all;
}

Mesh make_mesh(const Section& section, const std::vector<double>& layers, int first_node) {
  Mesh mesh{section, layers, {}, first_node};
  for (int k = 0; k + 1 < mesh.layers(); ++k)
    for (const auto& q : section.quads)
      mesh.cells.push_back({mesh.node(k, q[0]), mesh.node(k, q[1]), mesh.node(k, q[2]),
                            mesh.node(k, q[3]), mesh.node(k + 1, q[0]), mesh.node(k + 1, q[1]),
                            mesh.node(k + 1, q[2]), mesh.node(k + 1, q[3])});
  return mesh;
}

std::vector<double> graded_layers(double length, double fine, double coarse, double knot_begin,
                                  double knot_end) {
  constexpr double growth = 1.12;  // of neighbouring layers in a tail
  knot_begin = std::clamp(knot_begin, 0.0, length);
  knot_end = std::clamp(knot_end, knot_begin, length);

  // Spacings of a tail from the knot outwards, stretched evenly to fill it exactly.
  const auto tail = [&](double extent) {
    std::vector<double> spacings;
    double filled = 0;
    for (double h = fine; filled < extent - 1e-9; h = std::min(coarse, growth * h)) {
      spacings.push_back(h);
      filled += h;
    }
    for (double& h : spacings) h *= extent / filled;
    return spacings;
  };

  std::vector<double> spacings = tail(knot_begin);
  std::reverse(spacings.begin(), spacings.end());
  // An even number, so that a layer lies in the middle.
  const int middle =
      2 * std::max(1, static_cast<int>(std::ceil((knot_end - knot_begin) / (2 * fine))));
  if (knot_end > knot_begin)
    spacings.insert(spacings.end(), static_cast<size_t>(middle), (knot_end - knot_begin) / middle);
  const std::vector<double> last = tail(length - knot_end);
  spacings.insert(spacings.end(), last.begin(), last.end());

  std::vector<double> s{0.0};
  for (double h : spacings) s.push_back(s.back() + h);
  s.back() = length;
  return s;
}

}  // namespace bight::solid3d
