#pragma once

#include <array>
#include <optional>
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

/// The skin of a swept rod as a C1 surface: the rim nodes are control points of a biquadratic
/// B-spline, periodic around the rod. Facets ripple by 0.4 to 1 % of D and make frictionless
/// surfaces feel rough; this surface is smooth, with closed-form derivatives and a 3 x 3 stencil.
///
/// Every rim node (a, k) owns the patch u in [a - 1/2, a + 1/2], v in [k - 1/2, k + 1/2]. The
/// spline of a round section lies inside its control points; `skin` is what is missing to D/2.
class ContactSurface {
 public:
  explicit ContactSurface(const Mesh& mesh);

  int sides() const { return sides_; }
  int layers() const { return layers_; }
  int patches() const { return sides_ * layers_; }
  int around(int patch) const { return patch % sides_; }
  int along(int patch) const { return patch / sides_; }
  int patch(int around, int along) const {
    return along * sides_ + (around % sides_ + sides_) % sides_;
  }
  /// The first and the last layer carry no patch of their own.
  bool has_patch(int along) const { return along > 0 && along < layers_ - 1; }

  /// First coordinate of the rim node (a, k); a is periodic.
  int coordinate(int around, int along) const { return first_[patch(around, along)]; }
  int node(int patch) const { return first_[patch] / 3; }

  double arc_length(int along) const { return s_[along]; }
  double skin() const { return skin_; }
  /// Reference area of a patch, of the true cylinder [D^2].
  double area(int patch) const;
  /// Extent of a patch around and along the rod [D].
  Vector2 extent(int patch) const;

  PatchWeights weights(double u, double v) const;
  SurfacePoint evaluate(const Vector& x, const PatchWeights& weights) const;

  /// Parameters of the surface point nearest to `point`, by Newton's method from `start`; nothing
  /// when the search leaves the surface or does not settle.
  std::optional<Vector2> project(const Vector& x, const Vector3& point, Vector2 start) const;

 private:
  int sides_, layers_;
  double skin_;
  std::vector<int> first_;
  std::vector<double> s_;
};

}  // namespace bight::solid3d
