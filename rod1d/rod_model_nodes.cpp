#include "rod1d/rod_model.h"

// Where the nodes of a rod lie that follow the knot, and how states get onto others.

#include <algorithm>
#include <cmath>

#include "rod1d/knot_mesh.h"
#include "rod1d/polyline.h"
#include "rod1d/remesh.h"

namespace bight::rod1d {

namespace {

/// Points of a start that is to be meshed, per diameter and in all.
constexpr double start_points = 10;
constexpr int most_start_points = 20000;
/// Part of the way that the nodes go in one step towards where they are wished.
constexpr double mesh_pull = 0.3;
/// Wished places are found from about this many nodes.
constexpr int mesh_points = 500;

}  // namespace

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

/// Friction takes half the contact points of a symmetric rod.
void RodModel::halve() {
  halves_ = symmetry_ ? symmetry_->halves(effects_.list, effects_.friction) : EffectList();
}

/// A state on other nodes, its ends held as its ebar says, and what its twist counts from there.
FrictionHistory RodModel::on_nodes(const std::vector<double>& arc, const Accepted& state,
                                   const Frames& frames) const {
  FrictionHistory there{remeshed(state.arc, state.x, arc), {}, {}};
  place_grips(rod_, end_to_end(state.ebar), there.x);
  if (symmetry_) symmetry_->impose(there.x);
  if (!parameters_.twist) return there;
  there.frames = remeshed(state.arc, frames, arc, there.x);
  if (symmetry_) symmetry_->impose(there.frames);
  keep_twist(state.arc, state.x, frames, arc, there.frames, there.x);
  return there;
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

}  // namespace bight::rod1d
