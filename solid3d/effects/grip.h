#pragma once

#include "mechanics/unknowns.h"
#include "solid3d/mesh.h"

namespace bight::solid3d {

/// The two end sections as rigid grips, each held by a control node (as in the paper): `start` is
/// clamped; `finish` is moved along z, and clamped or free to turn about z.
///
/// A grip prescribes coordinates, so it is no energy: it says which coordinates are held, and
/// reads the end tension from the forces on them.
struct Grip {
  bool finish_turns = true;

  /// Coordinates: three per node, then the turn angle of the finish [rad] when it is free.
  int coordinates(const Mesh& mesh) const { return 3 * mesh.nodes() + (finish_turns ? 1 : 0); }
  int angle(const Mesh& mesh) const { return finish_turns ? 3 * mesh.nodes() : -1; }

  /// `pinned`: further coordinates to hold.
  Unknowns unknowns(const Mesh& mesh, int with_internal, const std::vector<int>& pinned = {}) const {
    std::vector<int> blocks;
    std::vector<bool> held(static_cast<size_t>(with_internal), false);
    for (int n = 0; n < mesh.nodes(); ++n) blocks.push_back(3 * n);
    const auto hold = [&](int layer) {
      for (int i = 3 * mesh.node(layer, 0); i < 3 * mesh.node(layer + 1, 0); ++i) held[i] = true;
    };
    hold(0);
    for (int c : pinned) held[c] = true;
    std::vector<Turn> turns;
    if (finish_turns) {
      blocks.push_back(angle(mesh));
      Turn turn;
      turn.angle = angle(mesh);
      for (int p = 0; p < mesh.points_per_layer(); ++p)
        turn.carried.push_back(3 * mesh.node(mesh.layers() - 1, p));
      turns.push_back(turn);
    } else {
      hold(mesh.layers() - 1);
    }
    return Unknowns(blocks, coordinates(mesh), held, turns);
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
