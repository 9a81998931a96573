#include "solid3d/run_solid.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "mechanics/knot_type.h"
#include "solid3d/effects/grip.h"
#include "solid3d/measure.h"
#include "solid3d/section_motion.h"

namespace bight::solid3d {

namespace {

/// Tolerances of Newton relative to the end tension.
constexpr double force_tolerance = 1e-8;
constexpr double energy_tolerance = 1e-9;
/// Energy rise that the first iteration may take, relative to T D.
constexpr double energy_rise = 0.3;
constexpr int max_iterations = 60;
/// Contact is stiffened until the overlap is in its bound, at most this often per solve.
constexpr int max_stiffenings = 6;

using Clock = std::chrono::steady_clock;

class SolidPath : public PathModel {
 public:
  SolidPath(const Mesh& mesh, const std::vector<Vector3>& start, double start_ebar,
            const SolidParameters& parameters)
      : mesh_(mesh),
        parameters_(parameters),
        grip_{parameters.finish_turns},
        pins_(pins(mesh, start, parameters)),
        internal_begin_(grip_.coordinates(mesh)),
        effects_(make_effects(mesh, parameters, internal_begin_)),
        unknowns_(grip_.unknowns(mesh, internal_begin_ + 2 * static_cast<int>(mesh.cells.size()),
                                 pins_)),
        assembler_(unknowns_, effects_.list),
        system_{assembler_, cholesky_, Ordering::dissection, {}, 0, 0, {}},
        tension_(parameters.expected_tension) {
    // Dilatation and pressure begin at zero: from the swept positions they would be K times the
    // small volume errors of the sweep.
    Vector x = Vector::Zero(internal_begin_ + 2 * static_cast<int>(mesh.cells.size()));
    for (int n = 0; n < mesh.nodes(); ++n) x.segment<3>(3 * n) = start[n];
    history_.push_back({start_ebar, std::move(x), {}});
    determinant_ = knot_determinant(centerline(mesh, newest()));
    system_.advance = [this](Vector& state, const Vector& dx) { advance(state, dx); };
  }

  Vector predict(double ebar) const override {
    const Accepted& last = history_.back();
    Vector x = last.x;
    const double de = ebar - last.ebar;
    if (de != 0 && history_.size() > 1 && last.ebar != history_.front().ebar)
      x = extrapolate_sections(mesh_, history_.front().x, x,
                               de / (last.ebar - history_.front().ebar));
    else if (de != 0)
      x = follow_grip(ebar);
    hold_grips(x);
    grip_.move(mesh_, ebar, x);
    // The middle of a symmetric knot moves half as far as the finish.
    if (!pins_.empty()) x[pins_[0]] = last.x[pins_[0]] - 0.5 * de;
    if (pins_.size() > 1) x[pins_[1]] = last.x[pins_[1]];
    return x;
  }

  NewtonResult solve(const Vector& guess, double) override {
    NewtonOptions options;
    options.max_iterations = max_iterations;
    options.force_tolerance = force_tolerance * tension_;
    options.energy_tolerance = energy_tolerance * tension_;
    options.largest_move = parameters_.largest_move;
    options.bound.first_rise = energy_rise * tension_;
    NewtonResult result = newton(system_, guess, options, observer_);
    for (int i = 0; result.ok() && effects_.contact && i < max_stiffenings; ++i) {
      const double overlap = effects_.contact->max_penetration();
      if (overlap <= parameters_.penetration) break;
      effects_.contact->law().stiffness *=
          std::clamp(1.5 * overlap / parameters_.penetration, 1.5, 4.0);
      NewtonResult again = newton(system_, result.x, options, observer_);
      again.iterations += result.iterations;
      again.factorisations += result.factorisations;
      result = std::move(again);
    }
    if (result.ok() && knot_determinant(centerline(mesh_, result.x)) != determinant_) {
      result.status = NewtonStatus::not_finite;
      result.reason = "a strand has passed through another";
    }
    return result;
  }

  StepRow accept(const NewtonResult& result, double ebar) override {
    if (history_.size() > 1 || history_.back().ebar == ebar) history_.erase(history_.begin());
    history_.push_back({ebar, result.x, result.gradient});
    const auto tension = grip_.tension(mesh_, result.gradient);
    tension_ = std::max(std::abs(tension.finish), 1e-6);

    StepRow row;
    row.ebar = ebar;
    row.tension = tension.finish;
    row.energy = result.energy;
    row.residual = result.residual / tension_;
    row.reaction_mismatch = std::abs(tension.finish - tension.start) / tension_;
    row.min_jacobian = 1;
    for (int cell = 0; cell < effects_.strain->stencils(); ++cell)
      row.min_jacobian =
          std::min(row.min_jacobian, effects_.strain->stress(newest(), cell).least_jacobian);
    if (effects_.contact) {
      row.max_penetration = effects_.contact->max_penetration();
      row.contact_pairs = effects_.contact->stencils();
    }
    if (grip_.finish_turns) row.end_turn = newest()[grip_.angle(mesh_)];
    row.wall_s = std::chrono::duration<double>(Clock::now() - begin_).count();
    return row;
  }

