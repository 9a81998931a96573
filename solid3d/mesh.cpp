#include "solid3d/mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

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
    assert(all.cells.empty() || mesh.degree() == all.degree);
    all.degree = mesh.degree();
    for (int n = 0; n < mesh.nodes(); ++n) all.nodes.push_back(mesh.reference(mesh.first_node + n));
    all.cells.insert(all.cells.end(), mesh.cells.begin(), mesh.cells.end());
  }
  return all;
}

Mesh make_mesh(const Section& section, const std::vector<double>& layers, int first_node) {
  const int degree = section.degree, row = degree + 1;
  Mesh mesh{section, {layers.front()}, {}, first_node};
  for (size_t k = 0; k + 1 < layers.size(); ++k) {
    if (degree == 2) mesh.s.push_back(0.5 * (layers[k] + layers[k + 1]));
    mesh.s.push_back(layers[k + 1]);
  }
  for (int k = 0; k + degree < mesh.layers(); k += degree)
    for (int c = 0; c < section.cells(); ++c) {
      const std::vector<int> points = section.cell(c);
      HexCell cell;
      for (int a = 0; a < row * row * row; ++a) {
        const auto [i, j, layer] = grid_place(degree, a);
        cell.push_back(mesh.node(k + layer, points[static_cast<size_t>(j * row + i)]));
      }
      mesh.cells.push_back(std::move(cell));
    }
  return mesh;
}

std::vector<double> graded_layers(double length, double fine, double coarse, double knot_begin,
                                  double knot_end, TailEnds ends) {
  constexpr double growth = 1.12;  // of neighbouring layers in a tail
  knot_begin = std::clamp(knot_begin, 0.0, length);
  knot_end = std::clamp(knot_end, knot_begin, length);

  // Spacings of a tail, growing from the knot and from the grip, stretched evenly to fill it. A
  // grip holds its section round: with long cells there a rod stretched by a quarter is too stiff.
  const auto tail = [&](double extent) {
    std::vector<double> spacings;
    for (int count = 1; extent > 1e-9; ++count) {
      spacings.clear();
      for (int i = 0; i < count; ++i)
        spacings.push_back(std::min(
            coarse,
            fine * std::pow(growth, ends == TailEnds::fine ? std::min(i, count - 1 - i) : i)));
      const double filled = std::accumulate(spacings.begin(), spacings.end(), 0.0);
      if (filled < extent - 1e-9) continue;
      for (double& h : spacings) h *= extent / filled;
      break;
    }
    return spacings;
  };

  std::vector<double> spacings = tail(knot_begin);
  std::reverse(spacings.begin(), spacings.end());
  // An even number, so that a layer lies in the middle.
  const int middle =
      2 * std::max(1, static_cast<int>(std::ceil((knot_end - knot_begin) / (2 * fine) - 1e-9)));
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
