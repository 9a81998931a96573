#include "solid3d/run_solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include "mechanics/knot_type.h"
#include "solid3d/checkpoint.h"
#include "solid3d/effects/grip.h"
#include "solid3d/measure.h"
#include "solid3d/section_motion.h"
#include "solid3d/two_fold.h"

namespace bight::solid3d {

namespace {

/// Tolerances of Newton relative to the end tension.
constexpr double force_tolerance = 1e-8;
constexpr double energy_tolerance = 1e-9;
/// Energy rise that the first iteration may take, relative to T D.
constexpr double energy_rise = 0.3;
constexpr double shift_decay = 0.01;  // good guesses need no slow decay
constexpr int max_iterations = 60;
/// Contact is stiffened until the overlap is in its bound, at most this often per solve.
constexpr int max_stiffenings = 6;
/// Friction has settled when the end tension changes by less than this part of it.
constexpr double friction_settled = 5e-4;
constexpr int max_friction_passes = 10;
constexpr size_t kept_states = 3;  ///< for the predictor

using Clock = std::chrono::steady_clock;

class SolidPath : public PathModel {
 public:
  SolidPath(const Mesh& mesh, const std::vector<Vector3>& start, double start_ebar,
            const SolidParameters& parameters, Clock::time_point began)
      : mesh_(mesh),
        parameters_(parameters),
        symmetry_(parameters.symmetry ? TwoFold::find(mesh, start) : std::nullopt),
        from_frame_(frame(mesh, start, symmetry_)),
        grip_(make_grip(mesh, start, parameters, symmetry_.has_value())),
        internal_begin_(grip_.coordinates(mesh)),
        effects_(make_effects(mesh, parameters, internal_begin_,
                              symmetry_ ? symmetry_->first_layer() : 0)),
        unknowns_(grip_.unknowns(mesh, internal_begin_ + 2 * static_cast<int>(mesh.cells.size()),
                                 symmetry_ ? &*symmetry_ : nullptr)),
        assembler_(unknowns_, effects_.list),
        system_{assembler_, cholesky_, Ordering::dissection, {}, 0, 0, {}},
        tension_(parameters.expected_tension),
        begin_(began) {
    if (symmetry_) {
      whole_effects_ = make_effects(mesh, parameters, internal_begin_);
      whole_assembler_.emplace(unknowns_, whole_effects_.list);
    }
    // Dilatation and pressure begin at zero: from the swept positions they would be K times the
    // small volume errors of the sweep.
    Vector x = Vector::Zero(internal_begin_ + 2 * static_cast<int>(mesh.cells.size()));
    const Eigen::Isometry3d to_frame = from_frame_.inverse();
    for (int n = 0; n < mesh.nodes(); ++n) x.segment<3>(3 * n) = to_frame * start[n];
    grip_.move(mesh, start_ebar, x);
    if (symmetry_) symmetry_->impose(mesh, x);
    history_.push_back({start_ebar, std::move(x)});
    determinant_ = knot_determinant(centerline(mesh, newest()));
    system_.advance = [this](Vector& state, const Vector& dx) { advance(state, dx); };
  }

  Vector predict(double ebar) const override {
    const Station& last = history_.back();
    Vector x = last.x;
    if (ebar != last.ebar)
      x = history_.size() > 1 ? extrapolate_sections(mesh_, history_, ebar) : follow_grip(ebar);
    turn_grips(x, last.x);
    hold_grips(x, last.x);
    grip_.move(mesh_, ebar, x);
    if (symmetry_) symmetry_->impose(mesh_, x);
    return x;
  }

  NewtonResult solve(const Vector& guess, double) override {
    NewtonResult result =
        effects_.friction ? solve_with_friction(guess) : solve_frictionless(guess);
    if (result.ok() && knot_determinant(centerline(mesh_, result.x)) != determinant_) {
      result.status = NewtonStatus::rejected;
      result.reason = "a strand has passed through another";
    }
    return result;
  }

