#pragma once

#include <string>
#include <vector>

#include "coupling/recorder.h"

namespace bight::coupling {

/// A recorded state of the solid, found again on a finer mesh.
struct Confirmation {
  double ebar = 0;
  double path_tension = 0;  ///< on the mesh of the path [E D^2]
  solid3d::SolidResult result;

  bool finished() const { return result.outcome.status == PathStatus::finished; }
  /// T on the mesh of the path over the confirmed one, less 1. Finished ones only.
  double path_error() const { return path_tension / result.steps.back().tension - 1; }
};

/// Relaxes the states at solid3d.confirm_at on meshes of solid3d.confirm_elements cells a section,
/// laid out for the knot as it is there. Equilibria without friction do not depend on the path, so
/// each is what a path on the finer mesh would have found; with friction each takes over how the
/// recorded state rubs. Stops at the first interruption.
std::vector<Confirmation> confirm(const Scene& scene, const solid3d::Mesh& mesh,
                                  Recorder& recorder);

std::string confirmation_text(const Scene& scene, const Confirmation& confirmation);

}  // namespace bight::coupling
