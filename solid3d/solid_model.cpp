#include "solid3d/solid_model.h"

#include <algorithm>
#include <cmath>

#include "mechanics/knot_type.h"
#include "mechanics/timed.h"
#include "solid3d/measure.h"
#include "solid3d/section_motion.h"
#include "solid3d/travelling_guess.h"

namespace bight::solid3d {

namespace {

/// Motion of a node against that of the ends that a tangent can be trusted with.
constexpr double most_by_grip = 10;
constexpr size_t kept_states = 3;  ///< for the predictor
/// End tension [E D^2] of a start that takes the whole first penalty. A looser one takes less in
/// proportion: the same overlap, and as many samples to share the load.
constexpr double full_load = 6e-3;
/// Part of the bound that the next step's largest overlap is to have; factor by which contact is
/// made stiffer for that, at most.
constexpr double aimed_overlap = 0.75, most_ahead = 2;

}  // namespace

SolidModel::SolidModel(const Mesh& mesh, const std::vector<Vector3>& start, double start_ebar,
                       const SolidParameters& parameters, Clock::time_point began)
    : mesh_(mesh),
      parameters_(parameters),
      start_ebar_(start_ebar),
      symmetry_(parameters.symmetry && parameters.gravity == Vector3::Zero()
                    ? TwoFold::find(mesh, start)
                    : std::nullopt),
      from_frame_(frame(mesh, start, symmetry_)),
      grip_(make_grip(mesh, start, parameters, symmetry_)),
      internal_begin_(grip_.coordinates(mesh)),
      effects_(make_effects(mesh, parameters, internal_begin_,
                            symmetry_ ? symmetry_->first_layer() : 0)),
      unknowns_(grip_.unknowns(mesh, internal_begin_ + effects_.strain->internals(),
                               symmetry_ ? &*symmetry_ : nullptr)),
      assembler_(unknowns_, effects_.list),
      system_{assembler_, cholesky_, Ordering::dissection, {}, 0, 0, {}},
      tension_(parameters.expected_tension),
      begin_(began) {
  if (effects_.contact) effects_.contact->law().stiffness *= std::min(1.0, tension_ / full_load);
  if (symmetry_) {
    whole_effects_ = make_effects(mesh, parameters, internal_begin_);
    whole_assembler_.emplace(unknowns_, whole_effects_.list);
  }
  // Dilatation and pressure begin at zero: from the swept positions they would be K times the
  // small volume errors of the sweep.
  Vector x = Vector::Zero(internal_begin_ + effects_.strain->internals());
  const Eigen::Isometry3d to_frame = from_frame_.inverse();
  for (int n = 0; n < mesh.nodes(); ++n) x.segment<3>(3 * n) = to_frame * start[n];
  grip_.move(mesh, start_ebar, x);
  if (symmetry_) symmetry_->impose(mesh, x);
  history_.push_back({start_ebar, std::move(x)});
  determinant_ = knot_determinant(centerline(mesh, newest()));
  take_over(parameters.rubs);
  system_.advance = [this](Vector& state, const Vector& dx) { advance(state, dx); };
}

/// Friction of the start, given in the axes of the start.
void SolidModel::take_over(std::vector<Rub> rubs) {
  for (Rub& rub : rubs) rub.elastic_slip = from_frame_.linear().transpose() * rub.elastic_slip;
  for (SolidEffects* effects : {&effects_, &whole_effects_}) {
    if (rubs.empty() || !effects->friction) continue;
    effects->contact->refresh(newest());
    effects->friction->prescribe(rubs, newest());
  }
}

Vector SolidModel::predict(double ebar) const {
  const Station& last = history_.back();
  if (parameters_.inertia && !relaxing_) return last.x;
  if (ebar == last.ebar) return held(last.x, ebar);
  return held(history_.size() > 1 ? extrapolate_sections(mesh_, history_, ebar) : follow_grip(ebar),
              ebar);
}

/// The ends of a guess where they are to be.
Vector SolidModel::held(Vector x, double ebar) const {
  turn_grips(x, newest());
  hold_grips(x, newest());
  grip_.move(mesh_, ebar, x);
  if (symmetry_) symmetry_->impose(mesh_, x);
  return x;
}

/// The guess of least energy. Where the path is not smooth (strands slip over a coarse mesh) the
/// last two states foretell more than the last three. Friction counts as if its limits stayed.
Vector SolidModel::best_guess(const Vector& guess, double ebar) {
  if (ebar == history_.back().ebar) return guess;
  const Timed timed(system_.seconds["guess"]);
  if (effects_.friction) rubbing_.freeze_last();
  if (history_.size() < 2) {
    const Vector sliding =
        held(sliding_guess(mesh_, newest(), held(newest(), ebar), internal_begin_), ebar);
    return energy(sliding) < energy(guess) ? sliding : guess;
  }
  const std::vector<Station> two(history_.end() - 2, history_.end());
  const Vector straight = held(extrapolate_sections(mesh_, two, ebar), ebar);
  const Vector travelling =
      held(travelling_guess(mesh_, two, ebar, straight, internal_begin_), ebar);
  const Vector* best = &guess;
  double least = energy(guess);
  for (const Vector* other : {&straight, &travelling})
    if (const double its = energy(*other); its < least) best = other, least = its;
  return *best;
}

double SolidModel::energy(const Vector& x) {
  assembler_.refresh(x);
  return assembler_.energy(x);
}

StepRow SolidModel::accept(const NewtonResult& result, double ebar) {
  if (motion_) return moved_;
  const Equilibrium before{history_.back().ebar, energy_, tension_};
  const bool first = relaxing_;
  StepRow row = take(result, ebar);
  if (!first && !parameters_.friction && ebar != before.ebar)
    row.snapped = energy_lost(before, {ebar, energy_, tension_});
  // No polynomial goes through a snap.
  if (row.snapped > 0) history_.erase(history_.begin(), history_.end() - 1);
  stiffen_ahead(tension_ / before.tension);
  return row;
}

/// Contact as stiff as the next step will need it, if its load grows as that of this one did: a
/// solve with too large an overlap is one for nothing.
void SolidModel::stiffen_ahead(double growth) {
  if (!effects_.contact) return;
  const double overlap = effects_.contact->max_penetration() * growth;
  effects_.contact->law().stiffness *=
      std::clamp(overlap / (aimed_overlap * parameters_.penetration), 1.0, most_ahead);
}

StepRow SolidModel::take(const NewtonResult& result, double ebar) {
  const Timed timed(system_.seconds["measure"]);
  const Vector before = newest();
  relaxing_ = false;
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
    freeze_whole(before);
    whole_assembler_->refresh(newest());
    row.energy = whole_assembler_->assemble(newest(), Order::gradient, gradient);
  }
  const auto tension = grip_.tension(mesh_, newest(), gradient);
  tension_ = std::max(std::abs(tension.finish), 1e-6);
  row.ebar = ebar;
  row.tension = 0.5 * (tension.finish + tension.start);
  row.residual = largest_inner(gradient) / tension_;
  row.reaction_mismatch = std::abs(tension.finish - tension.start) / tension_;
  row.min_jacobian = effects_.strain->least_jacobian(newest());
  if (effects_.contact) {
    row.max_penetration = whole().contact->max_penetration();
    row.contact_pairs = whole().contact->stencils();
  }
  if (effects_.friction) {
    // The potential of a step counts what sliding has cost; energy is what is still there.
    const Friction& friction = *whole().friction;
    accept_friction(newest());
    row.energy += friction.stored(newest()) -
                  (symmetry_ ? *whole_assembler_ : assembler_).energy_by_effect().at("friction");
    row.dissipated = friction.dissipated();
  }
  energy_ = row.energy;
  row.end_torque = tension.torque;
  row.end_turn = grip_.turn(mesh_, newest());
  row.wall_s = std::chrono::duration<double>(Clock::now() - begin_).count();
  return row;
}

