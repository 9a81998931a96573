// How the next state is guessed from the accepted ones.

#include <algorithm>
#include <cmath>

#include "rod1d/pin.h"
#include "rod1d/remesh.h"
#include "rod1d/rod_equations.h"

namespace bight::rod1d {

namespace {

/// Accepted states through which the next one is extrapolated, at most.
constexpr size_t most_extrapolated = 4;
/// Iterations of a solve after which the next guess is looked at more closely.
constexpr int hard_iterations = 8;

}  // namespace

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

}  // namespace bight::rod1d
