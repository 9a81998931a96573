#include "rod1d/rod_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mechanics/knot_type.h"
#include "rod1d/grip.h"
#include "rod1d/measure.h"
#include "rod1d/polyline.h"

namespace bight::rod1d {

namespace {

/// Accepted states through which the next one is extrapolated.
constexpr size_t history = 3;
/// Share of the allowed overlap that the contact stiffness aims at.
constexpr double aimed_share = 0.6;

/// Tension of a loose overhand knot, T = 2 pi^2 B/ebar^2 (Audoly et al. 2007): the scale of forces
/// before there is a first equilibrium [E D^2].
double loose_tension(const Rod& rod, double ebar) {
  const double e = std::max(ebar, 10.0);
  return 2 * std::numbers::pi * std::numbers::pi * rod.bending_stiffness / (e * e);
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

  Equations(const std::vector<int>& blocks, const std::vector<bool>& held, const EffectList& effects)
      : unknowns(blocks, static_cast<int>(held.size()), held),
        assembler(unknowns, effects),
        system{assembler, cholesky, Ordering::dissection,
               [this](Vector& x, const Vector& dx) { unknowns.advance(x, dx); }} {}
};

RodModel::RodModel(const RodParameters& parameters, const Polyline& start)
    : parameters_(parameters),
      rod_(uniform_rod(parameters.length, parameters.segments, parameters.poissons_ratio)),
      length_(parameters.length),
      effects_(make_effects(rod_, parameters)),
      began_(std::chrono::steady_clock::now()) {
  const Polyline line = chord_on_axis(resampled(start, parameters.segments));
  start_ebar_ = length_ - (line.back() - line.front()).norm();
  determinant_ = knot_determinant(line);
  force_scale_ = loose_tension(rod_, start_ebar_);
  stiffness_ = 4 * force_scale_ / (aimed_share * parameters.penetration);
  Vector x = coordinates_of(rod_, line, 0);
  place_grips(rod_, end_to_end(start_ebar_), x);
  choose_pin(x);
  accepted_.push_back({start_ebar_, x});
}

RodModel::~RodModel() = default;

/// A round rod without friction or twist may turn about the axis as a whole at no cost. One
/// coordinate of the node farthest from the axis, nearly across its radius, is held against that;
/// its reaction is zero, as a rotation does no work.
void RodModel::choose_pin(const Vector& x) {
  const auto radius = [&](int node) { return x.segment<2>(Rod::position(node)).norm(); };
  if (pin_ >= 0) {
    const int node = pin_ / 3;
    const double lever = std::abs(x[Rod::position(node) + (pin_ % 3 == 0 ? 1 : 0)]);
    if (lever > 0.6 * radius(node) && radius(node) > 0.5) return;
  }
  int farthest = 0;
  for (int i = 0; i < rod_.nodes(); ++i)
    if (radius(i) > radius(farthest)) farthest = i;
  std::vector<bool> held = held_coordinates(rod_, false, parameters_.finish_turns);
  if (radius(farthest) > 0) {
    const Vector2 at = x.segment<2>(Rod::position(farthest));
    pin_ = Rod::position(farthest) + (std::abs(at.x()) > std::abs(at.y()) ? 1 : 0);
    held[pin_] = true;
  }
  std::vector<int> blocks;
  for (int i = 0; i < rod_.nodes(); ++i) blocks.push_back(Rod::position(i));
  equations_ = std::make_unique<Equations>(blocks, held, effects_.list);
}

/// dx/debar of the newest state: H dx = -dg/dgrips, with the grips' effect on the gradient g taken by
/// a central difference.
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
  cholesky.analyse(assembler.hessian(), Ordering::dissection);
  if (!cholesky.factor(assembler.hessian())) return now.x;
  return now.x + (ebar - now.ebar) * unknowns.expand(now.x, -cholesky.solve(change));
}

Vector RodModel::predict(double ebar) const {
  Vector x = accepted_.back().x;
  if (accepted_.size() == 1 && tension_ > 0 && std::abs(ebar - accepted_.back().ebar) > 1e-9) {
    x = tangent(ebar);
  } else if (accepted_.size() > 1) {
    // Lagrange's polynomial in ebar.
    x.setZero();
    for (const Accepted& a : accepted_) {
      double weight = 1;
      for (const Accepted& b : accepted_)
        if (&a != &b) weight *= (ebar - b.ebar) / (a.ebar - b.ebar);
      x += weight * a.x;
    }
  }
  place_grips(rod_, end_to_end(ebar), x);
  return x;
}

NewtonResult RodModel::solve_once(const Vector& guess) {
  NewtonOptions options;
  options.max_iterations = tension_ > 0 ? 60 : 500;
  options.energy_tolerance = 1e-9 * force_scale_;
  options.force_tolerance = 1e-6 * force_scale_;
  options.largest_move = 1;
  options.bound.first_rise = 0;
  return newton(equations_->system, guess, options);
}

NewtonResult RodModel::solve(const Vector& guess, double ebar) {
  (void)ebar;
  const double aimed = aimed_share * parameters_.penetration;
  double stiffness = stiffness_;
  NewtonResult result;
  int iterations = 0, factorisations = 0;
  for (int pass = 0; pass < 12; ++pass) {
    if (effects_.contact) effects_.contact->set_law({stiffness, 2 * aimed});
    result = solve_once(pass == 0 ? guess : result.x);
    iterations += result.iterations, factorisations += result.factorisations;
    if (!result.ok() || !effects_.contact) break;
    const double overlap = max_penetration(*effects_.contact);
    const bool first = tension_ == 0;
    if (overlap <= parameters_.penetration && (!first || overlap > 0.3 * parameters_.penetration))
      break;
    stiffness *= std::clamp(overlap / aimed, 0.3, 4.0);
  }
  result.iterations = iterations, result.factorisations = factorisations;
  if (result.ok() && knot_determinant(nodes_of(rod_, result.x)) != determinant_) {
    result.status = NewtonStatus::stalled;
    result.reason = "a strand has passed through another";
  }
  return result;
}

StepRow RodModel::accept(const NewtonResult& result, double ebar) {
  if (tension_ == 0 || std::abs(accepted_.back().ebar - ebar) < 1e-9) accepted_.pop_back();
  accepted_.push_back({ebar, result.x});
  if (accepted_.size() > history) accepted_.erase(accepted_.begin());

  const GripForces forces = grip_forces(rod_, result.gradient);
  tension_ = forces.tension();
  force_scale_ = std::max(std::abs(tension_), 0.1 * loose_tension(rod_, ebar));
  energy_by_effect_ = equations_->assembler.energy_by_effect();

  StepRow row;
  row.tension = tension_;
  row.energy = result.energy;
  row.residual = result.residual / force_scale_;
  row.reaction_mismatch = std::abs(forces.start - forces.finish) / force_scale_;
  if (effects_.contact) {
    row.max_penetration = max_penetration(*effects_.contact);
    row.contact_pairs = effects_.contact->stencils();
    const double aimed = aimed_share * parameters_.penetration;
    stiffness_ = effects_.contact->law().stiffness *
                 std::clamp(row.max_penetration / aimed, 0.7, 1.5);
  }
  choose_pin(result.x);
  row.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  return row;
}

RodState RodModel::state() const {
  const Accepted& now = accepted_.back();
  RodState state;
  state.ebar = now.ebar;
  state.nodes = nodes_of(rod_, now.x);
  state.s = rod_.arc_length();
  state.curvature = curvature(rod_, now.x);
  state.stretch = stretch(rod_, now.x);
  if (effects_.contact) state.contact_force = contact_force(rod_, *effects_.contact);
  state.tension = tension_;
  state.writhe = writhe(state.nodes);
  state.determinant = knot_determinant(state.nodes);
  state.energy_by_effect = energy_by_effect_;
  return state;
}

int RodModel::unknowns() const { return equations_->unknowns.size(); }

std::vector<std::string> RodModel::effect_names() const {
  std::vector<std::string> names;
  for (const auto& effect : effects_.list) names.emplace_back(effect->name());
  return names;
}

}  // namespace bight::rod1d
