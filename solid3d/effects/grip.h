#pragma once

#include <vector>

#include "mechanics/unknowns.h"
#include "solid3d/mesh.h"
#include "solid3d/two_fold.h"

namespace bight::solid3d {

/// The two end sections as rigid grips, each held by a control node (as in the paper): `start` is
/// clamped; `finish` is clamped or free to turn about z. They move apart alike, z = 0 halfway.
///
/// Without friction an end that is free to turn leaves no torque anywhere, and the knot may revolve
/// about z at no cost while the rod rolls. Then the start turns too: the same equilibria, seen from
/// the knot. Only the turn between the ends has a meaning.
///
/// A grip prescribes coordinates, so it is no energy: it says which coordinates are held, and
/// reads the end tension from the forces on them.
struct Grip {
  bool finish_turns = true;
  bool start_turns = false;
  std::vector<int> pinned{};  ///< further coordinates that are held

  /// Coordinates: three per node, then the turn angles of the finish and of the start [rad].
  int coordinates(const Mesh& mesh) const {
    return 3 * mesh.nodes() + (finish_turns ? 1 : 0) + (start_turns ? 1 : 0);
  }

  /// With a symmetry, of the half that is simulated and its image.
  Unknowns unknowns(const Mesh& mesh, int with_internal, const TwoFold* symmetry = nullptr) const {
    std::vector<int> blocks;
    std::vector<bool> held(static_cast<size_t>(with_internal), false);
    std::vector<Image> images;
    if (symmetry) {
      images.resize(held.size());
      symmetry->constrain(mesh, images, held);
    }
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
    // Half a turn about x reverses a turn about z.
    if (symmetry && start_turns) images[turns[1].angle] = {turns[0].angle, -1};
    for (int c : pinned) held[c] = true;
    return Unknowns(blocks, coordinates(mesh), held, turns, images);
  }

  /// Angle by which the finish is turned against the start [rad].
  double turn(const Mesh& mesh, const Vector& x) const {
    const int angles = 3 * mesh.nodes();
    return (finish_turns ? x[angles] : 0) - (start_turns ? x[angles + 1] : 0);
  }
  double start_turn(const Mesh& mesh, const Vector& x) const {
    return start_turns ? x[3 * mesh.nodes() + 1] : 0;
  }

  /// Moves the end sections along z to the end-to-end distance L0 - ebar [D].
  void move(const Mesh& mesh, double ebar, Vector& x) const {
    const double z = 0.5 * (mesh.s.back() - ebar);
    for (int p = 0; p < mesh.points_per_layer(); ++p) {
      x[3 * mesh.node(0, p) + 2] = -z;
      x[3 * mesh.node(mesh.layers() - 1, p) + 2] = z;
    }
  }

  /// End tensions from the gradient by coordinates [E D^2]: pull of the finish along +z and of the
  /// start along -z. Equal at equilibrium.
  struct Tension {
    double start = 0, finish = 0;
    double torque = 0;  ///< about z on the finish [E D^3]; zero where it may turn
  };
  Tension tension(const Mesh& mesh, const Vector& x, const Vector& gradient) const {
    Tension t;
    for (int p = 0; p < mesh.points_per_layer(); ++p) {
      t.start -= gradient[3 * mesh.node(0, p) + 2];
      const int finish = 3 * mesh.node(mesh.layers() - 1, p);
      t.finish += gradient[finish + 2];
      t.torque += x[finish] * gradient[finish + 1] - x[finish + 1] * gradient[finish];
    }
    return t;
  }
};

}  // namespace bight::solid3d