  NewtonResult solve_frictionless(const Vector& guess) {
    NewtonResult result = newton(system_, guess, options(), observer_);
    for (int i = 0; result.ok() && effects_.contact && i < max_stiffenings; ++i) {
      if (!stiffen_contact()) break;
      result = go_on(std::move(result));
    }
    return result;
  }

  /// Normal forces, facing points and tangents are frozen, then taken from the solution, until the
  /// end tension stays. The start is relaxed with friction, too: the shape of a rod with friction
  /// is held by it.
  NewtonResult solve_with_friction(const Vector& guess) {
    NewtonResult result;
    result.x = newest();
    double tension = 0;
    for (int pass = 0; pass < max_friction_passes; ++pass) {
      effects_.contact->refresh(result.x);
      frozen_at_ = result.x;
      effects_.friction->freeze(frozen_at_, newest());
      if (pass == 0) {
        result = newton(system_, guess, options(), observer_);
      } else {
        stiffen_contact();
        result = go_on(std::move(result));
      }
      if (!result.ok()) return result;
      const double last = tension;
      tension = grip_.tension(mesh_, result.x, result.gradient).finish;
      if (pass > 0 && std::abs(tension - last) < friction_settled * std::abs(tension) &&
          effects_.contact->max_penetration() <= parameters_.penetration)
        return result;
    }
    result.status = NewtonStatus::too_many_iterations;
    result.reason = "friction does not settle";
    return result;
  }

  StepRow accept(const NewtonResult& result, double ebar) override {
    const Vector before = newest();
    // A turn of the path or a state at the same ebar gives no rate to go on with.
    if (history_.back().ebar == ebar) history_.pop_back();
    if (history_.size() > 1 &&
        (ebar - history_.back().ebar) * (history_.back().ebar - history_.front().ebar) < 0)
      history_.erase(history_.begin(), history_.end() - 1);
    if (history_.size() == kept_states) history_.erase(history_.begin());
    history_.push_back({ebar, result.x});
    gradient_ = result.gradient;

    // Of a symmetric knot, half was solved; the whole is measured, without using the symmetry.
    StepRow row;
    Vector gradient = result.gradient;
    row.energy = result.energy;
    if (symmetry_) {
      if (effects_.contact) whole_effects_.contact->law() = effects_.contact->law();
      if (effects_.friction) {
        whole_effects_.contact->refresh(frozen_at_);
        whole_effects_.friction->freeze(frozen_at_, before);
      }
      whole_assembler_->refresh(newest());
      row.energy = whole_assembler_->assemble(newest(), Order::gradient, gradient);
    }
    const auto tension = grip_.tension(mesh_, newest(), gradient);
    tension_ = std::max(std::abs(tension.finish), 1e-6);
    row.ebar = ebar;
    row.tension = 0.5 * (tension.finish + tension.start);
    row.residual = largest_inner(gradient) / tension_;
    row.reaction_mismatch = std::abs(tension.finish - tension.start) / tension_;
    row.min_jacobian = 1;
    for (int cell = 0; cell < effects_.strain->cells(); ++cell)
      row.min_jacobian =
          std::min(row.min_jacobian, effects_.strain->stress(newest(), cell).least_jacobian);
    if (effects_.contact) {
      row.max_penetration = whole().contact->max_penetration();
      row.contact_pairs = whole().contact->stencils();
    }
    if (effects_.friction) {
      // The potential of a step counts what sliding has cost; energy is what is still there.
      Friction& friction = *whole().friction;
      row.energy += friction.stored(newest()) -
                    (symmetry_ ? *whole_assembler_ : assembler_).energy_by_effect().at("friction");
      friction.accept(newest());
      if (symmetry_) effects_.friction->accept(newest());
      row.dissipated = friction.dissipated();
    }
    row.end_torque = tension.torque;
    row.end_turn = grip_.turn(mesh_, newest());
    row.wall_s = std::chrono::duration<double>(Clock::now() - begin_).count();
    return row;
  }