void SolidModel::freeze_whole(const Vector& last) {
  if (!symmetry_ || !effects_.friction) return;
  whole_effects_.contact->refresh(rubbing_.frozen_at());
  whole_effects_.friction->freeze(rubbing_.frozen_at(), last);
}

void SolidModel::accept_friction(const Vector& x) {
  effects_.friction->accept(x);
  if (symmetry_) whole_effects_.friction->accept(x);
}

SolidState SolidModel::state(double ebar) {
  SolidState s = fields(mesh_, whole(), newest());
  // Seen from the clamped start.
  const Eigen::Isometry3d seen =
      from_frame_ * Eigen::AngleAxisd(-grip_.start_turn(mesh_, newest()), Vector3::UnitZ());
  for (Polyline* points : {&s.nodes, &s.centerline})
    for (Vector3& p : *points) p = seen * p;
  s.ebar = ebar;
  s.tension = tension_;
  s.energy_by_effect = (symmetry_ ? *whole_assembler_ : assembler_).energy_by_effect();
  if (effects_.friction) {
    s.energy_by_effect["friction"] = whole().friction->stored(newest());
    s.rubs = whole().friction->rubs(newest());
    for (Rub& rub : s.rubs) rub.elastic_slip = seen.linear() * rub.elastic_slip;
  }
  if (motion_) s.energy_by_effect["inertia"] = motion_->kinetic_energy();
  return s;
}

