#pragma once

#include <array>
#include <utility>
#include <vector>

#include "mechanics/friction_law.h"
#include "rod1d/effects/contact.h"
#include "rod1d/frames.h"

namespace bight::rod1d {

/// Segments whose nodes and angles a stencil of friction holds, on either side of the contact.
constexpr int friction_coordinates = 30;
std::array<int, friction_coordinates> friction_stencil(const Rod& rod, int a, int b);

/// Pieces of strand a whose contact points are taken together [D].
constexpr double piece_length = 0.1;

/// Where a short piece of strand a is pressed, and by how much: contact points, summed.
struct RubbingPoint {
  double arc_a = 0, arc_b = 0;  ///< undeformed arc length of the mean places on both strands [D]
  double force = 0;             ///< normal force N [E D^2]
  /// dN/dx by the nodes that N depends on [E D].
  std::vector<std::pair<int, Vector3>> force_slope;
};

/// Sums over pieces of strand a that are a tenth of D long, sorted by arc_a: slip varies little
/// over that length, and is taken where the mean force acts.
/// Without slopes, force_slope stays empty.
std::vector<RubbingPoint> rubbing_points(const Rod& rod, const std::vector<ContactPoint>& points,
                                         bool slopes = true);

/// What slip depends on at one spot: p - q of the centerlines, dy/ds of both strands, and the
/// angles of both sections.
constexpr int slip_variables = 11;

/// A place where two strands rub, frozen during a solve. The points that touch stick to their
/// sections a and b, with the material frames F: on the surface of a at p + F_a r_a, of b at
/// q + F_b r_b. The slip is the distance between them as section a sees it,
///
///   slip_c = axis_c . F_a' (p + F_a r_a - q - F_b r_b)   [D]
///
/// in its tangent plane: rolling of both strands is no slip, nor is a motion that they share. It is
/// expanded to second order in z about the state at which it was frozen: directions of friction
/// that do not turn with the strands would have a false stiffness against rolling, larger than the
/// true one.
struct FrictionSpot {
  RubbingPoint at;
  int a = 0, b = 0;                                                 ///< segments of the strands
  Eigen::Matrix<double, slip_variables, friction_coordinates> map;  ///< z = map x
  Eigen::Matrix<double, slip_variables, 1> z;                       ///< where it was frozen
  Vector2 slip;  ///< there, from the last accepted state on, with the elastic slip then
  Eigen::Matrix<double, slip_variables, 2> gradient;  ///< of both components
  std::array<Eigen::Matrix<double, slip_variables, slip_variables>, 2> hessian;
};

/// The last accepted state, and the elastic slip with which its spots stick.
struct FrictionHistory {
  Vector x;
  Frames frames;  ///< at x
  struct Memory {
    double arc_a, arc_b;   ///< undeformed arc lengths of the spot [D]
    Vector2 elastic_slip;  ///< [D]
  };
  std::vector<Memory> memory;  ///< sorted by arc_a
};

/// What rubs: the surfaces, D/2 from the centerlines, whose slip holds the spin of the material
/// frames; or the centerlines themselves, without spin and without a moment about them. That is the
/// friction of rod codes without twist, for comparisons with them.
enum class SlipOf { surface, centerline };

/// The spots of these points at x, whose frames are `frames`. The slip since the last
/// accepted state is that between the two points of the surfaces which touch at x: the distance
/// that they had then, turned along with the strands. Finite turns that both strands share are no
/// slip. A spot that was there before starts with its elastic slip.
std::vector<FrictionSpot> friction_spots(const Rod& rod, const std::vector<RubbingPoint>& points,
                                         const Vector& x, const Frames& frames,
                                         const FrictionHistory& history,
                                         SlipOf of = SlipOf::surface);

/// The elastic slips that are remembered, as vectors.
std::vector<Rub> rubs(const Rod& rod, const FrictionHistory& history);

}  // namespace bight::rod1d
