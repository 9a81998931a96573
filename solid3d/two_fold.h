#pragma once

#include <optional>
#include <vector>

#include "mechanics/unknowns.h"
#include "solid3d/mesh.h"

namespace bight::solid3d {

/// A symmetry of order two of a knot and its mesh, which maps section k on section n - 1 - k: half
/// a turn about a line across the pulling axis (z through the start), through the middle of the rod
/// (the overhand knot), or inversion in the middle of the rod (the figure-eight). In the frame
/// where that line is the x axis the coordinates of one half are +-1 times those of the other:
///
///   half turn (x, -y, -z),   inversion (-x, -y, -z)
///
/// A frictionless knot between equal ends has it, and the equilibria of one half with its image are
/// equilibria of the whole (principle of symmetric criticality, Palais 1979). The half has half
/// the unknowns and, turned by half a turn, none of the three motions that cost a frictionless knot
/// nothing: the slide along the rod, the turn about z and the roll of the rod are antisymmetric.
/// Inversion excludes the slide, and that one end turns against the other: both ends turn alike or,
/// which is the same but for a turn of everything, not at all. No torque is left then.
class TwoFold {
 public:
  enum class Kind { half_turn, inversion };

  /// The symmetry of these node positions, if they have it to `tolerance` [D].
  static std::optional<TwoFold> find(const Mesh& mesh, const std::vector<Vector3>& start,
                                     double tolerance = 1e-5);

  Kind kind() const { return kind_; }
  /// Half-way point on the pulling axis, and the angle of the axis of a half turn from x [rad].
  const Vector3& origin() const { return origin_; }
  double angle() const { return angle_; }

  /// The half that is simulated begins at this layer, the middle one.
  int first_layer() const { return first_layer_; }
  int image(int node) const { return image_[static_cast<size_t>(node)]; }

  /// Coordinates of nodes in the symmetry frame: held where they are their own opposites, images
  /// before the middle. `images` and `held` have an entry per coordinate; those of the end sections
  /// are left alone.
  void constrain(const Mesh& mesh, std::vector<Image>& images, std::vector<bool>& held) const;

  /// Makes the positions of the image half, in the symmetry frame, exactly those of the other.
  void impose(const Mesh& mesh, Vector& x) const;

 private:
  TwoFold(Kind kind, const Mesh& mesh, const Vector3& origin, double angle)
      : kind_(kind), origin_(origin), angle_(angle), first_layer_(mesh.layers() / 2) {}
  Vector3 signs() const { return kind_ == Kind::half_turn ? Vector3(1, -1, -1) : -Vector3::Ones(); }
  /// Finds the images of the nodes; false when the start has another shape.
  bool fits(const Mesh& mesh, const std::vector<Vector3>& start, double tolerance);

  Kind kind_;
  Vector3 origin_;
  double angle_;
  int first_layer_;
  std::vector<int> image_;  ///< of the nodes
};

}  // namespace bight::solid3d
