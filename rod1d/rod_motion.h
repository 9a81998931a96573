#pragma once

#include "mechanics/dynamics.h"
#include "rod1d/frames.h"
#include "rod1d/rod.h"

namespace bight::rod1d {

/// A rod in motion, with inertia: its effects, and the frames that twist is counted from, carried
/// along with every step.
class RodMotion {
 public:
  /// `effects` and `source` must outlive this object; `source` is empty without twist.
  RodMotion(const Rod& rod, const EffectList& effects, Frames& source,
            const std::vector<bool>& held, const MotionParameters& parameters, const Vector& x,
            const Vector& v);

  /// One step, not beyond `last`; false when it cannot be taken.
  bool step(double last);
  /// Steps until `last`.
  bool go(double last);

  Dynamics& dynamics() { return dynamics_; }
  double time() const { return dynamics_.time(); }
  const Vector& x() const { return dynamics_.x(); }
  Vector3 node(int i) const { return x().segment<3>(Rod::position(i)); }
  const Unknowns& unknowns() const { return unknowns_; }
  /// What moves the held coordinates, by coordinates: gradient of the energy, inertia and damping
  /// at a steady speed [E D^2].
  Vector driving_force();
  /// Potential and kinetic [E D^3]; the first is by effect in energy_by_effect().
  double energy() { return dynamics_.potential_energy() + dynamics_.kinetic_energy(); }
  const std::map<std::string, double>& energy_by_effect() const {
    return assembler_.energy_by_effect();
  }
  std::vector<EffectCost> costs() const { return assembler_.costs(); }
  /// Lost to damping so far [E D^3].
  double dissipated() const { return dissipated_; }

 private:
  Rod rod_;
  Frames& source_;
  Damping damping_;
  Vector mass_;
  Unknowns unknowns_;
  Assembler assembler_;
  Dynamics dynamics_;
  double dissipated_ = 0;
};

}  // namespace bight::rod1d
