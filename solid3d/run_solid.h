#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mechanics/assemble.h"
#include "mechanics/friction_law.h"
#include "mechanics/path.h"
#include "mechanics/types.h"
#include "solid3d/material/parameters.h"
#include "solid3d/mesh.h"

namespace bight::solid3d {

/// Everything the solid fidelity needs, in units of D and E (mechanics/types.h).
struct SolidParameters {
  MaterialParameters material;
  std::string element = "three-field";  ///< a name in the list of elements.h
  double hourglass_factor = 1;          ///< of the stiffness of effects/hourglass.h
  bool finish_turns = true;             ///< finish end free to turn about the pulling axis
  bool symmetry = true;                 ///< of a start with a two-fold axis, simulate one half
  bool contact = true;
  double friction = 0;                ///< Coulomb coefficient; 0: no friction effect
  Vector3 gravity = Vector3::Zero();  ///< acceleration [E/(rho D)]; zero: no gravity effect
  bool inertia = false;               ///< the path is followed in time, not through equilibria
  double damping = 0;                 ///< in proportion to mass [1/(D sqrt(rho/E))]; needs inertia
  double speed = 1e-5;                ///< of one end against the other, with inertia [sqrt(E/rho)]
  double time_tolerance = 1e-4;       ///< error allowed in a time step [D]
  double contact_stiffness = 60;   ///< first normal penalty per area [E/D], less of a loose start
  double contact_onset = 0.005;    ///< width of the rounded onset of contact [D]: a fraction of
                                   ///< the overlap at moderate load
  double penetration = 0.002;      ///< largest overlap allowed [D]; stiffened until met
  double sample_spacing = 0.05;    ///< of contact samples on the surface [D]
  double largest_move = 0.15;      ///< of a node in one Newton iteration [D]
  int checkpoint_every = 4;        ///< accepted steps between checkpoints; 0: none
  double expected_tension = 1e-3;  ///< rough T at the start [E D^2]: scale of the first tolerances
  /// How the start rubs, in its axes. Empty: nothing has rubbed before it is relaxed.
  std::vector<Rub> rubs;
  Path path;
};

/// What the material on one side of a section does to that on the other, by section.
struct SectionLoads {
  std::vector<double> axial;     ///< force along the centerline, tension positive [E D^2]
  std::vector<double> bending;   ///< moment about axes across it, its size [E D^3]
  std::vector<double> twisting;  ///< moment about it, right-handed along s [E D^3]
};

/// A recorded equilibrium of the solid, for the writers.
struct SolidState {
  double ebar = 0;
  std::vector<Vector3> nodes;      ///< current positions of the mesh nodes [D]
  Polyline centerline;             ///< middle node of each section [D]
  std::vector<double> s;           ///< undeformed arc length of the sections [D]
  std::vector<double> curvature;   ///< kappa D of the centerline
  std::vector<double> flattening;  ///< 1 - smallest diameter of the section / D
  SectionLoads loads;
  std::vector<Rub> rubs;                 ///< by contact sample; empty without friction
  std::vector<double> jacobian;          ///< J, per cell
  std::vector<double> pressure;          ///< mean Cauchy stress (tension positive), per cell [E]
  std::vector<double> von_mises;         ///< per cell [E]
  std::vector<double> contact_pressure;  ///< per node, 0 inside [E]
  std::vector<double> gap;               ///< per node, to the facing strand [D]; large where none
  double tension = 0;                    ///< [E D^2]
  double min_jacobian = 1;
  int determinant = 0;     ///< of the closed centerline
  int skin_crossings = 0;  ///< pairs of triangles that cut each other beyond the overlap of contact
  std::map<std::string, double> energy_by_effect;  ///< [E D^3]
};

struct SolidCheckpoint;

struct SolidObserver {
  std::function<void(const StepRow&)> on_step = [](const StepRow&) {};
  std::function<void(const SolidState&)> on_record = [](const SolidState&) {};
  std::function<void(const SolidCheckpoint&)> on_checkpoint = [](const SolidCheckpoint&) {};
  std::function<bool()> interrupted = [] { return false; };
  NewtonObserver on_iteration;  ///< for logs; may be empty
};

struct SolidResult {
  PathOutcome outcome;
  std::vector<StepRow> steps;
  std::vector<double> recorded;  ///< ebar of the states handed to on_record
  int unknowns = 0, cells = 0;
  bool symmetric = false;  ///< one half was simulated, the other is its image
  std::vector<std::string> effects;
  std::vector<EffectCost> costs;  ///< of the same, at the end of the path
  std::map<std::string, double>
      seconds;  ///< by phase: relax, assembly, contact, factorisation, ...
};

/// Relaxes the start (node positions of the swept mesh at start_ebar) to equilibrium, walks to the
/// first waypoint, then follows the path. `from`: a checkpoint of the same mesh, start and
/// parameters to go on from instead; the steps of the result are those from there on.
SolidResult run_solid(const Mesh& mesh, const std::vector<Vector3>& start, double start_ebar,
                      const SolidParameters& parameters, const SolidObserver& observer = {},
                      const SolidCheckpoint* from = nullptr);

}  // namespace bight::solid3d