  SolidState state(double ebar) {
    SolidState s = fields(mesh_, whole(), newest());
    // Seen from the clamped start.
    const Eigen::Isometry3d seen =
        from_frame_ * Eigen::AngleAxisd(-grip_.start_turn(mesh_, newest()), Vector3::UnitZ());
    for (Polyline* points : {&s.nodes, &s.centerline})
      for (Vector3& p : *points) p = seen * p;
    s.ebar = ebar;
    s.tension = tension_;
    s.energy_by_effect = (symmetry_ ? *whole_assembler_ : assembler_).energy_by_effect();
    if (effects_.friction) s.energy_by_effect["friction"] = whole().friction->stored(newest());
    return s;
  }

  /// The first state has no rate to go on with, but a tangent that is not saved.
  bool can_be_saved() const { return history_.size() > 1; }

  SolidCheckpoint saved() const {
    SolidCheckpoint at;
    at.history = history_;
    at.tension = tension_;
    at.wall_s = std::chrono::duration<double>(Clock::now() - begin_).count();
    if (effects_.contact) at.contact_stiffness = effects_.contact->law().stiffness;
    if (effects_.friction) at.friction = effects_.friction->memory();
    if (symmetry_ && effects_.friction) at.whole_friction = whole_effects_.friction->memory();
    return at;
  }

  void restore(const SolidCheckpoint& at) {
    history_ = at.history;
    tension_ = at.tension;
    if (effects_.contact) effects_.contact->law().stiffness = at.contact_stiffness;
    if (effects_.friction) effects_.friction->remember(at.friction);
    if (symmetry_ && effects_.friction) whole_effects_.friction->remember(at.whole_friction);
  }

  int unknowns() const { return unknowns_.size(); }
  bool symmetric() const { return symmetry_.has_value(); }
  const EffectList& effects() const { return effects_.list; }
  const std::map<std::string, double>& seconds() const { return system_.seconds; }
  void observe(NewtonObserver observer) { observer_ = std::move(observer); }

 private:
  const Vector& newest() const { return history_.back().x; }
  const SolidEffects& whole() const { return symmetry_ ? whole_effects_ : effects_; }

  /// Largest out-of-balance force on a node between the grips [E D^2].
  double largest_inner(const Vector& gradient) const {
    double largest = 0;
    for (int n = mesh_.node(1, 0); n < mesh_.node(mesh_.layers() - 1, 0); ++n)
      for (int c = 3 * n; c < 3 * n + 3; ++c)
        if (unknowns_.index(c) >= 0 || symmetry_)
          largest = std::max(largest, std::abs(gradient[c]));
    return largest;
  }

  /// The model works in a frame with the pulling axis along z and z = 0 halfway between the ends; a
  /// symmetry axis lies along x.
  static Eigen::Isometry3d frame(const Mesh& mesh, const std::vector<Vector3>& start,
                                 const std::optional<TwoFold>& symmetry) {
    Eigen::Isometry3d from = Eigen::Isometry3d::Identity();
    if (symmetry) {
      from.translate(symmetry->origin());
      from.rotate(Eigen::AngleAxisd(symmetry->angle(), Vector3::UnitZ()));
    } else {
      Vector3 halfway = Vector3::Zero();
      for (int p = 0; p < mesh.points_per_layer(); ++p)
        halfway += (start[mesh.node(0, p)] + start[mesh.node(mesh.layers() - 1, p)]) /
                   (2 * mesh.points_per_layer());
      from.translate(halfway);
    }
    return from;
  }

