#include "rod1d/rod_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "mechanics/coupled_newton.h"
#include "mechanics/knot_type.h"
#include "rod1d/grip.h"
#include "rod1d/knot_mesh.h"
#include "rod1d/measure.h"
#include "rod1d/pin.h"
#include "rod1d/polyline.h"
#include "rod1d/remesh.h"
#include "rod1d/rod_state.h"

namespace bight::rod1d {

namespace {

/// Accepted states through which the next one is extrapolated, at most, and those kept for it.
constexpr size_t most_extrapolated = 4, kept = 12;
/// Iterations of a solve after which the next guess is looked at more closely.
constexpr int hard_iterations = 8;
/// Steps in ebar below this are no steps.
constexpr double same_ebar = 1e-9;
/// Overlap of a start's strands, at most [D].
constexpr double largest_start_overlap = 0.5;
/// Share of the allowed overlap that the contact stiffness aims at.
constexpr double aimed_share = 0.6;
/// Points of a start that is to be meshed, per diameter and in all.
constexpr double start_points = 10;
constexpr int most_start_points = 20000;
/// Part of the way that the nodes go in one step towards where they are wished.
constexpr double mesh_pull = 0.3;
/// Smallest part of the energy whose loss is a snap.
constexpr double snap_energy = 2e-3;
/// Times that the nodes are chosen anew at the first equilibrium.
constexpr int first_meshes = 3;
/// Wished places are found from about this many nodes.
constexpr int mesh_points = 500;
/// Whiles of motion by which a failed solve is helped on, at most.
constexpr int most_motions = 20;
/// By which a state that weight would leave is turned first, so that it does [rad].
constexpr double slight_roll = 0.05;
/// Solves of one step with contact stiffness and friction taken anew, at most.
constexpr int max_passes = 12;
/// Residual over the force scale up to which a search that cannot go on has converged.
constexpr double stalled_residual = 1e-3;
/// Share of the tension that further solves may still change when friction has settled.
constexpr double settled_change = 5e-4;
/// Iterations with the last state's friction, which bring contact forces into range (where a few do
/// not, many), and those with the whole tangent, at most.
constexpr int few_first = 2, many_first = 30, most_coupled = 12;

/// Tension of a loose overhand knot, T = 2 pi^2 B/ebar^2 (Audoly et al. 2007): the scale of forces
/// before there is a first equilibrium [E D^2].
double loose_tension(const Rod& rod, double ebar) {
  const double e = std::max(ebar, 10.0);
  return 2 * std::numbers::pi * std::numbers::pi * rod.bending_stiffness / (e * e);
}

Rod free_rod(const RodParameters& parameters) {
  Rod rod = uniform_rod(parameters.length, parameters.segments, parameters.poissons_ratio);
  rod.stretching_stiffness *= parameters.stretch_stiffness_factor;
  bend_naturally(rod, parameters.natural_curvature, parameters.natural_twist);
  return rod;
}

Vector coordinates_of(const Rod& rod, const Polyline& nodes, int angles) {
  Vector x = Vector::Zero(3 * rod.nodes() + angles);
  for (int i = 0; i < rod.nodes(); ++i) x.segment<3>(Rod::position(i)) = nodes[i];
  return x;
}

}  // namespace

/// What has to be set up anew when other coordinates are held.
struct RodModel::Equations {
  Unknowns unknowns;
  Assembler assembler;
  SparseCholesky cholesky;
  System system;

