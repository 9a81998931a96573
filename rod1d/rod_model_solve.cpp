// How equilibrium is found, with contact as stiff as it has to be and friction settled.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mechanics/rubbing_newton.h"
#include "rod1d/pin.h"
#include "rod1d/rod_equations.h"

namespace bight::rod1d {

namespace {

/// Newton iterations in which an equilibrium is found that is near, and one that is far.
constexpr int some_iterations = 100, many_iterations = 1000;
/// Whiles of motion by which a failed solve is helped on, at most.
constexpr int most_motions = 20;
/// By which a state that weight would leave is turned first, so that it does [rad].
constexpr double slight_roll = 0.05;
/// Solves of one step with contact stiffness and friction taken anew, at most.
constexpr int max_passes = 12, max_relaxed_passes = 20;
/// Of them, those whose friction is that of the solution before, and those after which it goes
/// only half as far from pass to pass as before.
constexpr int whole_passes = 3, shorter_after[] = {whole_passes, 7, 13};
/// Residual over the force scale up to which a search that cannot go on has converged.
constexpr double stalled_residual = 1e-3;
/// Share of the tension that further solves may still change when friction has settled.
constexpr double settled_change = 5e-4;
/// Of the iterations with the whole tangent. The minimisation that comes after them does the rest.
constexpr int many_first = 30;
constexpr RubbingLimits rubbing_limits{.short_step = 5e-2,
                                       .few_first = 2,
                                       .most_full = 12,
                                       .first_force_tolerance = 1,
                                       .energy_tolerance = 1e-5,
                                       .force_tolerance = 0.1};

/// How far friction goes in a pass from where it was frozen to the last solution. Where passes do
/// not settle they mostly go back and forth.
double relaxation(int pass) {
  double part = 1;
  for (const int after : shorter_after)
    if (pass >= after) part *= 0.5;
  return part;
}

}  // namespace

NewtonResult RodModel::solve_once(const Vector& guess) {
  NewtonOptions options;
  options.max_iterations = far_ ? many_iterations : some_iterations;
  options.energy_tolerance = 1e-10 * force_scale_;
  // No better than what the round-off of the places in space does to stretching and bending forces.
  const double shortest = *std::min_element(rod_.rest_length.begin(), rod_.rest_length.end());
  const double round_off = std::numeric_limits<double>::epsilon() * 0.5 * length_ / shortest;
  options.force_tolerance = std::max(
      1e-7 * force_scale_,
      (4 * rod_.stretching_stiffness + rod_.bending_stiffness / (shortest * shortest)) * round_off);
  options.largest_move = 1;
  options.bound.first_rise = 1e-8 * force_scale_;  // round-off of the energy
  NewtonResult result = newton(equations_->system, guess, options);
  // On very fine meshes the energy's round-off ends the search before the residual's does.
  if (result.status == NewtonStatus::stalled && result.decrement <= options.energy_tolerance &&
      result.residual <= stalled_residual * force_scale_) {
    result.status = NewtonStatus::converged;
    result.reason.clear();
  }
  // A knot that hangs rolls over where its centre of mass comes above the axis: too far for Newton,
  // which may also find the balance in between.
  for (int k = 0; k < most_motions && acted_on() && !rubs_; ++k) {
    if (result.ok() && stable(equations_->assembler, result.x)) break;
    const NewtonResult before = std::move(result);
    result = newton(equations_->system, let_move(rolled(before.x, slight_roll)), options);
    result.count_on(before);
  }
  return result;
}

/// x turned about the axis [rad].
Vector RodModel::rolled(Vector x, double angle) const {
  turn(rod_, Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix(), x);
  return x;
}

/// Where the rod gets to from x, at rest, in a while of well-damped motion with its ends held.
Vector RodModel::let_move(const Vector& x) {
  std::vector<bool> held(static_cast<size_t>(x.size()));
  for (int c = 0; c < x.size(); ++c) held[c] = equations_->unknowns.index(c) < 0;
  // Bending waves are as long as the rod at most.
  const double slowest =
      std::sqrt(rod_.bending_stiffness / rod_.mass_per_length) / (length_ * length_);
  MotionParameters parameters;
  parameters.damping.alpha = 20 * slowest;
  parameters.options = {.tolerance = 1e-3,
                        .velocity_scale = slowest * length_,
                        .largest_move = effects_.contact ? 0.2 : 1.0};
  RodMotion motion(rod_, effects_.list, source_, held, parameters, x, Vector::Zero(x.size()));
  motion.go(0.5 / slowest);
  return motion.x();
}

/// Freezes the spots that rub at x for the next solve, and counts twist from there.
void RodModel::freeze(const Vector& x) {
  source_ = carried_frames(rod_, source_, x);
  effects_.contact->refresh(x);
  std::vector<ContactPoint> points = effects_.contact->points(x);
  if (symmetry_) points = symmetry_->halved(std::move(points), length_);
  effects_.friction->freeze(points, x, source_, before_);
}

/// Friction whose limits follow the normal forces, from a guess that is near: Newton steps with the
/// whole tangent. The spots are left frozen where it ends.
NewtonResult RodModel::solve_rubbing(const Vector& guess) {
  struct Rubbing final : RubbingForces {
    explicit Rubbing(RodModel& model) : model(model) {}
    void freeze(const Vector& x) override { model.freeze(x); }
    void freeze_last() override {
      model.source_ = model.before_.frames;
      model.freeze(model.before_.x);
    }
    void add_change(const Vector& dx, Vector& gradient) const override {
      model.effects_.friction->add_change(dx, gradient);
    }
    RodModel& model;
  } forces(*this);
  NewtonOptions options;
  options.max_iterations = many_first;
  options.largest_move = 1;
  source_ = before_.frames;
  return newton_rubbing(equations_->system, forces, guess, options, rubbing_limits, force_scale_);
}

/// Equilibrium on the present nodes, with contact so stiff that strands overlap little. Without
/// friction that is one minimisation, as a rule. Friction freezes the spots that rub and is solved
/// again with those of the solution until the tension has settled. Mostly the first spots are those
/// of a state that is nearly in equilibrium with its own friction; where that is not found they are
/// those of the last accepted state, and more solves are needed, at last with spots between those
/// of the solutions (relaxed fixed-point iteration).
NewtonResult RodModel::solve_contact(Vector x) {
  const double aimed = aimed_overlap * parameters_.penetration;
  double stiffness = effects_.contact ? effects_.contact->law().stiffness : 0;
  if (effects_.contact) effects_.contact->set_law({stiffness, 2 * aimed});
  NewtonResult result;
  int iterations = 0, factorisations = 0;
  double tension = 0, change = 0;
  bool near = false;
  if (rubs_ && tension_ > 0) {
    NewtonResult rubbed = solve_rubbing(x);
    iterations += rubbed.iterations, factorisations += rubbed.factorisations;
    near = rubbed.ok();
    if (near) {
      tension = grip_forces(rod_, rubbed.gradient).tension();
      x = std::move(rubbed.x);
    } else {
      source_ = before_.frames;
    }
  }
  Vector rubs_at = before_.x;
  const int passes = relaxes_ ? max_relaxed_passes : max_passes;
  for (int pass = 0; pass < passes; ++pass) {
    if (effects_.contact) effects_.contact->set_law({stiffness, 2 * aimed});
    const double part = relaxes_ ? relaxation(pass) : 1;
    if (rubs_ && !(near && pass == 0)) {
      if (pass > 0) rubs_at += part * (result.x - rubs_at);
      freeze(rubs_at);
    }
    result = solve_once(pass == 0 ? x : result.x);
    iterations += result.iterations, factorisations += result.factorisations;
    if (!result.ok() || !effects_.contact) break;
    const double last_change =
        std::abs(std::exchange(change, grip_forces(rod_, result.gradient).tension() - tension));
    tension += change;
    const double little = settled_change * part * force_scale_;
    // The changes fall like a geometric series, at last: what is left is its rest. A small change
    // after a large one may be an overshoot.
    const double left = change * change / std::max(last_change - std::abs(change), 1e-30);
    const bool settled = !rubs_ || (near && pass == 0 && std::abs(change) <= little) ||
                         (pass > (near ? 0 : 1) && last_change <= 10 * little &&
                          std::min(left, std::abs(change)) <= little);
    const double overlap = effects_.contact->touching(result.x).second;
    const bool first = tension_ == 0;
    if (settled && overlap <= parameters_.penetration &&
        (!first || overlap > 0.3 * parameters_.penetration))
      break;
    if (pass + 1 == passes && !settled) {
      result.status = NewtonStatus::too_many_iterations;
      result.reason = "friction does not settle";
    }
    if (overlap > parameters_.penetration || first)
      stiffness *= std::clamp(overlap / aimed, 0.3, 4.0);
  }
  if (result.ok() && rubs_ && tension < 0) {
    result.status = NewtonStatus::rejected;
    result.reason = "friction keeps the knot shut: the ends would have to push";
  }
  result.iterations = iterations, result.factorisations = factorisations;
  return result;
}

}  // namespace bight::rod1d
