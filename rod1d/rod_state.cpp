#include "rod1d/rod_state.h"

#include "mechanics/knot_type.h"
#include "rod1d/friction_spots.h"
#include "rod1d/measure.h"

namespace bight::rod1d {

RodState seen(const Rod& rod, const Vector& x, const Frames& frames, const Contact* contact) {
  RodState state;
  state.nodes = nodes_of(rod, x);
  state.s = rod.arc_length();
  state.curvature = curvature(rod, x);
  state.stretch = stretch(rod, x);
  if (!frames.tangent.empty()) {
    state.twist_angle = twist_angles(rod, frames, x);
    state.twist = twist_rate(rod, state.twist_angle);
  }
  if (contact) {
    const std::vector<ContactPoint> points = contact->points(x);
    state.contact_force = contact_force(rod, points);
    for (const RubbingPoint& at : rubbing_points(rod, points, false))
      state.contacts.push_back({at.arc_a, at.arc_b, at.force});
  }
  state.writhe = writhe(state.nodes);
  state.determinant = knot_determinant(state.nodes);
  return state;
}

}  // namespace bight::rod1d
