#include "rod1d/rod_problem.h"

#include "rod1d/measure.h"

namespace bight::rod1d {

namespace {

RodParameters parameters_of(bool twist, const RodProblem::Touch* touch) {
  RodParameters parameters;
  parameters.twist = twist;
  parameters.contact = touch;
  if (touch) parameters.friction = touch->friction;
  return parameters;
}

/// Solves with friction frozen anew, at most, and the part of the friction forces that may still
/// change.
constexpr int max_passes = 60;
constexpr double settled = 1e-3;

}  // namespace

RodProblem::RodProblem(Rod rod, const Polyline& nodes, bool twist)
    : RodProblem(std::move(rod), nodes, twist, nullptr) {}

RodProblem::RodProblem(Rod rod, const Polyline& nodes, bool twist, const Touch& touch)
    : RodProblem(std::move(rod), nodes, twist || touch.friction > 0, &touch) {}

RodProblem::RodProblem(Rod rod, const Polyline& nodes, bool twist, const Touch* touch)
    : rod_(std::move(rod)),
      twist_(twist || !rod_.straight()),
      x_(Vector::Zero(3 * rod_.nodes() + (twist_ ? rod_.segments() : 0))),
      held_(static_cast<size_t>(x_.size()), false) {
  for (int i = 0; i < rod_.nodes(); ++i) x_.segment<3>(Rod::position(i)) = nodes.at(i);
  if (twist_) source_ = twist_free_frames(rod_, x_);
  effects_ = make_effects(rod_, parameters_of(twist_, touch), source_);
  if (touch) effects_.contact->set_law(touch->law);
  history_ = {x_, source_, {}};
  auto loads = std::make_unique<Load>();
  loads_ = loads.get();
  effects_.list.push_back(std::move(loads));
}

void RodProblem::hold(int node) {
  for (int axis = 0; axis < 3; ++axis) hold(node, axis);
}
void RodProblem::hold(int node, int axis) { held_[Rod::position(node) + axis] = true; }
void RodProblem::move(int node, const Vector3& to) { x_.segment<3>(Rod::position(node)) = to; }
void RodProblem::hold_angle(int segment) { held_[rod_.angle(segment)] = true; }
void RodProblem::turn(int segment, double by) { x_[rod_.angle(segment)] += by; }
void RodProblem::load(int node, const Vector3& force) { loads_->add(node, force); }

void RodProblem::weigh(const Vector3& force_per_length) {
  for (int i = 0; i < rod_.nodes(); ++i) {
    const double before = i > 0 ? rod_.rest_length[i - 1] : 0;
    const double behind = i < rod_.segments() ? rod_.rest_length[i] : 0;
    load(i, 0.5 * (before + behind) * force_per_length);
  }
}

void RodProblem::twist_uniformly(double by) {
  const std::vector<double> s = rod_.arc_length();
  const auto middle = [&](int i) { return 0.5 * (s[i] + s[i + 1]); };
  const int last = rod_.segments() - 1;
  for (int i = 0; i <= last; ++i)
    x_[rod_.angle(i)] += by * (middle(i) - middle(0)) / (middle(last) - middle(0));
}

Unknowns RodProblem::unknowns() const {
  return Unknowns(rod_.blocks(twist_), static_cast<int>(x_.size()), held_);
}

NewtonResult RodProblem::minimise(System& system, const Vector& x, int max_iterations) {
  const double length = rod_.arc_length().back();
  double force = std::max(rod_.bending_stiffness / (length * length), loads_->total());
  if (effects_.contact) force = std::max(force, 1e-6 * rod_.stretching_stiffness);
  NewtonOptions options;
  options.max_iterations = max_iterations;
  options.energy_tolerance = 1e-12 * force * length;
  // The second part is the round-off of the stretching and bending forces.
  const double shortest = *std::min_element(rod_.rest_length.begin(), rod_.rest_length.end());
  options.force_tolerance = 1e-8 * force + 1e-12 * rod_.stretching_stiffness +
                            1e-11 * rod_.bending_stiffness / (shortest * shortest);
  options.largest_move = effects_.contact ? std::min(0.5, 0.2 * length) : 0.2 * length;
  options.bound.first_rise = 1e-10 * force * length;
  return newton(system, x, options);
}

/// Freezes the spots that rub at x for the next solve.
void RodProblem::freeze(const Vector& x) {
  source_ = carried_frames(rod_, source_, x);
  effects_.contact->refresh(x);
  effects_.friction->freeze(effects_.contact->points(x), x, source_, history_);
}

NewtonResult RodProblem::solve(int max_iterations) {
  const Unknowns free = unknowns();
  Assembler assembler(free, effects_.list);
  SparseCholesky cholesky;
  System system{assembler, cholesky, Ordering::dissection,
                [&](Vector& at, const Vector& dx) { free.advance(at, dx); }};
  if (effects_.friction) freeze(x_);
  NewtonResult result = minimise(system, x_, max_iterations);
  for (int pass = 1; effects_.friction && result.ok(); ++pass) {
    // What is out of balance when friction is frozen where the last solve ended?
    freeze(result.x);
    assembler.refresh(result.x);
    assembler.assemble(result.x, Order::gradient, result.gradient);
    if (free.reduce(result.x, result.gradient).cwiseAbs().sum() <=
        settled * effects_.friction->normal_force())
      break;
    if (pass == max_passes) {
      result.status = NewtonStatus::too_many_iterations;
      result.reason = "friction does not settle";
      return result;
    }
    NewtonResult next = minimise(system, result.x, max_iterations);
    next.count_on(result);
    result = std::move(next);
  }
  if (!result.ok()) return result;
  x_ = result.x;
  if (twist_) source_ = carried_frames(rod_, source_, x_);
  if (effects_.friction) {
    dissipated_ += effects_.friction->dissipated(x_);
    history_ = {x_, source_, effects_.friction->memory(x_)};
  }
  return result;
}

double RodProblem::overlap() {
  if (!effects_.contact) return 0;
  effects_.contact->refresh(x_);
  return effects_.contact->touching(x_).second;
}

std::unique_ptr<RodMotion> RodProblem::release(const Vector& velocity,
                                               const MotionParameters& parameters) {
  return std::make_unique<RodMotion>(rod_, effects_.list, source_, held_, parameters, x_, velocity);
}

bool RodProblem::stable() {
  const Unknowns free = unknowns();
  Assembler assembler(free, effects_.list);
  return bight::stable(assembler, x_);
}

Polyline RodProblem::nodes() const { return nodes_of(rod_, x_); }

Vector RodProblem::gradient() {
  const Unknowns free = unknowns();
  Assembler assembler(free, effects_.list);
  Vector gradient;
  assembler.refresh(x_);
  assembler.assemble(x_, Order::gradient, gradient);
  return gradient;
}

Vector3 RodProblem::reaction(int node) { return gradient().segment<3>(Rod::position(node)); }
double RodProblem::torque(int segment) { return gradient()[rod_.angle(segment)]; }

}  // namespace bight::rod1d
