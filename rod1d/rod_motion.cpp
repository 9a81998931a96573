#include "rod1d/rod_motion.h"

#include "rod1d/effects/inertia.h"

namespace bight::rod1d {

RodMotion::RodMotion(const Rod& rod, const EffectList& effects, Frames& source,
                     const std::vector<bool>& held, const MotionParameters& parameters,
                     const Vector& x, const Vector& v)
    : rod_(rod),
      source_(source),
      damping_(parameters.damping),
      mass_(lumped_mass(rod, !source.tangent.empty())),
      unknowns_(rod.blocks(!source.tangent.empty()), static_cast<int>(held.size()), held),
      assembler_(unknowns_, effects),
      dynamics_({assembler_, mass_, damping_.alpha, parameters.prescribe}, parameters.options, 0, x,
                v) {}

bool RodMotion::step(double last) {
  const double before = time(), power = damping_.power(mass_, dynamics_.v());
  if (!dynamics_.step(last)) return false;
  dissipated_ += 0.5 * (time() - before) * (power + damping_.power(mass_, dynamics_.v()));
  if (!source_.tangent.empty()) {
    source_ = carried_frames(rod_, source_, x());
    dynamics_.forces_changed();
  }
  return true;
}

bool RodMotion::go(double last) {
  while (time() < last)
    if (!step(last)) return false;
  return true;
}

Vector RodMotion::driving_force() {
  return dynamics_.gradient() + damping_.alpha * mass_.cwiseProduct(dynamics_.v());
}

}  // namespace bight::rod1d
