#include "coupling/confirm.h"

#include <fmt/format.h>

#include "coupling/sweep.h"
#include "solid3d/transfer.h"

namespace bight::coupling {
namespace {

/// What a mesh is laid out for: the knot of the solid as it is, and not as it was seeded.
rod1d::RodState centerline_of(const solid3d::SolidState& state) {
  rod1d::RodState rod;
  rod.s = state.s;
  rod.nodes = state.centerline;
  rod.curvature = state.curvature;
  return rod;
}

}  // namespace

std::vector<Confirmation> confirm(const Scene& scene, const solid3d::Mesh& mesh,
                                  Recorder& recorder) {
  std::vector<Confirmation> confirmed;
  for (const solid3d::SolidState& state : recorder.solid_states) {
    if (state.nodes.empty()) continue;
    const solid3d::Mesh fine =
        swept_mesh(sweep_options(scene, scene.confirm_elements), centerline_of(state));
    solid3d::SolidParameters parameters = solid_parameters(scene);
    parameters.expected_tension = state.tension;
    parameters.rubs = state.rubs;
    parameters.path.waypoints = parameters.path.record = {state.ebar};
    parameters.checkpoint_every = 0;
    confirmed.push_back({state.ebar, state.tension, {}});
    confirmed.back().result =
        run_solid(fine, solid3d::transferred(mesh, state.nodes, fine), state.ebar, parameters,
                  recorder.watch_confirmation(fine, parameters.path));
    recorder.progress.end();
    if (confirmed.back().result.outcome.status == PathStatus::interrupted) break;
    recorder.progress.say(confirmation_text(scene, confirmed.back()));
  }
  return confirmed;
}

std::string confirmation_text(const Scene& scene, const Confirmation& confirmation) {
  const std::string what =
      fmt::format("ebar {:g} with {} cells a section", confirmation.ebar, scene.confirm_elements);
  if (!confirmation.finished())
    return fmt::format("not confirmed at {}: {}", what, confirmation.result.outcome.reason);
  const StepRow& row = confirmation.result.steps.back();
  return fmt::format("confirmed at {}: Tbar {:.5g}, {:.1f} s; that of {} cells is {:+.2f} % off",
                     what, normalised_force(row.tension), row.wall_s, scene.section_elements,
                     100 * confirmation.path_error());
}

}  // namespace bight::coupling