  Equations(const std::vector<int>& blocks, const std::vector<bool>& held,
            const std::vector<Image>& images, const EffectList& effects)
      : unknowns(blocks, static_cast<int>(held.size()), held, {}, images),
        assembler(unknowns, effects),
        system{assembler, cholesky, Ordering::minimum_degree,
               [this](Vector& x, const Vector& dx) { unknowns.advance(x, dx); }} {}
};

RodModel::RodModel(const RodParameters& parameters, const Polyline& start)
    : parameters_(parameters),
      follows_(parameters.follow_knot && !parameters.inertia && parameters.natural_curvature == 0 &&
               parameters.natural_twist == 0),
      rod_(free_rod(parameters)),
      length_(parameters.length),
      effects_(make_effects(rod_, parameters, source_)),
      began_(std::chrono::steady_clock::now()) {
  Polyline line = chord_on_axis(start);
  if (parameters.symmetry && rod_.straight() && !parameters.inertia && !weighs())
    symmetry_ = TwoFold::find(line, parameters.segments);
  // A turn of one end against the other is no inversion's image.
  if (inverts() && parameters.finish_turn != 0) symmetry_.reset();
  line = meshed(line);
  start_ebar_ = length_ - (line.back() - line.front()).norm();
  determinant_ = knot_determinant(line);
  force_scale_ = loose_tension(rod_, start_ebar_);
  stiffness_ = 4 * force_scale_ / (aimed_share * parameters.penetration);
  Vector x = coordinates_of(rod_, line, angles());
  place_grips(rod_, end_to_end(start_ebar_), x);
  if (symmetry_) symmetry_->impose(x);
  refuse_overlap(x);
  refuse_other_knot(knot_determinant(start));
  if (parameters.twist) source_ = twist_free_frames(rod_, x);
  if (parameters.twist && symmetry_) symmetry_->align(source_);
  history_ = {x, source_, {}};
  accepted_.push_back({start_ebar_, rod_.arc_length(), x});
  halve();
  choose_pin();
  set_equations();
}

/// Strands nearer than half a diameter could be pushed out on either side of each other.
void RodModel::refuse_overlap(const Vector& x) {
  if (!effects_.contact) return;
  effects_.contact->refresh(x);
  const double overlap = effects_.contact->touching(x).second;
  if (overlap > largest_start_overlap)
    throw std::invalid_argument("strands of the start, cut into " +
                                std::to_string(rod_.segments()) + " segments, overlap by " +
                                std::to_string(overlap) +
                                " D; which of them belongs on which side is not known");
}

/// Chords may cut through other strands. A determinant of 0 means that they meet.
void RodModel::refuse_other_knot(int given) const {
  if (given == 0) throw std::invalid_argument("the start meets itself: its knot is not known");
  if (determinant_ != given)
    throw std::invalid_argument("the start, of determinant " + std::to_string(given) +
                                ", cut into " + std::to_string(rod_.segments()) +
                                " segments is another knot, of determinant " +
                                std::to_string(determinant_));
}

/// The start cut into the rod's segments, whose undeformed lengths it fixes.
Polyline RodModel::meshed(const Polyline& start) {
  if (!follows_) return resampled(start, parameters_.segments);
  const int points = std::min(most_start_points, static_cast<int>(start_points * length_) + 1);
  const Polyline fine = resampled(start, points);
  std::vector<double> arc;
  for (int i = 0; i <= points; ++i) arc.push_back(length_ * i / points);
  std::vector<double> nodes = spread_nodes(arc, wished_lengths(arc, fine), parameters_.segments,
                                           middle_node(), 0.5 * length_);
  if (symmetry_) symmetry_->impose(nodes);
  set_arc(nodes);
  return points_at(arc, fine, nodes);
}

/// Gives the rod other undeformed lengths, and makes its effects anew.
void RodModel::set_arc(const std::vector<double>& arc) {
  for (int i = 0; i < rod_.segments(); ++i) rod_.rest_length[i] = arc[i + 1] - arc[i];
  const auto law = effects_.contact ? effects_.contact->law() : ContactLaw{};
  effects_ = make_effects(rod_, parameters_, source_);
  if (effects_.contact) effects_.contact->set_law(law);
  halve();
}

/// Of a symmetric rod, half the stencils are summed; friction takes half the contact points.
void RodModel::halve() {
  halves_.clear();
  if (!symmetry_) return;
  for (const auto& effect : effects_.list)
    halves_.push_back(
        std::make_unique<HalfEffect>(*effect, *symmetry_, effect.get() == effects_.friction));
}

/// The accepted state that the next solve starts from, on its nodes.
void RodModel::put_before_on(const std::vector<double>& arc) {
  const std::vector<double>& last = accepted_.back().arc;
  before_.x = remeshed(last, history_.x, arc);
  place_grips(rod_, end_to_end(accepted_.back().ebar), before_.x);
  if (symmetry_) symmetry_->impose(before_.x);
  before_.frames = remeshed(last, history_.frames, arc, before_.x);
  if (symmetry_) symmetry_->impose(before_.frames);
  keep_twist(last, history_.x, history_.frames, arc, before_.frames, before_.x);
}

void RodModel::keep_twist(const std::vector<double>& arc, const Vector& x, const Frames& frames,
                          const std::vector<double>& wanted, const Frames& frames_wanted,
                          Vector& x_wanted) const {
  if (!symmetry_) {
    rod1d::keep_twist(arc, x, frames, wanted, frames_wanted, 0, true, !finish_turns_, x_wanted);
    return;
  }
  if (inverts()) {
    rod1d::keep_twist(arc, x, frames, wanted, frames_wanted, 0, true, false, x_wanted);
    symmetry_->impose(x_wanted);
    return;
  }
  // Opposite angles before and behind the middle node, with its twist between them.
  const int before = middle_node() - 1;
  Vector twisted = x_wanted;
  rod1d::keep_twist(arc, x, frames, wanted, frames_wanted, before, false, false, twisted);
  x_wanted[rod_.angle(before)] =
      0.5 * (twisted[rod_.angle(before)] - twisted[rod_.angle(before + 1)]);
  rod1d::keep_twist(arc, x, frames, wanted, frames_wanted, before, !finish_turns_, false, x_wanted);
  symmetry_->impose(x_wanted);
}

/// Where the nodes of an accepted state are wished; the middle one stays where it is.
std::vector<double> RodModel::wished_arc(const Accepted& at) const {
  const int n = rod_.nodes(), stride = std::max(1, n / mesh_points);
  std::vector<double> arc;
  Polyline line;
  for (int i = 0; i < n; i += i + stride < n || i == n - 1 ? stride : n - 1 - i) {
    arc.push_back(at.arc[i]);
    line.push_back(at.x.segment<3>(Rod::position(i)));
  }
  std::vector<double> nodes = spread_nodes(arc, wished_lengths(arc, line), rod_.segments(),
                                           middle_node(), at.arc[middle_node()]);
  if (symmetry_) symmetry_->impose(nodes);
  return nodes;
}

/// Nodes for the next solve: they go on as they went in the last step (which, unlike polynomials of
/// higher degree, is stable), and a part of the way towards where they are wished.
std::vector<double> RodModel::next_arc(double ebar) const {
  const Accepted& now = accepted_.back();
  if (!follows_ || tension_ == 0 || std::abs(ebar - now.ebar) < same_ebar) return now.arc;
  const std::vector<double> wished = wished_arc(now);
  std::vector<double> arc(now.arc.size(), 0.0);
  for (const auto& [state, weight] : extrapolation(ebar, 2))
    for (size_t i = 0; i < arc.size(); ++i) arc[i] += weight * state->arc[i];
  for (size_t i = 0; i < arc.size(); ++i) arc[i] += mesh_pull * (wished[i] - arc[i]);
  for (size_t i = 0; i + 1 < arc.size(); ++i)
    if (!(arc[i + 1] - arc[i] > 0.5 * (now.arc[i + 1] - now.arc[i]))) return now.arc;
  return arc;
}

RodModel::~RodModel() = default;

/// Two motions cost a round rod without friction nothing, or next to nothing, and would be left to
/// round-off: turning about the axis as a whole, and sliding of the knot along the rod (its energy
/// varies by exp(-tail sqrt(T/B)), less than the discretisation's error). A node far from the axis
/// is held at y = 0 against the first; a turn does no work, so that reaction is zero. If the rod is
/// knotted, the middle node is held along the axis against the second; that reaction is what the
/// ends' tensions differ by, zero for a knot that is symmetric about it.
///
/// When the pinned node comes near the axis another one takes its place, and the states so far are
/// turned until that one is at y = 0: a node that is held beside the axis at a fixed y would turn
/// the knot as it shrinks. Weight makes the knot hang, and a rod that is curved when free is turned
/// by its held start, so that only the second is needed. Friction holds it by itself, and a
/// symmetry too, but for the turn of a knot that is symmetric by inversion.
bool RodModel::choose_pin() {
  const Vector& x = accepted_.back().x;
  const int before = pin_;
  const bool turns = !rubs_ && !turned_by_itself() && (!symmetry_ || inverts());
  int farthest = turns ? farthest_node(rod_, x) : -1;
  if (symmetry_) farthest = std::min(farthest, rod_.segments() - farthest);
  if (before >= 0 && farthest >= 0 && radius_of(x, before) > 0.6 * radius_of(x, farthest))
    return false;
  pin_ = farthest;
  if (pin_ < 0) return before >= 0;
  const Matrix3 by = turn_to_x(accepted_.back().x, pin_);
  for (Accepted& state : accepted_) turn(rod_, by, state.x);
  turn(rod_, by, history_.x);
  turn(by, source_), turn(by, history_.frames);
  return true;
}

void RodModel::set_equations() {
  std::vector<bool> held = held_coordinates(rod_, parameters_.twist, finish_turns_);
  std::vector<Image> images;
  if (symmetry_) {
    images = symmetry_->images(parameters_.twist);
    symmetry_->hold_middle(held);
    if (parameters_.twist && finish_turns_ && !inverts()) held[rod_.angle(0)] = false;
  }
  if (pin_ >= 0) held[Rod::position(pin_) + 1] = true;
  if (turned_by_itself() ? !rubs_ && !symmetry_ : pin_ >= 0 && determinant_ != 1)
    held[Rod::position(middle_node()) + 2] = true;
  std::vector<int> blocks;
  for (int i = 0; i < rod_.nodes(); ++i) blocks.push_back(Rod::position(i));
  for (int i = 0; i < angles(); ++i) blocks.push_back(rod_.angle(i));
  seconds_ = seconds();
  equations_ =
      std::make_unique<Equations>(blocks, held, images, symmetry_ ? halves_ : effects_.list);
}

void RodModel::let_rub() {
  rubs_ = effects_.friction != nullptr;
  choose_pin();
  set_equations();
}

void RodModel::set_tied() {
  if (!parameters_.twist) return;
  finish_angle_ = accepted_.back().x[rod_.angle(rod_.segments() - 1)];
  tied_turn_ = turn_between_ends(accepted_.back().x);
  finish_turns_ = parameters_.finish_turns;
  set_equations();
}

/// dx/debar of the newest state: H dx = -dg/dgrips, with the grips' effect on the gradient g taken
/// by a central difference.
Vector RodModel::tangent(double ebar) const {
  const Accepted& now = accepted_.back();
  Assembler& assembler = equations_->assembler;
  const double h = 1e-5;
  Vector gradient[2], unused;
  for (const int side : {0, 1}) {
    Vector x = now.x;
    place_grips(rod_, end_to_end(now.ebar + (side ? h : -h)), x);
    assembler.refresh(x);
    assembler.assemble(x, Order::gradient, gradient[side]);
  }
  assembler.refresh(now.x);
  assembler.assemble(now.x, Order::hessian, unused);
  const Unknowns& unknowns = equations_->unknowns;
  const Vector change = unknowns.reduce(now.x, (gradient[1] - gradient[0]) / (2 * h));
  SparseCholesky cholesky;
  cholesky.analyse(assembler.hessian(), Ordering::minimum_degree);
  if (!cholesky.factor(assembler.hessian())) return now.x;
  return now.x + (ebar - now.ebar) * unknowns.expand(now.x, -cholesky.solve(change));
}

/// Lagrange's polynomial in ebar through the newest states, `most` of them.
RodModel::Extrapolation RodModel::extrapolation(double ebar, size_t most) const {
  const Accepted& now = accepted_.back();
  // States much closer to each other than to `ebar` would only carry their errors over.
  Extrapolation through{{&now, 1.0}};
  for (auto it = accepted_.rbegin(); it != accepted_.rend() && through.size() < most; ++it)
    if (std::all_of(through.begin(), through.end(), [&](const auto& other) {
          return std::abs(it->ebar - other.first->ebar) > 0.7 * std::abs(ebar - now.ebar);
        }))
      through.push_back({&*it, 1.0});
  for (auto& [state, weight] : through)
    for (const auto& other : through)
      if (state != other.first)
        weight *= (ebar - other.first->ebar) / (state->ebar - other.first->ebar);
  return through;
}

/// Extrapolated node by node, places on the rod and in space alike: what moves with the knot moves
/// little. Then taken at the places where the next nodes are to be.
Vector RodModel::extrapolated(double ebar, size_t most) const {
  const Accepted& now = accepted_.back();
  Vector x = now.x;
  if (tension_ > 0 && std::abs(ebar - now.ebar) > same_ebar) {
    const Extrapolation through = extrapolation(ebar, most);
    std::vector<double> arc(now.arc.size(), 0.0);
    if (through.size() == 1) {
      x = tangent(ebar);
      arc = now.arc;
    } else {
      x.setZero();
      for (const auto& [state, weight] : through) {
        x += weight * state->x;
        for (size_t i = 0; i < arc.size(); ++i) arc[i] += weight * state->arc[i];
      }
    }
    if (follows_) {
      if (!std::is_sorted(arc.begin(), arc.end())) x = now.x, arc = now.arc;
      x = remeshed(arc, x, next_arc(ebar));
    }
  }
  if (pin_ >= 0) turn(rod_, turn_to_x(x, pin_), x);
  place_grips(rod_, end_to_end(ebar), x);
  if (!finish_turns_) x[rod_.angle(rod_.segments() - 1)] = finish_angle_;
  if (!finish_turns_ && symmetry_) x[rod_.angle(0)] = symmetry_->angle_sign() * finish_angle_;
  if (symmetry_) symmetry_->impose(x);
  return x;
}

NewtonResult RodModel::solve_once(const Vector& guess) {
  NewtonOptions options;
  options.max_iterations = tension_ > 0 ? 100 : 500;
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
      result.residual <= stalled_residual * force_scale_)
    result.status = NewtonStatus::converged;
  // A knot that hangs rolls over where its centre of mass comes above the axis: too far for Newton,
  // which may also find the balance in between.
  for (int k = 0; k < most_motions && weighs() && !rubs_; ++k) {
    if (result.ok() && stable(result.x)) break;
    const int iterations = result.iterations, factorisations = result.factorisations;
    result = newton(equations_->system, let_move(rolled(result.x, slight_roll)), options);
    result.iterations += iterations, result.factorisations += factorisations;
  }
  return result;
}

