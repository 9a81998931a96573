#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupling/sweep.h"
#include "coupling/units.h"
#include "mechanics/path.h"
#include "mechanics/types.h"
#include "rod1d/run_rod.h"
#include "solid3d/run_solid.h"

namespace bight::coupling {

/// A scene that was read, checked and completed. Lengths in m, stresses in Pa; ebar has no unit.
struct Scene {
  std::string name;  ///< file name without .toml
  std::string title;
  bool rod = true, solid = true;  ///< fidelities
  double length = 0, diameter = 0, youngs_modulus = 0, poissons_ratio = 0.5;
  solid3d::MaterialParameters material;
  double density = 0;
  std::string knot;                  ///< "overhand", "figure-eight"; empty with a centerline
  bool from_straight = false;        ///< that knot is tied from a straight rod
  std::filesystem::path centerline;  ///< file with the tied start; empty with a knot
  int determinant = 0;               ///< of that knot: 1 no knot, 3 overhand, 5 figure-eight
  bool finish_turns = true, contact = true, twist = false, symmetry = true, rod_symmetry = true;
  double finish_turn = 0;  ///< of a clamped finish end of the rod [rad]
  double friction = 0;
  double natural_curvature = 0, natural_twist = 0;  ///< of the free rod [1/m]
  Vector3 gravity = Vector3::Zero();                ///< acceleration [m/s^2]
  Vector3 magnetic_field = Vector3::Zero();         ///< [T]
  double susceptibility = 0;
  bool inertia = false;
  double damping = 0;  ///< alpha [1/s]
  double speed = 0;    ///< of the moving end [m/s]
  double time_tolerance = 0;
  Path path;
  std::vector<double> forces;  ///< waypoints of the pulling force [N]; then path has none
  int segments = 0;
  bool follow_knot = true;
  bool rod_friction_at_surface = true;
  double rod_penetration = 0, stretch_stiffness_factor = 1;
  int section_elements = 0;
  std::string element;  ///< of the solid
  double hourglass_factor = 1;
  double seed_ebar = 0, axial_ratio = 0, tail_ratio = 0;
  std::vector<double> confirm_at;  ///< ebar at which the solid is solved again, and on this section
  int confirm_elements = 0;
  double contact_stiffness = 0, solid_penetration = 0, sample_spacing = 0;

  std::vector<std::string> cases;  ///< "NAME: " and "NAME: key=value"; empty: the scene is one
  std::vector<std::string> grid;   ///< of a study, "key=value, value"
  std::string extrapolate;         ///< key over which its reference is extrapolated

  std::vector<std::string> warnings;  ///< allowed, but hardly meant
  std::string text;                   ///< the scene with every default and override filled in

  bool naturally_straight() const { return natural_curvature == 0 && natural_twist == 0; }
  double slenderness() const { return length / diameter; }
  Scales scales() const { return {diameter, youngs_modulus, density}; }
};

/// Reads and checks a scene; `fidelities` (when not empty) replaces those of the scene.
/// Throws InputError that lists all problems, one per line.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 const std::vector<std::string>& fidelities = {});

/// The path up to seed_ebar, where the rod's state becomes the solid's start, and from there on.
Path path_to_seed(const Path& path, double seed_ebar);
Path path_from_seed(const Path& path, double seed_ebar);

/// What the models need, in their own units. The rod records seed_ebar when a solid follows.
rod1d::RodParameters rod_parameters(const Scene& scene);
solid3d::SolidParameters solid_parameters(const Scene& scene);
/// Of a mesh with about that many cells in a section.
SweepOptions sweep_options(const Scene& scene, int section_elements);

}  // namespace bight::coupling