  SolidState state(double ebar) {
    SolidState s = fields(mesh_, effects_, newest());
    s.ebar = ebar;
    s.tension = tension_;
    s.energy_by_effect = assembler_.energy_by_effect();
    return s;
  }

  int unknowns() const { return unknowns_.size(); }
  const EffectList& effects() const { return effects_.list; }
  const std::map<std::string, double>& seconds() const { return system_.seconds; }
  void observe(NewtonObserver observer) { observer_ = std::move(observer); }

 private:
  struct Accepted {
    double ebar;
    Vector x, gradient;
  };

  const Vector& newest() const { return history_.back().x; }

  /// Without friction the knot may slide along the rod and, where the finish turns, revolve about
  /// the pulling axis (the rod rolls the other way) at no cost but what the mesh is uneven by. Both
  /// are stopped at the centre point that is farthest from the axis: one coordinate across its
  /// radius, and z. A choice of place and angle among equals.
  static std::vector<int> pins(const Mesh& mesh, const std::vector<Vector3>& start,
                               const SolidParameters& parameters) {
    const Vector3& axis = start[mesh.node(0, mesh.section.centre[0])];
    double farthest = 0.1;  // a straight rod needs no pin [D]
    std::vector<int> coordinates;
    for (int k = 1; k + 1 < mesh.layers(); ++k) {
      const int node = mesh.node(k, mesh.section.centre[0]);
      const Vector2 radius = (start[node] - axis).head<2>();
      if (radius.norm() <= farthest) continue;
      farthest = radius.norm();
      coordinates = {3 * node + 2};
      if (parameters.finish_turns)
        coordinates.push_back(3 * node + (std::abs(radius.x()) > std::abs(radius.y()) ? 1 : 0));
    }
    return coordinates;
  }

  /// Sections move rigidly through the exponential map, the turned finish about its axis.
  void advance(Vector& x, const Vector& dx) const {
    const Vector before = x;
    advance_sections(mesh_, x, dx);
    for (const Turn& turn : unknowns_.turns()) {
      Vector finish = before;
      unknowns_.advance(finish, dx);
      for (int first : turn.carried) x.segment<3>(first) = finish.segment<3>(first);
    }
    hold_grips(x, before);
  }

  /// Held sections exactly as they were.
  void hold_grips(Vector& x) const { hold_grips(x, newest()); }
  void hold_grips(Vector& x, const Vector& as) const {
    for (int pin : pins_) x[pin] = as[pin];
    x.head(3 * mesh_.points_per_layer()) = as.head(3 * mesh_.points_per_layer());
    const int last = 3 * mesh_.node(mesh_.layers() - 1, 0);
    if (!grip_.finish_turns)
      x.segment(last, 3 * mesh_.points_per_layer()) = as.segment(last, 3 * mesh_.points_per_layer());
  }

  /// Tangent predictor: the linear answer of the last tangent to the motion of the finish.
  Vector follow_grip(double ebar) const {
    const Accepted& last = history_.back();
    constexpr double probe = 1e-6;  // [D]
    const double de = ebar - last.ebar;
    Vector moved = last.x, gradient;
    const double towards = de > 0 ? probe : -probe;
    grip_.move(mesh_, last.ebar + towards, moved);
    if (!pins_.empty()) moved[pins_[0]] -= 0.5 * towards;
    assembler_.assemble(moved, Order::gradient, gradient);
    const Vector rate = (unknowns_.reduce(moved, gradient) -
                         unknowns_.reduce(last.x, last.gradient)) / towards;
    const Vector step = -de * cholesky_.solve(rate);
    Vector x = last.x;
    advance(x, unknowns_.expand(x, step));
    return x;
  }

  const Mesh& mesh_;
  const SolidParameters& parameters_;
  Grip grip_;
  std::vector<int> pins_;
  int internal_begin_;
  SolidEffects effects_;
  Unknowns unknowns_;
  mutable Assembler assembler_;
  SparseCholesky cholesky_;
  System system_;
  double tension_;
  int determinant_ = 0;
  std::vector<Accepted> history_;  ///< the last two accepted states, newest last
  NewtonObserver observer_;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace

SolidResult run_solid(const Mesh& mesh, const std::vector<Vector3>& start, double start_ebar,
                      const SolidParameters& parameters, const SolidObserver& observer) {
  SolidResult result;
  SolidPath model(mesh, start, start_ebar, parameters);
  model.observe(observer.on_iteration);
  result.unknowns = model.unknowns();
  result.cells = static_cast<int>(mesh.cells.size());
  for (const auto& effect : model.effects()) result.effects.emplace_back(effect->name());

  Path path = parameters.path;
  if (std::abs(path.waypoints.front() - start_ebar) > 1e-9)
    path.waypoints.insert(path.waypoints.begin(), start_ebar);
  PathObserver on_path;
  on_path.on_step = [&](const StepRow& row) {
    result.steps.push_back(row);
    observer.on_step(row);
  };
  on_path.on_record = [&](double ebar) {
    result.recorded.push_back(ebar);
    observer.on_record(model.state(ebar));
  };
  on_path.interrupted = observer.interrupted;
  result.outcome = follow(path, model, on_path);
  result.seconds = model.seconds();
  return result;
}

}  // namespace bight::solid3d
