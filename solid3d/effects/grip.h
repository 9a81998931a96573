#pragma once

#include <vector>

#include "mechanics/unknowns.h"
#include "solid3d/mesh.h"

namespace bight::solid3d {

/// The two end sections as rigid grips, each held by a control node (as in the paper): `start` is
/// clamped; `finish` is moved along z, and clamped or free to turn about z.
///
/// Without friction an end that is free to turn leaves no torque anywhere, and the knot may revolve
/// about z at no cost while the rod rolls. Then the knot's middle is pinned and the start turns
/// too: the same equilibria, seen from the knot. Only the turn between the ends has a meaning.
///
/// A grip prescribes coordinates, so it is no energy: it says which coordinates are held, and
/// reads the end tension from the forces on them.
struct Grip {
  bool finish_turns = true;
  bool start_turns = false;
  std::vector<int> pinned;  ///< further coordinates that are held

  /// Coordinates: three per node, then the turn angles of the finish and of the start [rad].
  int coordinates(const Mesh& mesh) const {
    return 3 * mesh.nodes() + (finish_turns ? 1 : 0) + (start_turns ? 1 : 0);
  }

  Unknowns unknowns(const Mesh& mesh, int with_internal) const {
    std::vector<int> blocks;
    std::vector<bool> held(static_cast<size_t>(with_internal), false);
    for (int n = 0; n < mesh.nodes(); ++n) blocks.push_back(3 * n);
    std::vector<Turn> turns;
    const auto grip = [&](int layer, bool turning) {
      Turn turn;
      for (int p = 0; p < mesh.points_per_layer(); ++p) {
        const int first = 3 * mesh.node(layer, p);
        turn.carried.push_back(first);
        for (int c = 0; c < 3; ++c) held[first + c] = !turning;
      }
      if (!turning) return;
      turn.angle = 3 * mesh.nodes() + static_cast<int>(turns.size());
      blocks.push_back(turn.angle);
      turns.push_back(turn);
    };
    grip(mesh.layers() - 1, finish_turns);
    grip(0, start_turns);
    for (int c : pinned) held[c] = true;
    return Unknowns(blocks, coordinates(mesh), held, turns);
  }

  /// Angle by which the finish is turned against the start [rad].
  double turn(const Mesh& mesh, const Vector& x) const {
    const int angles = 3 * mesh.nodes();
    return (finish_turns ? x[angles] : 0) - (start_turns ? x[angles + 1] : 0);
  }
  double start_turn(const Mesh& mesh, const Vector& x) const {
    return start_turns ? x[3 * mesh.nodes() + 1] : 0;
  }

  /// Moves the finish section along z to the end-to-end distance L0 - ebar [D].
  void move(const Mesh& mesh, double ebar, Vector& x) const {
    const int last = mesh.layers() - 1;
    const double z = x[2] + mesh.s.back() - ebar;
    for (int p = 0; p < mesh.points_per_layer(); ++p) x[3 * mesh.node(last, p) + 2] = z;
  }

  /// End tensions from the gradient by coordinates [E D^2]: pull of the finish along +z and of the
  /// start along -z. Equal at equilibrium.
  struct Tension {
    double start = 0, finish = 0;
  };
  Tension tension(const Mesh& mesh, const Vector& gradient) const {
    Tension t;
    for (int p = 0; p < mesh.points_per_layer(); ++p) {
      t.start -= gradient[3 * mesh.node(0, p) + 2];
      t.finish += gradient[3 * mesh.node(mesh.layers() - 1, p) + 2];
    }
    return t;
  }
};

}  // namespace bight::solid3d
