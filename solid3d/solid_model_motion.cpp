// How a solid with inertia goes on in time.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solid3d/effects/inertia.h"
#include "solid3d/solid_model.h"

namespace bight::solid3d {

namespace {

/// Time in which the ends take up their speed, over that of a wave along the rod.
constexpr double rise_waves = 10;
/// B of a round rod over its mass per length, square root: the speed of bending waves of length
/// 2 pi D [D^2 per D sqrt(rho/E)].
const double bending_speed = std::sqrt((std::numbers::pi / 64) / (std::numbers::pi / 4));

}  // namespace

void SolidModel::set_in_motion(const MotionState& from) {
  const double length = mesh_.s.back();
  std::vector<double> waypoints = parameters_.path.waypoints;
  waypoints.insert(waypoints.begin(), start_ebar_);
  ends_.emplace(waypoints, parameters_.speed, rise_waves * length);
  MotionParameters motion;
  motion.damping.alpha = parameters_.damping;
  motion.options.tolerance = parameters_.time_tolerance;
  motion.options.velocity_scale = std::max(parameters_.speed, bending_speed / length);
  motion.options.max_step = parameters_.path.max_step / parameters_.speed;
  motion.prescribe = [this](double time, Vector& x, Vector& v) { move_grips(time, x, v); };
  const int first_cell = symmetry_ ? mesh_.cells_before(symmetry_->first_layer()) : 0;
  const Vector mass = lumped_mass(mesh_.hexahedra(), static_cast<int>(newest().size()), first_cell);
  motion_ = std::make_unique<SolidMotion>(
      system_, effects_.list, mass, symmetry_ ? 2 : 1, motion,
      [this](const Vector& guess) {
        return effects_.friction ? rubbing_.solve(system_, guess, options(), tension_, observer_)
                                 : newton(system_, guess, options(), observer_);
      },
      from);
}

void SolidModel::move_grips(double time, Vector& x, Vector& v) const {
  grip_.move(mesh_, ends_->ebar(time), x);
  for (int p = 0; p < mesh_.points_per_layer(); ++p) {
    v[3 * mesh_.node(0, p) + 2] = 0.5 * ends_->rate(time);
    v[3 * mesh_.node(mesh_.layers() - 1, p) + 2] = -0.5 * ends_->rate(time);
  }
}

/// Contact is stiffened where strands overlap by more than the bound, by a factor of e at most
/// while an end moves by D: no jump of forces.
void SolidModel::follow_overlap(double moved) {
  if (!effects_.contact) return;
  const double over = effects_.contact->max_penetration() / parameters_.penetration;
  effects_.contact->law().stiffness *= std::clamp(over, 1.0, std::exp(std::abs(moved)));
}

NewtonResult SolidModel::move_to(double ebar) {
  if (!motion_) set_in_motion({.x = newest(), .v = Vector::Zero(newest().size())});
  NewtonResult result;
  const int iterations = motion_->iterations(), factorisations = motion_->factorisations();
  const double last = ends_->next(ebar, motion_->time());
  while (halted_.empty() && motion_->time() < last) {
    if (!motion_->step(last)) {
      halted_ = motion_->reason();
      break;
    }
    result.x = motion_->x();
    result.gradient = motion_->driving_force();
    result.energy = motion_->potential_energy();
    const double before = history_.back().ebar, now = ends_->ebar(motion_->time());
    moved_ = take(result, now);
    moved_.residual = motion_->residual() / tension_;
    moved_.time = motion_->time();
    moved_.kinetic = motion_->kinetic_energy();
    moved_.energy += moved_.kinetic;
    moved_.dissipated += motion_->dissipated();
    follow_overlap(now - before);
  }
  result.x = newest();
  result.iterations = motion_->iterations() - iterations;
  result.factorisations = motion_->factorisations() - factorisations;
  result.status = halted_.empty() ? NewtonStatus::converged : NewtonStatus::rejected;
  result.reason = halted_;
  return result;
}

}  // namespace bight::solid3d
