#pragma once

#include <optional>
#include <vector>

#include "mechanics/types.h"
#include "solid3d/mesh.h"

namespace bight::solid3d {

/// Two-fold symmetry of a knot and its mesh: half a turn about the line from the middle section to
/// the pulling axis (z through the start) maps section k on section n - 1 - k.
///
/// A frictionless overhand knot between equal ends has it. The ripple of a coarse mesh makes the
/// symmetric state unstable at some ebar, against modes that cost next to nothing; Newton then
/// wanders along them. Imposed on every iterate, the symmetry that the start has is kept.
class TwoFold {
 public:
  /// The symmetry of these node positions, if they have it to `tolerance` [D].
  static std::optional<TwoFold> find(const Mesh& mesh, const std::vector<Vector3>& start,
                                     double tolerance = 1e-6);

  /// Replaces positions, and the pairs of internal coordinates that begin at `internal_begin`, by
  /// the mean of themselves and their images.
  void impose(Vector& x, int internal_begin) const;

 private:
  int start_ = 0, middle_ = 0;    ///< nodes at the centres of those sections
  std::vector<int> node_, cell_;  ///< images
};

}  // namespace bight::solid3d
