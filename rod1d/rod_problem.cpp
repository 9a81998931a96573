#include "rod1d/rod_problem.h"

#include "rod1d/measure.h"

namespace bight::rod1d {

RodProblem::RodProblem(Rod rod, const Polyline& nodes, bool twist)
    : rod_(std::move(rod)),
      twist_(twist || !rod_.straight()),
      x_(Vector::Zero(3 * rod_.nodes() + (twist_ ? rod_.segments() : 0))),
      held_(static_cast<size_t>(x_.size()), false) {
  for (int i = 0; i < rod_.nodes(); ++i) x_.segment<3>(Rod::position(i)) = nodes.at(i);
  if (twist_) source_ = twist_free_frames(rod_, x_);
  RodParameters parameters;
  parameters.contact = false;
  parameters.twist = twist_;
  effects_ = std::move(make_effects(rod_, parameters, source_).list);
  auto loads = std::make_unique<Load>();
  loads_ = loads.get();
  effects_.push_back(std::move(loads));
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
  std::vector<int> blocks;
  for (int i = 0; i < rod_.nodes(); ++i) blocks.push_back(Rod::position(i));
  for (int i = 0; twist_ && i < rod_.segments(); ++i) blocks.push_back(rod_.angle(i));
  return Unknowns(blocks, static_cast<int>(x_.size()), held_);
}

NewtonResult RodProblem::solve(int max_iterations) {
  const Unknowns free = unknowns();
  Assembler assembler(free, effects_);
  SparseCholesky cholesky;
  System system{assembler, cholesky, Ordering::dissection,
                [&](Vector& at, const Vector& dx) { free.advance(at, dx); }};
  const double length = rod_.arc_length().back();
  const double force = rod_.bending_stiffness / (length * length);
  NewtonOptions options;
  options.max_iterations = max_iterations;
  options.energy_tolerance = 1e-12 * force * length;
  // The second part is the round-off of the stretching forces.
  options.force_tolerance = 1e-8 * force + 1e-12 * rod_.stretching_stiffness;
  options.largest_move = 0.2 * length;
  options.bound.first_rise = 1e-10 * force * length;
  NewtonResult result = newton(system, x_, options);
  if (!result.ok()) return result;
  x_ = result.x;
  if (twist_) source_ = carried_frames(rod_, source_, x_);
  return result;
}

std::unique_ptr<RodMotion> RodProblem::release(const Vector& velocity,
                                               const MotionParameters& parameters) {
  return std::make_unique<RodMotion>(rod_, effects_, source_, held_, parameters, x_, velocity);
}

bool RodProblem::stable() {
  const Unknowns free = unknowns();
  Assembler assembler(free, effects_);
  Vector unused;
  assembler.refresh(x_);
  assembler.assemble(x_, Order::hessian, unused);
  SparseCholesky cholesky;
  cholesky.analyse(assembler.hessian(), Ordering::dissection);
  return cholesky.factor(assembler.hessian());
}

Polyline RodProblem::nodes() const { return nodes_of(rod_, x_); }

Vector RodProblem::gradient() {
  const Unknowns free = unknowns();
  Assembler assembler(free, effects_);
  Vector gradient;
  assembler.refresh(x_);
  assembler.assemble(x_, Order::gradient, gradient);
  return gradient;
}

Vector3 RodProblem::reaction(int node) { return gradient().segment<3>(Rod::position(node)); }
double RodProblem::torque(int segment) { return gradient()[rod_.angle(segment)]; }

}  // namespace bight::rod1d
