#pragma once

#include <optional>
#include <vector>

#include "mechanics/unknowns.h"
#include "solid3d/mesh.h"

namespace bight::solid3d {

/// Two-fold symmetry of a knot and its mesh: half a turn about a line across the pulling axis
/// (z through the start), through the middle of the rod, maps section k on section n - 1 - k. In
/// the frame where that line is the x axis the coordinates of one half are +-1 times those of the
/// other half: (x, -y, -z).
///
/// A frictionless overhand knot between equal ends has it, and the equilibria of one half with its
/// image are equilibria of the whole (principle of symmetric criticality, Palais 1979). The half
/// has half the unknowns and none of the three motions that cost a frictionless knot nothing: the
/// slide along the rod, the turn about z and the roll of the rod are all antisymmetric.
class TwoFold {
 public:
  /// The symmetry of these node positions, if they have it to `tolerance` [D].
  static std::optional<TwoFold> find(const Mesh& mesh, const std::vector<Vector3>& start,
                                     double tolerance = 1e-5);

  /// Half-way point on the pulling axis, and the angle of the symmetry axis from x [rad].
  const Vector3& origin() const { return origin_; }
  double angle() const { return angle_; }

  /// The half that is simulated begins at this layer, the middle one.
  int first_layer() const { return first_layer_; }
  int image(int node) const { return image_[static_cast<size_t>(node)]; }

  /// Coordinates of nodes in the symmetry frame: held on the axis, images before the middle.
  /// `images` and `held` have an entry per coordinate; those of the end sections are left alone.
  void constrain(const Mesh& mesh, std::vector<Image>& images, std::vector<bool>& held) const;

  /// Makes the positions of the image half, in the symmetry frame, exactly those of the other.
  void impose(const Mesh& mesh, Vector& x) const;

 private:
  Vector3 origin_ = Vector3::Zero();
  double angle_ = 0;
  int first_layer_ = 0;
  std::vector<int> image_;  ///< of the nodes
};

}  // namespace bight::solid3d
