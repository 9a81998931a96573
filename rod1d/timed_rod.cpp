#include "rod1d/timed_rod.h"

#include <cmath>
#include <tuple>

#include "mechanics/knot_type.h"
#include "rod1d/flattening.h"
#include "rod1d/grip.h"
#include "rod1d/measure.h"
#include "rod1d/polyline.h"
#include "rod1d/rod_state.h"

namespace bight::rod1d {

namespace {

/// Time in which the ends take up their speed, over that of a wave along the rod.
constexpr double rise_waves = 10;
/// No coordinate moves farther than this in a time step, so no strand passes another [D].
constexpr double largest_move = 0.2;

}  // namespace

TimedRod::TimedRod(const TiedRod& tied, const RodParameters& parameters)
    : parameters_(parameters),
      rod_(tied.rod),
      history_(tied.history),
      tied_turn_(tied.turn),
      source_(tied.history.frames),
      effects_(make_effects(rod_, parameters_, source_)),
      ends_(parameters.path.waypoints, parameters.speed, rise_waves * parameters.length),
      followed_to_(ends_.ebar(0)),
      determinant_(knot_determinant(nodes_of(rod_, history_.x))),
      rubbed_away_(tied.dissipated),
      began_(std::chrono::steady_clock::now()) {
  if (effects_.contact) effects_.contact->set_law(tied.contact);
  if (effects_.friction) freeze();
  MotionParameters motion;
  motion.damping.alpha = parameters.damping;
  motion.options.tolerance = parameters.time_tolerance;
  motion.options.velocity_scale =
      std::max(parameters.speed,
               std::sqrt(rod_.bending_stiffness / rod_.mass_per_length) / parameters.length);
  motion.options.max_step = parameters.path.max_step / parameters.speed;
  if (effects_.contact) motion.options.largest_move = largest_move;
  motion.prescribe = [this](double time, Vector& x, Vector& v) { move_grips(time, x, v); };
  motion_ =
      std::make_unique<RodMotion>(rod_, effects_.list, source_,
                                  held_coordinates(rod_, parameters.twist, parameters.finish_turns),
                                  motion, history_.x, Vector::Zero(history_.x.size()));
}

void TimedRod::move_grips(double time, Vector& x, Vector& v) const {
  place_grips(rod_, parameters_.length - ends_.ebar(time), x);
  const int last = rod_.nodes() - 1;
  for (const int node : {0, 1}) v[Rod::position(node) + 2] = 0.5 * ends_.rate(time);
  for (const int node : {last - 1, last}) v[Rod::position(node) + 2] = -0.5 * ends_.rate(time);
}

/// Freezes the spots that rub at the state in which the next time step begins.
void TimedRod::freeze() {
  effects_.contact->refresh(history_.x);
  effects_.friction->freeze(effects_.contact->points(history_.x), history_.x, source_, history_);
}

/// After a time step: contact stiffness and friction for the next one.
void TimedRod::catch_up() {
  const Vector& x = motion_->x();
  if (!effects_.contact) return;
  effects_.contact->refresh(x);
  const double overlap = effects_.contact->touching(x).second;
  const double aimed = aimed_overlap * parameters_.penetration;
  ContactLaw law = effects_.contact->law();
  const double softly = std::exp(std::abs(ends_.ebar(motion_->time()) - followed_to_));
  followed_to_ = ends_.ebar(motion_->time());
  law.stiffness *= std::clamp(overlap / aimed, 1 / softly, softly);
  effects_.contact->set_law(law);
  if (effects_.friction) {
    rubbed_away_ += effects_.friction->dissipated(x);
    history_ = {x, source_, effects_.friction->memory(x)};
    freeze();
  }
  motion_->dynamics().forces_changed();
}

Vector TimedRod::predict(double) const { return motion_->x(); }

NewtonResult TimedRod::solve(const Vector&, double ebar) {
  NewtonResult result;
  const Dynamics& dynamics = motion_->dynamics();
  const int iterations = dynamics.iterations(), factorisations = dynamics.factorisations();
  const double last = ends_.next(ebar, motion_->time());
  while (failure_.empty() && motion_->time() < last) {
    if (!motion_->step(last)) {
      failure_ = dynamics.reason();
    } else {
      catch_up();
    }
  }
  result.x = motion_->x();
  if (failure_.empty() && knot_determinant(nodes_of(rod_, result.x)) != determinant_)
    failure_ = "a strand has passed through another";
  result.iterations = dynamics.iterations() - iterations;
  result.factorisations = dynamics.factorisations() - factorisations;
  result.status = failure_.empty() ? NewtonStatus::converged : NewtonStatus::rejected;
  result.reason = failure_;
  return result;
}

double TimedRod::tension() { return grip_forces(rod_, motion_->driving_force()).tension(); }

StepRow TimedRod::accept(const NewtonResult& result, double ebar) {
  const GripForces forces = grip_forces(rod_, motion_->driving_force());
  StepRow row;
  row.tension = forces.tension();
  row.end_torque = forces.torque;
  row.energy = motion_->energy();
  row.kinetic = motion_->dynamics().kinetic_energy();
  row.time = motion_->time();
  row.dissipated = motion_->dissipated() + rubbed_away_;
  if (effects_.friction)
    row.energy += effects_.friction->stored(result.x) - motion_->energy_by_effect().at("friction");
  if (effects_.contact) {
    effects_.contact->refresh(result.x);
    std::tie(row.contact_pairs, row.max_penetration) = effects_.contact->touching(result.x);
    row.flattening =
        flattening_energy(rubbing_points(rod_, effects_.contact->points(result.x), false),
                          parameters_.poissons_ratio);
  }
  if (parameters_.twist) row.end_turn = result.x[rod_.angle(rod_.segments() - 1)] - tied_turn_;
  row.ebar_unstretched = ebar + polyline_length(nodes_of(rod_, result.x)) - parameters_.length;
  row.reaction_mismatch =
      std::abs(forces.start - forces.finish) / std::max(std::abs(row.tension), 1e-300);
  row.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  return row;
}

RodState TimedRod::state() {
  if (effects_.contact) effects_.contact->refresh(motion_->x());
  RodState state = seen(rod_, motion_->x(), source_, effects_.contact);
  state.rubs = rubs(rod_, history_);
  state.ebar = ends_.ebar(motion_->time());
  state.tension = tension();
  state.energy_by_effect = motion_->energy_by_effect();
  state.energy_by_effect["inertia"] = motion_->dynamics().kinetic_energy();
  return state;
}

}  // namespace bight::rod1d