  /// Without friction the knot may slide along the rod and, where the finish turns, revolve about
  /// the pulling axis while the rod rolls about its own, at no cost but what the mesh is uneven by.
  /// A symmetry excludes all three. Without one, each is stopped at the middle section: its centre
  /// along z and across its radius, and a point of its x axis sideways. A choice of place and
  /// angles among equals; what the pin along z carries is seen as a difference of the end tensions.
  static Grip make_grip(const Mesh& mesh, const std::vector<Vector3>& start,
                        const SolidParameters& parameters, bool symmetric) {
    constexpr double off_axis = 0.3;  // of a section that can be pinned [D]
    Grip grip{parameters.finish_turns, false, {}};
    if (symmetric) {
      grip.start_turns = parameters.finish_turns;
      return grip;
    }
    const auto centre = [&](int layer) { return start[mesh.node(layer, mesh.section.centre[0])]; };
    const auto radius = [&](int layer) { return Vector2((centre(layer) - centre(0)).head<2>()); };
    int layer = mesh.layers() / 2;
    if (radius(layer).norm() < off_axis)
      for (int k = 0; k < mesh.layers(); ++k)
        if (radius(k).norm() > radius(layer).norm()) layer = k;
    if (radius(layer).norm() < off_axis || parameters.friction > 0) return grip;
    const int at = 3 * mesh.node(layer, mesh.section.centre[0]);
    grip.pinned = {at + 2};
    if (!parameters.finish_turns) return grip;
    const Vector2 r = radius(layer).cwiseAbs();
    grip.pinned.push_back(at + (r.x() > r.y() ? 1 : 0));

    int outermost = mesh.section.rim[0];
    for (int p : mesh.section.rim)
      if (mesh.section.points[p].x() > mesh.section.points[outermost].x() + 1e-9) outermost = p;
    const int point = mesh.node(layer, outermost);
    const Vector3 tangent = centre(layer + 1) - centre(layer - 1);
    const Vector3 sideways = tangent.cross(start[point] - centre(layer)).cwiseAbs();
    int axis = 0;
    sideways.maxCoeff(&axis);
    grip.pinned.push_back(3 * point + axis);
    grip.start_turns = true;
    return grip;
  }

  NewtonOptions options() const {
    NewtonOptions options;
    options.max_iterations = max_iterations;
    options.force_tolerance = force_tolerance * tension_;
    options.energy_tolerance = energy_tolerance * tension_;
    options.largest_move = parameters_.largest_move;
    options.shift_decay = shift_decay;
    options.bound.first_rise = energy_rise * tension_;
    return options;
  }

  /// Where strands overlap more than they may; false where they do not.
  bool stiffen_contact() {
    const double overlap = effects_.contact->max_penetration();
    if (overlap <= parameters_.penetration) return false;
    effects_.contact->law().stiffness *=
        std::clamp(1.5 * overlap / parameters_.penetration, 1.5, 4.0);
    return true;
  }

  /// Solves on from a solution after something has changed; counts on, too.
  NewtonResult go_on(NewtonResult solved) {
    NewtonResult result = newton(system_, std::move(solved.x), options(), observer_);
    result.iterations += solved.iterations;
    result.factorisations += solved.factorisations;
    return result;
  }

  /// Sections move rigidly through the exponential map, turned ends about their axis.
  void advance(Vector& x, const Vector& dx) const {
    const Vector before = x;
    advance_sections(mesh_, x, dx);
    turn_grips(x, before);
    hold_grips(x, before);
    if (symmetry_) symmetry_->impose(mesh_, x);
  }

  /// Turned ends as their angles say.
  void turn_grips(Vector& x, const Vector& from) const {
    Vector turned = from;
    unknowns_.advance(turned, x - from);
    for (const Turn& turn : unknowns_.turns())
      for (int first : turn.carried) x.segment<3>(first) = turned.segment<3>(first);
  }

  /// Held coordinates exactly as they were.
  void hold_grips(Vector& x, const Vector& as) const {
    for (int c = 0; c < unknowns_.coordinates(); ++c)
      if (unknowns_.index(c) < 0 && unknowns_.turn_of(c) < 0) x[c] = as[c];
  }

  /// Tangent predictor: the linear answer of the last tangent to the motion of the ends.
  Vector follow_grip(double ebar) const {
    const Station& last = history_.back();
    constexpr double probe = 1e-6;  // [D]
    const double de = ebar - last.ebar;
    Vector moved = last.x, gradient;
    const double towards = de > 0 ? probe : -probe;
    grip_.move(mesh_, last.ebar + towards, moved);
    assembler_.assemble(moved, Order::gradient, gradient);
    const Vector rate =
        (unknowns_.reduce(moved, gradient) - unknowns_.reduce(last.x, gradient_)) / towards;
    const Vector step = -de * cholesky_.solve(rate);
    Vector x = last.x;
    advance(x, unknowns_.expand(x, step));
    return x;
  }

