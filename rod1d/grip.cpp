#include "rod1d/grip.h"

namespace bight::rod1d {

std::vector<bool> held_coordinates(const Rod& rod, bool twist, bool finish_turns) {
  std::vector<bool> held(3 * rod.nodes() + (twist ? rod.segments() : 0), false);
  const int last = rod.nodes() - 1;
  for (const int node : {0, 1, last - 1, last})
    for (int c = 0; c < 3; ++c) held[Rod::position(node) + c] = true;
  if (twist) {
    held[rod.angle(0)] = true;
    held[rod.angle(rod.segments() - 1)] = !finish_turns;
  }
  return held;
}

void place_grips(const Rod& rod, double length, Vector& x) {
  const int last = rod.nodes() - 1;
  const auto place = [&](int node, double z) {
    x.segment<3>(Rod::position(node)) = Vector3(0, 0, z);
  };
  place(0, -0.5 * length);
  place(1, -0.5 * length + rod.rest_length.front());
  place(last - 1, 0.5 * length - rod.rest_length.back());
  place(last, 0.5 * length);
}

GripForces grip_forces(const Rod& rod, const Vector& gradient) {
  const int last = rod.nodes() - 1;
  const auto pull = [&](int node) { return gradient[Rod::position(node) + 2]; };
  const int angle = rod.angle(rod.segments() - 1);
  return {-pull(0) - pull(1), pull(last - 1) + pull(last),
          angle < gradient.size() ? gradient[angle] : 0.0};
}

}  // namespace bight::rod1d
