#include "rod1d/rod_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "mechanics/knot_type.h"
#include "rod1d/flattening.h"
#include "rod1d/grip.h"
#include "rod1d/measure.h"
#include "rod1d/pin.h"
#include "rod1d/polyline.h"
#include "rod1d/remesh.h"
#include "rod1d/rod_equations.h"
#include "rod1d/rod_state.h"

namespace bight::rod1d {

namespace {

/// Accepted states kept for guesses.
constexpr size_t kept = 12;
/// Overlap of a start's strands, at most [D].
constexpr double largest_start_overlap = 0.5;
/// Times that the nodes are chosen anew at the first equilibrium.
constexpr int first_meshes = 3;

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

RodModel::RodModel(const RodParameters& parameters, const Polyline& start)
    : parameters_(parameters),
      follows_(parameters.follow_knot && !parameters.inertia && parameters.natural_curvature == 0 &&
               parameters.natural_twist == 0),
      rod_(free_rod(parameters)),
      length_(parameters.length),
      effects_(make_effects(rod_, parameters, source_)),
      began_(std::chrono::steady_clock::now()) {
  Polyline line = chord_on_axis(start);
  if (parameters.symmetry && rod_.straight() && !parameters.inertia && !acted_on())
    symmetry_ = TwoFold::find(line, parameters.segments);
  // A turn of one end against the other is no inversion's image.
  if (inverts() && parameters.finish_turn != 0) symmetry_.reset();
  line = meshed(line);
  start_ebar_ = length_ - (line.back() - line.front()).norm();
  determinant_ = knot_determinant(line);
  force_scale_ = loose_tension(rod_, start_ebar_);
  stiffness_ = 4 * force_scale_ / (aimed_overlap * parameters.penetration);
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
  seconds_ = seconds();
  if (equations_)
    for (const auto& [effect, time] : equations_->assembler.seconds_by_effect())
      seconds_by_effect_[effect] += time;
  equations_ = std::make_unique<Equations>(rod_.blocks(parameters_.twist), held, images,
                                           symmetry_ ? halves_ : effects_.list);
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

NewtonResult RodModel::solve(const Vector& guess, double ebar) {
  before_ = history_;
  // Behind a fold there is no equilibrium near: the knot snaps, at an ebar that hardly changes,
  // and Newton goes downhill, in moves too short for strands to pass each other, to where it rests.
  const bool snaps = !rubs_ && std::abs(ebar - accepted_.back().ebar) < fold_step;
  far_ = tension_ == 0 || snaps;
  relaxes_ = std::abs(ebar - accepted_.back().ebar) <= longest_relaxed_step;
  Vector x = guess;
  if (follows_) {
    const std::vector<double> arc = next_arc(ebar);
    set_arc(arc);
    if (parameters_.twist) {
      const Accepted& last = accepted_.back();
      FrictionHistory there = on_nodes(arc, {last.ebar, last.arc, history_.x}, history_.frames);
      before_.x = std::move(there.x), before_.frames = std::move(there.frames);
      // Its angles count from frames that carry the twist to the new nodes.
      const Vector plain = remeshed(last.arc, history_.x, arc);
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
    FrictionHistory there = on_nodes(arc, first, carried);
    source_ = std::move(there.frames);
    const NewtonResult before = std::move(result);
    result = solve_contact(std::move(there.x));
    result.count_on(before);
  }
  if (result.ok() && knot_determinant(nodes_of(rod_, result.x)) != determinant_) {
    result.status = NewtonStatus::rejected;
    result.reason = "a strand has passed through another";
  }
  return result;
}

/// Energy lost by snapping to a new state; zero with friction, which is not a matter of energy.
double RodModel::energy_snapped(const Equilibrium& now) const {
  const Equilibrium last{accepted_.back().ebar, energy_, tension_};
  if (tension_ == 0 || parameters_.friction > 0 || std::abs(last.ebar - now.ebar) < same_ebar)
    return 0;
  return energy_lost(last, now);
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
  const double snapped = energy_snapped({ebar, result.energy, forces.tension()});
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
    row.flattening =
        flattening_energy(rubbing_points(rod_, effects_.contact->points(result.x), false),
                          parameters_.poissons_ratio);
    const double aimed = aimed_overlap * parameters_.penetration;
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
  const Eigen::AngleAxisd turn(symmetry_ && parameters_.twist ? -now.x[rod_.angle(0)] : 0.0,
                               Vector3::UnitZ());
  for (Vector3& p : state.nodes) p = turn * p;
  state.rubs = rubs(rod_, history_);
  if (symmetry_) state.rubs = symmetry_->whole(std::move(state.rubs), length_);
  for (Rub& rub : state.rubs) rub.elastic_slip = turn * rub.elastic_slip;
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

std::vector<EffectCost> RodModel::costs() const {
  return equations_->assembler.costs(seconds_by_effect_);
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
