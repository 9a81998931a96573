#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "mechanics/types.h"
#include "solid3d/mesh.h"

namespace bight::solid3d {

/// Point of a contact surface, with derivatives by its parameters (u: around, v: along).
struct SurfacePoint {
  Vector3 y, y_u, y_v, y_uu, y_uv, y_vv;
  Vector3 normal;  ///< unit, outwards
};

/// Where a parameter pair (u, v) lies: the patch, and the B-spline weights of its 3 x 3 nodes.
struct PatchWeights {
  int around = 0, along = 0;  ///< patch (a, k): the rim node at its middle
  std::array<double, 3> u, du, ddu, v, dv, ddv;
};

/// The skins of swept strands as C1 surfaces: the rim nodes are control points of a tensor-product
/// B-spline, trigonometric and periodic around the strand (a round section is a circle, a flattened
/// one an ellipse, exactly), quadratic along it. Facets ripple by 0.4 to 1 % of D and make
/// frictionless surfaces feel rough; this surface is smooth, with closed-form derivatives and a
/// 3 x 3 stencil.
///
/// Every rim node (a, k) owns the patch u in [a - 1/2, a + 1/2], v in [k - 1/2, k + 1/2]. The
/// spline of a round section lies inside its control points; `skin` is what is missing to its
/// radius. Layers, and so v, are numbered through all strands.
class ContactSurface {
 public:
  explicit ContactSurface(std::span<const Mesh> strands);
  explicit ContactSurface(const Mesh& mesh) : ContactSurface(std::span(&mesh, 1)) {}

  int layers() const { return static_cast<int>(s_.size()); }
  int sides(int along = 0) const { return strand(along).sides; }
  int patches() const { return static_cast<int>(along_.size()); }
  int around(int patch) const { return patch - first_patch_[along_[patch]]; }
  int along(int patch) const { return along_[patch]; }
  int patch(int around, int along) const {
    const int sides = strand(along).sides;
    return first_patch_[along] + (around % sides + sides) % sides;
  }
  /// The first and the last layer of a strand carry no patch of their own.
  bool has_patch(int along) const {
    return along > strand(along).first && along < strand(along).last;
  }
  /// Number of the strand that a layer belongs to.
  int strand_of(int along) const { return strand_of_[along]; }

  /// First coordinate of the rim node (a, k); a is periodic.
  int coordinate(int around, int along) const { return first_[patch(around, along)]; }
  int node(int patch) const { return first_[patch] / 3; }

  double arc_length(int along) const { return s_[along]; }
  double arc_length_at(double v) const {
    const int along = std::min(static_cast<int>(v), layers() - 2);
    return s_[along] + (v - along) * (s_[along + 1] - s_[along]);
  }
  /// Between two layers along their strand; infinite between strands [D].
  double apart(int along, int other) const {
    return strand_of_[along] == strand_of_[other] ? std::abs(s_[along] - s_[other])
                                                  : std::numeric_limits<double>::infinity();
  }
  double skin(int along = 0) const { return strand(along).skin; }
  /// Reference area of a patch, of the true cylinder [D^2].
  double area(int patch) const;
  /// Extent of a patch around and along the rod [D].
  Vector2 extent(int patch) const;

  PatchWeights weights(double u, double v) const;

  /// The same of the cells' own faces where these are of second degree: biquadratic over the 3 x 3
  /// nodes of a face, continuous, on the circle at its nodes. Loads on them reach the nodes as the
  /// cells need them (four times as much in the middle of a side as at its ends), those of a spline
  /// reach all nodes alike.
  PatchWeights face_weights(double u, double v) const;
  double face_skin(int along = 0) const { return strand(along).face_skin; }
  SurfacePoint evaluate(const Vector& x, const PatchWeights& weights) const;

  /// Of the equations y_u . d = y_v . d = 0 with d = point - y, minus the derivative by (u, v).
  static Eigen::Matrix2d projection_matrix(const SurfacePoint& at, const Vector3& d) {
    Eigen::Matrix2d M;
    M(0, 0) = at.y_u.squaredNorm() - d.dot(at.y_uu);
    M(1, 1) = at.y_v.squaredNorm() - d.dot(at.y_vv);
    M(0, 1) = M(1, 0) = at.y_u.dot(at.y_v) - d.dot(at.y_uv);
    return M;
  }

  /// Parameters of the surface point nearest to `point`, by Newton's method from `start`; nothing
  /// when the search leaves the strand or does not settle.
  std::optional<Vector2> project(const Vector& x, const Vector3& point, Vector2 start) const;

 private:
  struct Strand {
    int degree, sides, first, last;  ///< first and last layer
    double diameter, skin, face_skin;
  };
  const Strand& strand(int along) const { return strands_[strand_of_[along]]; }

  std::vector<Strand> strands_;
  std::vector<int> strand_of_, first_patch_;  ///< by layer
  std::vector<double> s_;                     ///< by layer
  std::vector<int> along_, first_;            ///< by patch
};

}  // namespace bight::solid3d