/// Whether the energy rises in every direction from x.
bool RodModel::stable(const Vector& x) {
  Assembler& assembler = equations_->assembler;
  Vector unused;
  assembler.refresh(x);
  assembler.assemble(x, Order::hessian, unused);
  SparseCholesky cholesky;
  cholesky.analyse(assembler.hessian(), Ordering::minimum_degree);
  return cholesky.factor(assembler.hessian());
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
  effects_.friction->set_spots(
      friction_spots(rod_, rubbing_points(rod_, points), x, source_, before_));
}

/// Friction whose limits follow the normal forces, from a guess that is near: Newton steps with the
/// whole tangent, after some with the last state's friction (the contact forces of a guess are too
/// rough to begin with), a few or as many as it takes. The spots are left frozen where it ends.
NewtonResult RodModel::solve_rubbing(const Vector& guess, bool thorough) {
  struct Following final : FollowingForces {
    explicit Following(RodModel& model) : model(model) {}
    void freeze(const Vector& x) override { model.freeze(x); }
    void add_change(const Vector& dx, Vector& gradient) const override {
      model.effects_.friction->add_change(dx, gradient);
    }
    RodModel& model;
  } following(*this);
  NewtonOptions options;
  options.max_iterations = thorough ? many_first : few_first;
  options.energy_tolerance = (thorough ? 1e-5 : 1e-2) * force_scale_;
  options.force_tolerance = (thorough ? 0.01 : 1) * force_scale_;
  options.largest_move = 1;
  freeze(before_.x);
  const NewtonResult begun = newton(equations_->system, guess, options);
  options.max_iterations = most_coupled;
  options.energy_tolerance = 1e-5 * force_scale_;
  options.force_tolerance = 0.1 * force_scale_;
  NewtonResult result = coupled_newton(equations_->system, following, begun.x, options);
  result.iterations += begun.iterations, result.factorisations += begun.factorisations;
  return result;
}

