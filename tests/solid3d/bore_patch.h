#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "solid3d/effects/contact.h"
#include "solid3d/mesh.h"

/// The patch test of two round surfaces, as a function of both meshes.
namespace bight::test {

/// Patch test of round surfaces: a rod in a bore, concentric and overlapping by 0.02 D, with sides
/// and layers that do not match. (The bore is the skin of a strand turned inside out by a mirror;
/// only its surface has a meaning.) The pressure should be the same everywhere, and so should be
/// the forces on all nodes around: the largest differences over the mean, in the middle.
struct PatchErrors {
  double pressure, rod_forces, bore_forces;
};
inline PatchErrors patch(int rod_cells, int bore_cells) {
  constexpr double overlap = 0.02, length = 2;
  const solid3d::Section section = solid3d::make_section(rod_cells);
  const auto layers = [](double spacing) {
    return solid3d::graded_layers(length, spacing, spacing, 0, length);
  };
  // Inside out, the skin of the bore lies on the other side of its spline.
  solid3d::Section around = solid3d::make_section(bore_cells);
  const double skin = solid3d::ContactSurface(solid3d::make_mesh(around, layers(0.2))).skin();
  around = solid3d::scaled(around, (1 - 2 * overlap) / (1 - 4 * skin));
  std::vector<solid3d::Mesh> strands{solid3d::make_mesh(section, layers(0.1))};
  strands.push_back(solid3d::make_mesh(around, layers(0.13), strands[0].nodes()));
  solid3d::Contact::Options options;
  options.sample_spacing = 0.02;
  solid3d::Contact contact(strands, {1, 1e-4}, options);

  const int nodes = strands[0].nodes() + strands[1].nodes();
  Vector x(3 * nodes), forces = Vector::Zero(3 * nodes);
  for (const solid3d::Mesh& mesh : strands)
    for (int n = mesh.first_node; n < mesh.first_node + mesh.nodes(); ++n) {
      x.segment<3>(3 * n) = mesh.reference(n);
      if (mesh.first_node > 0) x[3 * n] *= -1;
    }
  contact.refresh(x);
  for (int i = 0; i < contact.stencils(); ++i) {
    Eigen::Matrix<double, 54, 1> gradient = Eigen::Matrix<double, 54, 1>::Zero();
    ElementSlot slot{0, gradient.data(), nullptr};
    contact.element(x, i, Order::gradient, slot);
    const auto at = contact.coordinates(i);
    for (int c = 0; c < 54; ++c) forces[at[c]] += gradient[c];
  }

  struct Spread {
    double least = 1e300, most = 0;
    void add(double value) { least = std::min(least, value), most = std::max(most, value); }
    double relative() const { return 2 * (most - least) / (most + least); }
  } pressure, on[2];
  for (const auto& sample : contact.samples()) {
    const double z = contact.surface().arc_length(contact.surface().along(sample.patch));
    if (sample.faces && std::abs(z - 0.5 * length) < 0.25 * length) pressure.add(-sample.gap);
  }
  for (const int strand : {0, 1}) {
    const solid3d::Mesh& mesh = strands[strand];
    for (int k = 0; k < mesh.layers(); ++k)
      for (const int p : mesh.section.rim)
        if (std::abs(mesh.s[k] - 0.5 * length) < 0.25 * length)
          on[strand].add(forces.segment<3>(3 * mesh.node(k, p)).norm());
  }
  return {pressure.relative(), on[0].relative(), on[1].relative()};
}

}  // namespace bight::test