  const Mesh& mesh_;
  const SolidParameters& parameters_;
  std::optional<TwoFold> symmetry_;  ///< then one half is simulated
  Eigen::Isometry3d from_frame_;     ///< of the model, to where the start was given
  Grip grip_;
  int internal_begin_;
  SolidEffects effects_;
  Unknowns unknowns_;
  mutable Assembler assembler_;
  SparseCholesky cholesky_;
  System system_;
  double tension_;
  int determinant_ = 0;
  SolidEffects whole_effects_;  ///< of a symmetric knot, to measure with
  std::optional<Assembler> whole_assembler_;
  Vector frozen_at_;              ///< where friction's spots were taken from
  std::vector<Station> history_;  ///< the last accepted states, newest last
  Vector gradient_;               ///< by coordinates, at the newest
  NewtonObserver observer_;
  Clock::time_point begin_;
};

/// The model that follow() sees. At every checkpoint it is built anew from what is saved, so that
/// nothing that a resumed run would not have (lists of contact pairs, patterns, orderings) decides
/// about the last digits of the steps to come.
class RenewedPath final : public PathModel {
 public:
  using Build = std::function<std::unique_ptr<SolidPath>()>;
  explicit RenewedPath(Build build) : build_(std::move(build)), model_(build_()) {}

  Vector predict(double ebar) const override { return model_->predict(ebar); }
  NewtonResult solve(const Vector& guess, double ebar) override {
    return model_->solve(guess, ebar);
  }
  StepRow accept(const NewtonResult& result, double ebar) override {
    return model_->accept(result, ebar);
  }

  SolidPath& model() { return *model_; }
  void renew(const SolidCheckpoint& from) {
    for (const auto& [phase, time] : model_->seconds()) seconds_[phase] += time;
    model_ = build_();
    model_->restore(from);
  }
  std::map<std::string, double> seconds() const {
    std::map<std::string, double> sum = seconds_;
    for (const auto& [phase, time] : model_->seconds()) sum[phase] += time;
    return sum;
  }

 private:
  Build build_;
  std::unique_ptr<SolidPath> model_;
  std::map<std::string, double> seconds_;  ///< of models that were replaced
};

}  // namespace

SolidResult run_solid(const Mesh& mesh, const std::vector<Vector3>& start, double start_ebar,
                      const SolidParameters& parameters, const SolidObserver& observer,
                      const SolidCheckpoint* from) {
  SolidResult result;
  const std::chrono::duration<double> before(from ? from->wall_s : 0);
  const auto began = Clock::now() - std::chrono::duration_cast<Clock::duration>(before);
  RenewedPath path_model([&] {
    auto model = std::make_unique<SolidPath>(mesh, start, start_ebar, parameters, began);
    model->observe(observer.on_iteration);
    return model;
  });
  if (from) path_model.model().restore(*from);
  result.unknowns = path_model.model().unknowns();
  result.cells = static_cast<int>(mesh.cells.size());
  result.symmetric = path_model.model().symmetric();
  for (const auto& effect : path_model.model().effects())
    result.effects.emplace_back(effect->name());

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
    observer.on_record(path_model.model().state(ebar));
  };
  on_path.on_progress = [&](const PathProgress& progress) {
    // The first as early as can be: relaxing the start is long.
    if (parameters.checkpoint_every == 0 || progress.so_far.steps < 2 ||
        (progress.so_far.steps - 2) % parameters.checkpoint_every != 0 ||
        !path_model.model().can_be_saved())
      return;
    SolidCheckpoint at = path_model.model().saved();
    at.progress = progress;
    observer.on_checkpoint(at);
    path_model.renew(at);
  };
  on_path.interrupted = observer.interrupted;
  result.outcome = follow(path, path_model, on_path, from ? from->progress : PathProgress{});
  result.seconds = path_model.seconds();
  return result;
}

}  // namespace bight::solid3d