/// Equilibrium on the present nodes, with contact so stiff that strands overlap little. Without
/// friction that is one minimisation, as a rule. Friction freezes the spots that rub and is solved
/// again with those of the solution until the tension has settled. Mostly the first spots are those
/// of a state that is nearly in equilibrium with its own friction; where that is not found they are
/// those of the last accepted state, and more solves are needed.
NewtonResult RodModel::solve_contact(Vector x) {
  const double aimed = aimed_share * parameters_.penetration;
  double stiffness = effects_.contact ? effects_.contact->law().stiffness : 0;
  if (effects_.contact) effects_.contact->set_law({stiffness, 2 * aimed});
  NewtonResult result;
  int iterations = 0, factorisations = 0;
  double tension = 0, change = 0;
  bool near = false;
  if (rubs_ && tension_ > 0) {
    for (const bool thorough : {false, true}) {
      source_ = before_.frames;
      result = solve_rubbing(x, thorough);
      iterations += result.iterations, factorisations += result.factorisations;
      near = result.ok();
      if (near) break;
    }
    if (near) {
      tension = grip_forces(rod_, result.gradient).tension();
      x = result.x;
    } else {
      source_ = before_.frames;
    }
  }
  for (int pass = 0; pass < max_passes; ++pass) {
    if (effects_.contact) effects_.contact->set_law({stiffness, 2 * aimed});
    if (rubs_ && !(near && pass == 0)) freeze(pass == 0 ? before_.x : result.x);
    result = solve_once(pass == 0 ? x : result.x);
    iterations += result.iterations, factorisations += result.factorisations;
    if (!result.ok() || !effects_.contact) break;
    const double last_change =
        std::abs(std::exchange(change, grip_forces(rod_, result.gradient).tension() - tension));
    tension += change;
    const double little = settled_change * force_scale_;
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
    if (pass + 1 == max_passes && !settled) {
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

Vector RodModel::predict(double ebar) const { return extrapolated(ebar, most_extrapolated); }

/// The guess of least energy: where the path is not smooth (a snap, a soft mode that wanders) fewer
/// states, or the last one alone, foretell more than a polynomial of high degree.
Vector RodModel::best_guess(const Vector& guess, double ebar) {
  if (tension_ == 0 || effects_.friction || last_iterations_ < hard_iterations) return guess;
  const auto energy = [&](const Vector& x) {
    equations_->assembler.refresh(x);
    return equations_->assembler.energy(x);
  };
  Vector best = guess;
  double least = energy(guess);
  for (size_t most = most_extrapolated - 1; most >= 2; --most) {
    Vector x = extrapolated(ebar, most);
    const double here = energy(x);
    if (here < least) least = here, best = std::move(x);
  }
  return best;
}

NewtonResult RodModel::solve(const Vector& guess, double ebar) {
  before_ = history_;
  Vector x = guess;
  if (follows_) {
    const std::vector<double> arc = next_arc(ebar);
    set_arc(arc);
    if (parameters_.twist) {
      put_before_on(arc);
      // Its angles count from frames that carry the twist to the new nodes.
      const Vector plain = remeshed(accepted_.back().arc, history_.x, arc);
      x.tail(angles()) += (before_.x - plain).tail(angles());
    }
  }
  source_ = before_.frames;
  if (effects_.contact) effects_.contact->set_law({stiffness_, effects_.contact->law().onset});
  if (!parameters_.twist) x = best_guess(guess, ebar);
  place_grips(rod_, end_to_end(ebar), x);
  NewtonResult result = solve_contact(x);
  last_iterations_ = result.iterations;
  // The nodes of the start were chosen for its shape, which the first equilibrium changes a lot.
  for (int k = 0; follows_ && tension_ == 0 && result.ok() && k < first_meshes; ++k) {
    const Accepted first{ebar, rod_.arc_length(), result.x};
    const std::vector<double> arc = wished_arc(first);
    const Frames carried = parameters_.twist ? carried_frames(rod_, source_, first.x) : Frames{};
    set_arc(arc);
    x = remeshed(first.arc, first.x, arc);
    place_grips(rod_, end_to_end(ebar), x);
    if (symmetry_) symmetry_->impose(x);
    if (parameters_.twist) {
      source_ = remeshed(first.arc, carried, arc, x);
      if (symmetry_) symmetry_->impose(source_);
      keep_twist(first.arc, first.x, carried, arc, source_, x);
    }
    const int iterations = result.iterations, factorisations = result.factorisations;
    result = solve_contact(std::move(x));
    result.iterations += iterations, result.factorisations += factorisations;
  }
  if (result.ok() && knot_determinant(nodes_of(rod_, result.x)) != determinant_) {
    result.status = NewtonStatus::rejected;
    result.reason = "a strand has passed through another";
  }
  return result;
}

/// Energy that the step to a new state has lost, beyond what the ends' work explains. Without
/// friction dE = -T debar, with T between its values before and behind. Zero within the error that
/// other nodes make.
double RodModel::energy_lost(double ebar, double energy, double tension) const {
  const double step = accepted_.back().ebar - ebar;
  if (tension_ == 0 || parameters_.friction > 0 || std::abs(step) < same_ebar) return 0;
  const double least = energy_ + std::min(tension_ * step, tension * step);
  const double lost = least - energy;
  return lost > 0.05 * std::abs(tension_ * step) + snap_energy * energy_ ? lost : 0;
}

/// Turn of the finish end against the start [rad].
double RodModel::turn_between_ends(const Vector& x) const {
  return x[rod_.angle(rod_.segments() - 1)] - x[rod_.angle(0)];
}

/// Forces on the grips, of a symmetric rod from the elements of both halves.
GripForces RodModel::measured_forces(const NewtonResult& result) const {
  if (!symmetry_) return grip_forces(rod_, result.gradient);
  const Unknowns unknowns({}, 0, std::vector<bool>(result.x.size(), true));
  Assembler whole(unknowns, effects_.list);
  Vector gradient;
  whole.assemble(result.x, Order::gradient, gradient);
  return grip_forces(rod_, gradient);
}

StepRow RodModel::accept(const NewtonResult& result, double ebar) {
  const GripForces forces = measured_forces(result);
  const double snapped = energy_lost(ebar, result.energy, forces.tension());
  if (tension_ == 0 || std::abs(accepted_.back().ebar - ebar) < same_ebar) accepted_.pop_back();
  if (snapped > 0) accepted_.clear();  // no polynomial goes through a snap
  accepted_.push_back({ebar, rod_.arc_length(), result.x});
  if (accepted_.size() > kept) accepted_.erase(accepted_.begin());

  energy_ = result.energy;
  const double tightening = tension_ > 0 ? std::clamp(forces.tension() / tension_, 0.5, 2.0) : 1.0;
  tension_ = forces.tension();
  force_scale_ = std::max(std::abs(tension_), 0.1 * loose_tension(rod_, ebar));
  energy_by_effect_ = equations_->assembler.energy_by_effect();

  StepRow row;
  row.energy = result.energy;
  if (parameters_.twist) {
    source_ = carried_frames(rod_, source_, result.x);
    history_ = {result.x, source_, {}};
    row.end_turn = turn_between_ends(result.x) - tied_turn_;
  }
  if (effects_.friction) {
    const Friction& friction = *effects_.friction;
    // The normal forces of the spots are those at the end of the step: the mean counts.
    const double normal_force = friction.normal_force();
    if (normal_force > 0)
      dissipated_ += 0.5 * (1 + normal_force_ / normal_force) * friction.dissipated(result.x);
    normal_force_ = normal_force;
    row.energy += friction.stored(result.x) - energy_by_effect_["friction"];
    energy_by_effect_["friction"] = friction.stored(result.x);
    history_.memory = friction.memory(result.x);
    row.dissipated = dissipated_;
  }
  row.tension = tension_;
  row.end_torque = forces.torque;
  row.snapped = snapped;
  row.ebar_unstretched = ebar + polyline_length(nodes_of(rod_, result.x)) - length_;
  row.residual = result.residual / force_scale_;
  row.reaction_mismatch = std::abs(forces.start - forces.finish) / force_scale_;
  if (effects_.contact) {
    std::tie(row.contact_pairs, row.max_penetration) = effects_.contact->touching(result.x);
    const double aimed = aimed_share * parameters_.penetration;
    // Mostly with the tension, which is smooth along the path: the largest overlap is less so, as
    // it depends on where the samples lie, and the extrapolation would feel it.
    stiffness_ = effects_.contact->law().stiffness * tightening *
                 std::pow(std::clamp(row.max_penetration / aimed, 0.25, 4.0), 0.3);
  }
  if (choose_pin()) set_equations();
  row.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  return row;
}

RodState RodModel::state() const {
  const Accepted& now = accepted_.back();
  RodState state = seen(rod_, now.x, source_, effects_.contact);
  state.ebar = now.ebar;
  for (double& angle : state.twist_angle) angle -= now.x[rod_.angle(0)];
  // Both ends of a symmetric rod turn alike: seen from the start, the rod turns as a whole.
  if (symmetry_ && parameters_.twist)
    for (Vector3& p : state.nodes)
      p = Eigen::AngleAxisd(-now.x[rod_.angle(0)], Vector3::UnitZ()) * p;
  state.tension = tension_;
  state.energy_by_effect = energy_by_effect_;
  return state;
}

TiedRod RodModel::tied() const {
  TiedRod tied{rod_, {accepted_.back().x, source_, history_.memory}, {}, dissipated_, tied_turn_};
  if (effects_.contact) tied.contact = effects_.contact->law();
  return tied;
}

std::map<std::string, double> RodModel::seconds() const {
  std::map<std::string, double> sum = seconds_;
  if (equations_)
    for (const auto& [phase, time] : equations_->system.seconds) sum[phase] += time;
  return sum;
}

int RodModel::unknowns() const { return equations_->unknowns.size(); }

std::vector<std::string> RodModel::effect_names() const {
  std::vector<std::string> names;
  for (const auto& effect : effects_.list) names.emplace_back(effect->name());
  if (parameters_.inertia) names.emplace_back("inertia");
  if (parameters_.damping > 0) names.emplace_back("damping");
  return names;
}

}  // namespace bight::rod1d
