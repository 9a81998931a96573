#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "mechanics/types.h"

namespace bight::rod1d {

/// A round rod, cut into segments: its section, its undeformed lengths and, unless it is straight
/// when free, its natural curvature and twist.
///
/// The state is one vector: positions of the nodes, three each, then, where twist is simulated, the
/// twist angles of the segments.
struct Rod {
  std::vector<double> rest_length;                     ///< of the segments [D]
  double stretching_stiffness = std::numbers::pi / 4;  ///< EA [E D^2]
  double bending_stiffness = std::numbers::pi / 64;    ///< B [E D^4]
  double twisting_stiffness = 0;                       ///< C = B/(1 + nu) [E D^4]

  double mass_per_length = std::numbers::pi / 4;  ///< rho A [rho D^2]
  double spin_inertia = std::numbers::pi / 32;    ///< rho J, about the tangent [rho D^4]

  /// At the nodes, when free: curvature about d1 and d2 of the material frames, and twist, times
  /// the length that the node stands for [rad]. Empty: none.
  std::vector<Vector2> rest_curvature;
  std::vector<double> rest_twist;

  double natural_twist(int node) const { return rest_twist.empty() ? 0.0 : rest_twist[node]; }
  bool straight() const { return rest_curvature.empty(); }

  int segments() const { return static_cast<int>(rest_length.size()); }
  int nodes() const { return segments() + 1; }

  static int position(int node) { return 3 * node; }
  int angle(int segment) const { return 3 * nodes() + segment; }

  /// First coordinates of the blocks of the state, for Unknowns: nodes, then angles.
  std::vector<int> blocks(bool twist) const {
    std::vector<int> first;
    for (int i = 0; i < nodes(); ++i) first.push_back(position(i));
    for (int i = 0; twist && i < segments(); ++i) first.push_back(angle(i));
    return first;
  }

  /// Length that node i stands for in the sum over inner nodes [D].
  double voronoi_length(int node) const {
    return 0.5 * (rest_length[node - 1] + rest_length[node]);
  }
  /// Undeformed arc length of the nodes from the start [D].
  std::vector<double> arc_length() const {
    std::vector<double> s(1, 0.0);
    for (double l : rest_length) s.push_back(s.back() + l);
    return s;
  }
};

inline Rod uniform_rod(double length, int segments, double poissons_ratio) {
  Rod rod;
  rod.rest_length.assign(segments, length / segments);
  rod.twisting_stiffness = rod.bending_stiffness / (1 + poissons_ratio);
  return rod;
}

/// Gives a rod the same curvature about d1, and the same twist, everywhere when free [1/D].
inline void bend_naturally(Rod& rod, double curvature, double twist) {
  if (curvature == 0 && twist == 0) return;
  rod.rest_curvature.assign(rod.nodes(), Vector2::Zero());
  rod.rest_twist.assign(rod.nodes(), 0.0);
  for (int i = 1; i + 1 < rod.nodes(); ++i) {
    rod.rest_curvature[i][0] = curvature * rod.voronoi_length(i);
    rod.rest_twist[i] = twist * rod.voronoi_length(i);
  }
}

}  // namespace bight::rod1d
