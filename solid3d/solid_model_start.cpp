// How the start of a solid comes to rest: what is swept along the rod is in nobody's balance.

#include "mechanics/coupled_newton.h"
#include "mechanics/inertial_pull.h"
#include "solid3d/effects/inertia.h"
#include "solid3d/solid_model.h"

namespace bight::solid3d {

namespace {

/// Times that a start is tried with contact a tenth as stiff.
constexpr int softer_starts = 2;
/// Drag on a start that is relaxed slowly, over the length of a step of time [E/D^2]: in the first
/// step, at most where steps fail, and from one step to the next.
constexpr double first_drag = 3e-3, most_drag = 10, drag_decay = 0.1;
/// Largest move of a coordinate in the step behind which the drag is let go [D].
constexpr double nearly_at_rest = 1e-3;

}  // namespace

NewtonResult SolidModel::relax(const Vector& start) {
  start_energy_ = energy(start);
  NewtonResult result = relax_at_once(start);
  const auto again = [&](NewtonResult next) {
    next.count_on(result);
    result = std::move(next);
  };
  // Tractions that nothing sticks to may leave a knot unstable.
  if (!result.ok() && effects_.friction) again(relax_slowly());
  // A tight start overlaps by more than stiff contact can push out at once.
  for (int i = 0; !result.ok() && effects_.contact && !effects_.friction && i < softer_starts;
       ++i) {
    effects_.contact->law().stiffness *= 0.1;
    again(relax_at_once(start));
  }
  return result;
}

NewtonResult SolidModel::relax_at_once(const Vector& start) {
  system_.shift = unknown_shift;
  return effects_.friction ? solve_with_friction(start) : settle_or_minimise(start);
}

NewtonResult SolidModel::settle_or_minimise(const Vector& guess) {
  const NewtonResult settled = settle(guess);
  if (settled.ok()) return stiffened(settled);
  NewtonResult result = solve_frictionless(guess);
  result.count_on(settled);
  return result;
}

/// Damped steps, which may raise the energy: the cells of a swept start store less than the same
/// shape true to volume does, and its strands overlap.
NewtonResult SolidModel::settle(const Vector& start) {
  struct : FollowingForces {
    void freeze(const Vector&) override {}
    void add_change(const Vector&, Vector&) const override {}
  } none;
  return coupled_newton(system_, none, start, options(), {.damped = true}, observer_);
}

/// As in a viscous bath, alpha M v = -dW/dx, in implicit Euler steps of growing length. In the
/// first one cells and overlaps settle, under what tractions the start was given; from there on
/// strands slip and stick step by step, on the way that they take. Abaqus calls damping like this
/// automatic stabilization; here it is gone when the path begins.
NewtonResult SolidModel::relax_slowly() {
  const int first_cell = symmetry_ ? mesh_.cells_before(symmetry_->first_layer()) : 0;
  const Vector mass = lumped_mass(mesh_.hexahedra(), static_cast<int>(newest().size()), first_cell);
  effects_.list.push_back(std::make_unique<InertialPull>(unknowns_, mass));
  auto& drag = static_cast<InertialPull&>(*effects_.list.back());
  system_.shift = unknown_shift;
  start_energy_ = 0;
  NewtonResult result;
  double strength = first_drag, moved = 1;
  while (moved > nearly_at_rest && strength < most_drag) {
    drag.set(strength, newest());
    NewtonResult next = rubbing_.solve(system_, newest(), options(), tension_, observer_);
    next.count_on(result);
    result = std::move(next);
    strength *= result.ok() ? drag_decay : 1 / drag_decay;
    if (!result.ok()) continue;
    freeze_whole(newest());
    accept_friction(result.x);
    moved = (result.x - newest()).head(internal_begin_).cwiseAbs().maxCoeff();
    history_.back().x = result.x;
  }
  effects_.list.pop_back();
  if (!result.ok()) return result;
  for (const SolidEffects* effects : {&effects_, &whole_effects_})
    if (effects->friction) effects->friction->begin_books();
  NewtonResult rest = solve_rubbing(newest());
  rest.count_on(result);
  return rest;
}

}  // namespace bight::solid3d
