#include "solid3d/solid_motion.h"

#include <algorithm>

namespace bight::solid3d {

namespace {

InertialPull* add_pull(EffectList& effects, const Unknowns& unknowns, const Vector& mass) {
  auto pull = std::make_unique<InertialPull>(unknowns, mass);
  InertialPull* raw = pull.get();
  effects.push_back(std::move(pull));
  return raw;
}

DynamicsOptions begun(DynamicsOptions options, const MotionState& from) {
  if (from.next_step > 0) options.first_step = from.next_step;
  return options;
}

}  // namespace

SolidMotion::SolidMotion(System& system, EffectList& effects, const Vector& mass, int copies,
                         const MotionParameters& parameters, Minimise minimise,
                         const MotionState& from)
    : system_(system),
      effects_(effects),
      copies_(copies),
      parameters_(parameters),
      minimise_(std::move(minimise)),
      mass_(system.assembler.unknowns().moved_mass(from.x, mass)),
      pull_(add_pull(effects, system.assembler.unknowns(), mass_)),
      dynamics_({system.assembler, mass_, parameters.damping.alpha, parameters.prescribe,
                 [this](const Stage& stage) { return solve(stage); }},
                begun(parameters.options, from), from.time, from.x, from.v),
      dissipated_(from.dissipated) {}

SolidMotion::~SolidMotion() {
  std::erase_if(effects_, [this](const auto& effect) { return effect.get() == pull_; });
}

/// The guess goes on at the last velocities, every section along its own arc; held coordinates, and
/// the pressures of the cells between, go where they will be.
Vector SolidMotion::guess(const Stage& stage) const {
  Vector x = stage.from, step = stage.step;
  if (!parameters_.prescribe) {
    for (const auto& effect : effects_) effect->recover(x, step);
    system_.advance(x, step);
    return x;
  }
  const Unknowns& unknowns = system_.assembler.unknowns();
  Vector there = x, velocity = step;
  parameters_.prescribe(stage.time, there, velocity);
  for (int c = 0; c < unknowns.coordinates(); ++c)
    if (there[c] != x[c] || (unknowns.index(c) < 0 && unknowns.turn_of(c) < 0))
      step[c] = there[c] - x[c];
  for (const auto& effect : effects_) effect->recover(x, step);
  system_.advance(x, step);
  parameters_.prescribe(stage.time, x, velocity);
  return x;
}

std::optional<Vector> SolidMotion::solve(const Stage& stage) {
  pull_->set(stage.strength, stage.target);
  NewtonResult result = minimise_(guess(stage));
  pull_->rest();
  iterations_ += result.iterations;
  factorisations_ += result.factorisations;
  residual_ = result.residual;
  if (result.ok()) return std::move(result.x);
  reason_ = result.reason;
  return std::nullopt;
}

bool SolidMotion::step(double last) {
  const double before = time(), power = parameters_.damping.power(mass_, v());
  if (!dynamics_.step(last)) {
    reason_ = dynamics_.reason() + (reason_.empty() ? "" : ": " + reason_);
    return false;
  }
  reason_.clear();
  dissipated_ +=
      copies_ * 0.5 * (time() - before) * (power + parameters_.damping.power(mass_, v()));
  return true;
}

bool SolidMotion::go(double last) {
  while (time() < last)
    if (!step(last)) return false;
  return true;
}

Vector SolidMotion::driving_force() {
  return dynamics_.gradient() + parameters_.damping.alpha * mass_.cwiseProduct(v());
}

}  // namespace bight::solid3d
