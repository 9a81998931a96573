#pragma once

#include <map>
#include <string>

#include "mechanics/dynamics.h"
#include "mechanics/inertial_pull.h"
#include "mechanics/newton.h"

namespace bight::solid3d {

/// All that the motion to come depends on, besides the forces.
struct MotionState {
  double time = 0;
  Vector x, v;            ///< by coordinates
  double next_step = 0;   ///< of time; 0: to be chosen
  double dissipated = 0;  ///< lost to damping so far [E D^3]
};

/// A solid in motion, with inertia. Every stage of a time step is an equilibrium under the pull of
/// its inertia, found by the Newton that finds equilibria at rest: sections turn through the
/// exponential map, pressures are unknowns of their cells, no strand passes another.
class SolidMotion {
 public:
  /// Equilibrium near a guess, under what is in the list of effects.
  using Minimise = std::function<NewtonResult(const Vector& guess)>;

  /// All must outlive this object, which adds the pull to `effects` and takes it out again.
  /// `mass`: of the nodes; carried ones are moved to their angles. `copies`: 2 where one half is
  /// simulated with its image.
  SolidMotion(System& system, EffectList& effects, const Vector& mass, int copies,
              const MotionParameters& parameters, Minimise minimise, const MotionState& from);
  ~SolidMotion();
  SolidMotion(const SolidMotion&) = delete;
  SolidMotion& operator=(const SolidMotion&) = delete;

  /// One step, not beyond `last`; false when it cannot be taken: reason().
  bool step(double last);
  /// Steps until `last`.
  bool go(double last);

  MotionState now() const { return {time(), x(), v(), dynamics_.next_step(), dissipated_}; }
  double time() const { return dynamics_.time(); }
  const Vector& x() const { return dynamics_.x(); }
  const Vector& v() const { return dynamics_.v(); }
  Vector3 position(int node) const { return x().segment<3>(3 * node); }
  const std::string& reason() const { return reason_; }
  /// Stiffer contact, other friction: from the next step on.
  void forces_changed() { dynamics_.forces_changed(); }

  /// What moves the held coordinates, by coordinates: gradient of the energy, and damping at a
  /// steady speed [E D^2].
  Vector driving_force();
  /// Of the list of effects: of one half, where one is simulated [E D^3].
  double potential_energy() { return dynamics_.potential_energy(); }
  /// Of the whole, copies and all [E D^3].
  double kinetic_energy() const { return copies_ * dynamics_.kinetic_energy(); }
  double energy() { return copies_ * potential_energy() + kinetic_energy(); }
  /// Lost to damping so far [E D^3].
  double dissipated() const { return dissipated_; }
  /// Largest out-of-balance force on an unknown that the last stage was left with [E D^2].
  double residual() const { return residual_; }

  int steps() const { return dynamics_.steps(); }
  int iterations() const { return iterations_; }
  int factorisations() const { return factorisations_; }

 private:
  std::optional<Vector> solve(const Stage& stage);
  Vector guess(const Stage& stage) const;

  System& system_;
  EffectList& effects_;
  int copies_;
  MotionParameters parameters_;
  Minimise minimise_;
  Vector mass_;
  InertialPull* pull_;  ///< in the list of effects
  Dynamics dynamics_;
  double dissipated_, residual_ = 0;
  int iterations_ = 0, factorisations_ = 0;
  std::string reason_;
};

}  // namespace bight::solid3d
