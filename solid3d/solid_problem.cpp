#include "solid3d/solid_problem.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solid3d/effects/inertia.h"

namespace bight::solid3d {

namespace {

/// Tolerances of Newton relative to the largest force on a support.
constexpr double force_tolerance = 1e-8, energy_tolerance = 1e-9;
/// Energy rise that the first iteration may take, relative to that force times D.
constexpr double energy_rise = 0.3;
constexpr double shift_decay = 0.01;
constexpr int max_iterations = 60;
/// Minimisations with frozen friction, at most; their tolerance; and the change of the reactions
/// that ends them.
constexpr int max_passes = 8;
constexpr double frozen_tolerance = 1e-5, friction_near = 0.02;
/// Contact is stiffened until the overlap is in its bound, at most this often per solve.
constexpr int max_stiffenings = 6;
constexpr size_t kept_states = 3;       ///< for the predictor
constexpr double smallest_step = 1e-3;  ///< of the largest one, where go() gives up

}  // namespace

Vector3 RigidMotion::operator()(const Vector3& from, double t) const {
  const double angle = turn.norm() * t;
  if (angle == 0) return from + t * shift;
  return centre + Eigen::AngleAxisd(angle, turn.normalized()) * (from - centre) + t * shift;
}

SolidProblem::Solver::Solver(std::vector<int> blocks, int positions, const std::vector<bool>& held,
                             const EffectList& effects)
    : unknowns(std::move(blocks), positions, held),
      assembler(unknowns, effects),
      system{assembler, cholesky, Ordering::dissection, {}, 0, 0, {}} {}

SolidProblem::SolidProblem(const std::vector<Strand>& strands, const SolidParameters& parameters)
    : parameters_(parameters), scale_(parameters.expected_tension) {
  int nodes = 0;
  for (const Strand& strand : strands) {
    strands_.push_back(make_mesh(strand.section, strand.layers, nodes));
    nodes += strands_.back().nodes();
  }
  positions_ = 3 * nodes;
  effects_ = make_effects(strands_, parameters_, positions_);
  auto loads = std::make_unique<Load>();
  loads_ = loads.get();
  effects_.list.push_back(std::move(loads));

  Vector x = Vector::Zero(positions_ + effects_.strain->internals());
  for (size_t i = 0; i < strands.size(); ++i)
    for (int n : this->nodes(static_cast<int>(i), [](const Vector3&) { return true; }))
      x.segment<3>(3 * n) = strands[i].place(strands_[i].reference(n));
  held_.assign(static_cast<size_t>(x.size()), false);
  history_.push_back({0, std::move(x)});
}

std::vector<int> SolidProblem::section(int strand, int layer) const {
  std::vector<int> nodes;
  for (int p = 0; p < strands_[strand].points_per_layer(); ++p)
    nodes.push_back(strands_[strand].node(layer, p));
  return nodes;
}

std::vector<int> SolidProblem::nodes(int strand,
                                     const std::function<bool(const Vector3&)>& there) const {
  const Mesh& mesh = strands_[strand];
  std::vector<int> found;
  for (int n = mesh.first_node; n < mesh.first_node + mesh.nodes(); ++n)
    if (there(mesh.reference(n))) found.push_back(n);
  return found;
}

/// Other supports or loads: another path begins, and another set of unknowns.
void SolidProblem::changed() {
  history_.erase(history_.begin(), history_.end() - 1);
  solver_ = nullptr;
}

void SolidProblem::hold(const std::vector<int>& nodes) {
  for (int axis = 0; axis < 3; ++axis) hold(nodes, axis);
}

void SolidProblem::hold(const std::vector<int>& nodes, int axis) {
  for (int n : nodes) held_[static_cast<size_t>(3 * n + axis)] = true;
  changed();
}

void SolidProblem::move(const std::vector<int>& nodes, Motion motion) {
  release(nodes);
  hold(nodes);
  Move move{nodes, {}, time(), std::move(motion)};
  for (int n : nodes) move.from.push_back(position(n));
  moves_.push_back(std::move(move));
}

void SolidProblem::release(const std::vector<int>& nodes) {
  for (int n : nodes) {
    for (int axis = 0; axis < 3; ++axis) held_[static_cast<size_t>(3 * n + axis)] = false;
    for (Move& move : moves_)
      for (size_t i = move.nodes.size(); i-- > 0;)
        if (move.nodes[i] == n) {
          move.nodes.erase(move.nodes.begin() + static_cast<std::ptrdiff_t>(i));
          move.from.erase(move.from.begin() + static_cast<std::ptrdiff_t>(i));
        }
  }
  changed();
}

void SolidProblem::load(const std::vector<int>& nodes, const Vector3& force) {
  for (int n : nodes) loads_->set(n, force / static_cast<double>(nodes.size()));
  changed();
}

PathOutcome SolidProblem::go(double t, double max_step,
                             const std::function<void(const StepRow&)>& on_step) {
  PathObserver observer;
  observer.on_step = on_step;
  Path path;
  path.waypoints = {time(), t};
  path.max_step = max_step;
  path.min_step = smallest_step * max_step;
  const bool in_equilibrium = solver_ && gradient_.size() > 0;
  prepare();
  return follow(path, *this, observer,
                in_equilibrium ? PathProgress{1, time(), max_step, {}} : PathProgress{});
}

/// A solver for the present supports.
void SolidProblem::prepare() {
  if (solver_) return;
  std::vector<int> blocks;
  for (int c = 0; c < positions_; c += 3) blocks.push_back(c);
  solver_ = std::make_unique<Solver>(blocks, positions_, held_, effects_.list);
  solver_->system.advance = [this](Vector& x, const Vector& dx) {
    const Vector before = x;
    advance_sections(strands_, x, dx);
    for (int c = 0; c < positions_; ++c)
      if (held_[static_cast<size_t>(c)]) x[c] = before[c];
  };
  scale_ = std::max(scale_, loads_->total());
}

std::unique_ptr<SolidMotion> SolidProblem::release(const Vector& velocity,
                                                   const MotionParameters& parameters) {
  if (effects_.friction) throw std::invalid_argument("strands that rub cannot be released");
  prepare();
  const Vector mass = lumped_mass(hexahedra(strands_), static_cast<int>(state().size()));
  return std::make_unique<SolidMotion>(
      solver_->system, effects_.list, mass, 1, parameters,
      [this](const Vector& guess) { return minimise(guess); },
      MotionState{.x = state(), .v = velocity});
}

/// Held coordinates where they are to be at t.
Vector SolidProblem::held(Vector x, double t) const {
  for (int c = 0; c < positions_; ++c)
    if (held_[static_cast<size_t>(c)]) x[c] = state()[c];
  for (const Move& move : moves_)
    for (size_t i = 0; i < move.nodes.size(); ++i)
      x.segment<3>(3 * move.nodes[i]) = move.motion(move.from[i], t - move.since);
  return x;
}

/// Tangent predictor: the linear answer of the last tangent to the moves.
Vector SolidProblem::follow_moves(double t) const {
  constexpr double probe = 1e-6;  // [D]
  Vector dx = held(state(), t) - state();
  const double far = dx.cwiseAbs().maxCoeff();
  if (far == 0) return state();
  const Vector probed = state() + probe / far * dx;
  Vector gradient;
  solver_->assembler.assemble(probed, Order::gradient, gradient);
  const Unknowns& unknowns = solver_->unknowns;
  const Vector rate =
      (unknowns.reduce(probed, gradient) - unknowns.reduce(state(), gradient_)) * (far / probe);
  dx += unknowns.expand(state(), -solver_->cholesky.solve(rate));
  for (const auto& effect : effects_.list) effect->recover(state(), dx);
  const double longest = dx.head(positions_).cwiseAbs().maxCoeff();
  constexpr double trusted = 10;  // motion of a node against that of the moves
  if (!(longest < trusted * far)) return held(state(), t);
  Vector x = state();
  advance_sections(strands_, x, dx);
  return held(std::move(x), t);
}

Vector SolidProblem::predict(double t) const {
  if (t == time()) return held(state(), t);
  if (history_.size() == 1) return follow_moves(t);
  return held(extrapolate_sections(strands_, history_, t), t);
}

NewtonResult SolidProblem::solve(const Vector& guess, double t) {
  Vector best = guess;
  if (!effects_.friction && history_.size() > 2 && t != time()) {
    // Where contact begins or ends, the last two states foretell more than the last three.
    const std::vector<Station> two(history_.end() - 2, history_.end());
    const Vector straight = held(extrapolate_sections(strands_, two, t), t);
    const auto energy = [&](const Vector& x) {
      solver_->assembler.refresh(x);
      return solver_->assembler.energy(x);
    };
    if (energy(straight) < energy(guess)) best = straight;
  }
  const auto equilibrium = [&](const Vector& from) {
    return effects_.friction ? solve_rubbing(from) : minimise(from);
  };
  NewtonResult result = equilibrium(best);
  for (int i = 0; result.ok() && effects_.contact && i < max_stiffenings; ++i) {
    if (!effects_.contact->stiffen(parameters_.penetration)) break;
    const NewtonResult before = std::move(result);
    result = equilibrium(before.x);
    result.count_on(before);
  }
  return result;
}

NewtonOptions SolidProblem::options(double force_tolerance, double energy_tolerance) const {
  NewtonOptions options;
  options.max_iterations = max_iterations;
  options.force_tolerance = force_tolerance * scale_;
  options.energy_tolerance = energy_tolerance * scale_;
  options.largest_move = parameters_.largest_move;
  options.shift_decay = shift_decay;
  options.bound.first_rise = energy_rise * scale_;
  return options;
}

NewtonResult SolidProblem::minimise(const Vector& guess) {
  return newton(solver_->system, guess, options(force_tolerance, energy_tolerance), observer_);
}

NewtonResult SolidProblem::solve_rubbing(const Vector& guess) {
  const NewtonOptions usual = options(force_tolerance, energy_tolerance);
  NewtonResult result = rubbing_.solve(solver_->system, guess, usual, scale_, observer_);
  if (result.ok()) return result;
  // From a poor guess: minimise with frozen friction until it is near, then once more.
  NewtonResult near = solve_frozen(guess);
  near.count_on(result);
  if (!near.ok()) return near;
  return rubbing_.solve_on(solver_->system, near, usual, scale_, observer_);
}

/// Minimises at frozen normal forces, facing points and tangents, which are then taken from the
/// solution, until the supports feel little of it.
NewtonResult SolidProblem::solve_frozen(const Vector& guess) {
  NewtonResult result;
  Vector reactions;
  for (int pass = 0; pass < max_passes; ++pass) {
    rubbing_.freeze(pass == 0 ? state() : result.x);
    const NewtonResult before = result;
    result = newton(solver_->system, pass == 0 ? guess : before.x,
                    options(frozen_tolerance, frozen_tolerance), observer_);
    result.count_on(before);
    if (!result.ok()) return result;
    Vector now = Vector::Zero(positions_);
    for (int c = 0; c < positions_; ++c)
      if (held_[static_cast<size_t>(c)]) now[c] = result.gradient[c];
    if (pass > 0 && (now - reactions).norm() < friction_near * now.norm()) break;
    reactions = std::move(now);
  }
  return result;
}

StepRow SolidProblem::accept(const NewtonResult& result, double t) {
  if (history_.size() > 1 && (t - time()) * (time() - history_.front().ebar) < 0)
    history_.erase(history_.begin(), history_.end() - 1);
  if (t == time()) history_.pop_back();
  if (history_.size() == kept_states) history_.erase(history_.begin());
  history_.push_back({t, result.x});
  gradient_ = result.gradient;
  energy_ = result.energy;

  // The force scale: the most that a set of moved nodes, or the loads, carry.
  scale_ = std::max(parameters_.expected_tension, loads_->total());
  for (const Move& move : moves_) scale_ = std::max(scale_, reaction(move.nodes).norm());
  StepRow row;
  row.energy = result.energy;
  row.residual = result.residual / scale_;
  row.min_jacobian = effects_.strain->least_jacobian(state());
  if (effects_.contact) {
    row.max_penetration = effects_.contact->max_penetration();
    row.contact_pairs = effects_.contact->stencils();
  }
  if (effects_.friction) {
    row.energy +=
        effects_.friction->stored(state()) - solver_->assembler.energy_by_effect().at("friction");
    effects_.friction->accept(state());
    row.dissipated = effects_.friction->dissipated();
  }
  row.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  return row;
}

Vector3 SolidProblem::reaction(const std::vector<int>& nodes) const {
  Vector3 sum = Vector3::Zero();
  for (int n : nodes) sum += gradient_.segment<3>(3 * n);
  return sum;
}

Vector3 SolidProblem::torque(const std::vector<int>& nodes, const Vector3& about) const {
  Vector3 sum = Vector3::Zero();
  for (int n : nodes) sum += (position(n) - about).cross(Vector3(gradient_.segment<3>(3 * n)));
  return sum;
}

std::vector<SolidProblem::Touch> SolidProblem::touches() const {
  std::vector<Touch> list;
  if (!effects_.contact) return list;
  const Contact& contact = *effects_.contact;
  for (const Contact::Sample& sample : contact.samples()) {
    if (!sample.faces || !contact.law().touches(sample.gap)) continue;
    const SurfacePoint here = contact.surface().evaluate(state(), contact.own_weights(sample));
    list.push_back({contact.surface().strand_of(contact.surface().along(sample.patch)), here.y,
                    here.normal, -contact.law().slope(sample.gap), 2 * sample.weight, sample.gap});
  }
  return list;
}

}  // namespace bight::solid3d
