#pragma once

#include <vector>

#include "solid3d/mesh.h"

namespace bight::solid3d {

/// Where the nodes of a mesh lie in the deformation that another mesh of the same rod found: the
/// start of a relaxation that is close to its end. Bilinear in the cells of a section, whose outer
/// ones go on beyond their rim; along the rod a cubic through the four layers around.
///
/// `from`, `nodes`: a mesh and the positions of its nodes [D]. Both meshes have the same length and
/// diameter. How it rubs there is carried over by SolidParameters::rubs.
std::vector<Vector3> transferred(const Mesh& from, const std::vector<Vector3>& nodes,
                                 const Mesh& to);

}  // namespace bight::solid3d
