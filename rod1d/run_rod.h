#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mechanics/assemble.h"
#include "mechanics/friction_law.h"
#include "mechanics/path.h"
#include "mechanics/types.h"

namespace bight::rod1d {

/// Everything the rod fidelity needs, in units of D and E (mechanics/types.h).
struct RodParameters {
  double length = 42.17;          ///< L0 / D
  double poissons_ratio = 0.5;    ///< B/C = 1 + nu
  std::string knot = "overhand";  ///< to be tied: a name in knots.cpp
  bool from_straight = false;     ///< tied by moves of a straight rod, not laid out loosely
  Polyline start;  ///< tied start instead: any centerline of about that length, ends along z
  bool finish_turns = true;  ///< finish end free to turn about the pulling axis
  double finish_turn = 0;    ///< turn given to a clamped finish end once the knot is tied [rad]
  /// Of the free rod: curvature about the director d1, and twist [1/D]. Both need twist.
  double natural_curvature = 0, natural_twist = 0;
  bool contact = true;
  bool twist = false;                  ///< twist angles are unknowns
  double friction = 0;                 ///< Coulomb coefficient; 0: no friction effect
  bool friction_at_surface = true;     ///< else of the centerlines: SlipOf in friction_spots.h
  Vector3 gravity = Vector3::Zero();   ///< acceleration [E/(rho D)]; zero: no gravity effect
  Vector3 magnetic = Vector3::Zero();  ///< field, see effects/magnetic.h [sqrt(E) D]; zero: none
  bool inertia = false;                ///< the path is followed in time, not through equilibria
  double damping = 0;                  ///< in proportion to mass [1/(D sqrt(rho/E))]; needs inertia
  double speed = 1e-5;                 ///< of one end against the other, with inertia [sqrt(E/rho)]
  double time_tolerance = 1e-4;        ///< error allowed in a time step [D]
  int segments = 340;
  /// Nodes follow the knot along the rod instead of staying at equal distances on it. What friction
  /// and twist remember of material points is carried along.
  bool follow_knot = true;
  bool symmetry = true;        ///< one half is simulated if the start has a two-fold axis
  double penetration = 0.002;  ///< largest overlap aimed at [D]
  Path path;
  double stretch_stiffness_factor = 1;  ///< EA of the rod over that of its section
  /// Waypoints of the pulling force [E D^2], each a recorded state; then path has none.
  std::vector<double> forces;
};

/// A piece of a strand, a tenth of D long, that presses on another strand.
struct ContactSpot {
  double s_a, s_b;  ///< undeformed arc length of the places on both strands, s_a < s_b [D]
  double force;     ///< normal force [E D^2]
};

/// A recorded equilibrium of the rod: what the sweep and the writers need.
struct RodState {
  double ebar = 0;
  Polyline nodes;                     ///< centerline [D]
  std::vector<double> s;              ///< undeformed arc length of the nodes [D]
  std::vector<double> curvature;      ///< kappa D at the nodes
  std::vector<double> stretch;        ///< deformed over undeformed length, per segment
  std::vector<double> twist_angle;    ///< of the segments [rad]; empty without twist
  std::vector<double> twist;          ///< twist per undeformed length at the nodes [1/D]; or empty
  std::vector<double> contact_force;  ///< contact force per length at the nodes [E D]
  std::vector<ContactSpot> contacts;  ///< what touches, ordered by s_a
  std::vector<Rub> rubs;              ///< how it rubs; empty without friction
  double tension = 0;                 ///< [E D^2]
  double writhe = 0;
  int determinant = 0;  ///< of the closed centerline: 1 unknot, 3 overhand, 5 figure-eight
  std::map<std::string, double> energy_by_effect;  ///< [E D^3]
};

struct RodObserver {
  /// The straight rod and every increment of tying it. These are states of the rod that is tied,
  /// which is shorter or longer than the one of the path where tails are added or cut off.
  std::function<void(const RodState&)> on_tie = [](const RodState&) {};
  std::function<void(const StepRow&)> on_step = [](const StepRow&) {};
  std::function<void(const RodState&)> on_record = [](const RodState&) {};
  std::function<bool()> interrupted = [] { return false; };
};

struct RodResult {
  PathOutcome outcome;
  std::vector<StepRow> steps;
  std::vector<RodState> states;  ///< one per recorded ebar reached
  int unknowns = 0;
  std::vector<std::string> effects;       ///< names of the effects that were simulated
  std::vector<EffectCost> costs;          ///< of those with stencils, at the end of the path
  std::map<std::string, double> seconds;  ///< wall seconds by phase: tie, path, ...
};

/// The knot's determinant of a given start. Throws std::invalid_argument, in words, when its
/// strands run through each other or its segments are too few for its knot. Costs no solve.
int check_start(const RodParameters& parameters);

/// Relaxes the start to equilibrium at the first waypoint, then follows the path.
RodResult run_rod(const RodParameters& parameters, const RodObserver& observer = {});

}  // namespace bight::rod1d