SolidCheckpoint SolidModel::saved() const {
  SolidCheckpoint at;
  at.history = history_;
  at.tension = tension_;
  at.energy = energy_;
  at.wall_s = std::chrono::duration<double>(Clock::now() - begin_).count();
  if (motion_) at.motion = motion_->now();
  if (effects_.contact) at.contact_stiffness = effects_.contact->law().stiffness;
  if (effects_.friction) at.friction = effects_.friction->memory();
  if (symmetry_ && effects_.friction) at.whole_friction = whole_effects_.friction->memory();
  return at;
}

void SolidModel::restore(const SolidCheckpoint& at) {
  relaxing_ = false;
  history_ = at.history;
  tension_ = at.tension;
  energy_ = at.energy;
  if (effects_.contact) effects_.contact->law().stiffness = at.contact_stiffness;
  if (effects_.friction) effects_.friction->remember(at.friction);
  if (symmetry_ && effects_.friction) whole_effects_.friction->remember(at.whole_friction);
  if (at.motion) set_in_motion(*at.motion);
}

double SolidModel::largest_inner(const Vector& gradient) const {
  double largest = 0;
  for (int n = mesh_.node(1, 0); n < mesh_.node(mesh_.layers() - 1, 0); ++n)
    for (int c = 3 * n; c < 3 * n + 3; ++c)
      if (unknowns_.index(c) >= 0 || symmetry_) largest = std::max(largest, std::abs(gradient[c]));
  return largest;
}

Eigen::Isometry3d SolidModel::frame(const Mesh& mesh, const std::vector<Vector3>& start,
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

Grip SolidModel::make_grip(const Mesh& mesh, const std::vector<Vector3>& start,
                           const SolidParameters& parameters,
                           const std::optional<TwoFold>& symmetry) {
  constexpr double off_axis = 0.3;  // of a section that can be pinned [D]
  Grip grip{parameters.finish_turns, false, {}};
  if (symmetry) {
    if (symmetry->kind() == TwoFold::Kind::inversion) return {false, false, {}};
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
  // Weight says where the knot hangs.
  if (!parameters.finish_turns || parameters.gravity != Vector3::Zero()) return grip;
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

void SolidModel::advance(Vector& x, const Vector& dx) const {
  const Vector before = x;
  advance_sections(mesh_, x, dx);
  turn_grips(x, before);
  hold_grips(x, before);
  if (symmetry_) symmetry_->impose(mesh_, x);
}

void SolidModel::turn_grips(Vector& x, const Vector& from) const {
  Vector turned = from;
  unknowns_.advance(turned, x - from);
  for (const Turn& turn : unknowns_.turns())
    for (int first : turn.carried) x.segment<3>(first) = turned.segment<3>(first);
}

void SolidModel::hold_grips(Vector& x, const Vector& as) const {
  for (int c = 0; c < unknowns_.coordinates(); ++c)
    if (unknowns_.index(c) < 0 && unknowns_.turn_of(c) < 0) x[c] = as[c];
}

Vector SolidModel::follow_grip(double ebar) const {
  const Station& last = history_.back();
  constexpr double probe = 1e-6;  // [D]
  const double de = ebar - last.ebar;
  Vector moved = last.x, gradient;
  const double towards = de > 0 ? probe : -probe;
  grip_.move(mesh_, last.ebar + towards, moved);
  assembler_.assemble(moved, Order::gradient, gradient);
  const Vector rate =
      (unknowns_.reduce(moved, gradient) - unknowns_.reduce(last.x, gradient_)) / towards;
  const Vector dx = unknowns_.expand(last.x, -de * cholesky_.solve(rate));
  // Of a knot that slides everywhere the tangent is nearly singular: its answer tells nothing.
  if (!(dx.head(internal_begin_).cwiseAbs().maxCoeff() < most_by_grip * std::abs(de)))
    return last.x;
  Vector x = last.x;
  advance(x, dx);
  return x;
}

}  // namespace bight::solid3d
