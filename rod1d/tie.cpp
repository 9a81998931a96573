#include "rod1d/tie.h"

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>

#include "mechanics/knot_type.h"
#include "mechanics/newton.h"
#include "rod1d/effects.h"
#include "rod1d/measure.h"

namespace bight::rod1d {

namespace {

constexpr int half_segments = 90;
/// Overlap at which contact balances the forces of a loop, and overlap that ends the tying [D].
constexpr double soft_overlap = 0.02, largest_overlap = 0.2;

/// Overhand: a loop is bent and crossed, the ends go through it from either side.
std::vector<TieMove> tie_overhand() {
  const Polyline crossed{{-6, 0.6, 2}};
  return {{"bend", 3, {-19, 0, 30.3}, {-0.5, 0, 0.87}, {{-2, 0, 7.6}}},
          {"bend", 4, {-26, 0, 20.6}, {-0.87, 0, 0.5}, {{-3.8, 0, 6.6}}},
          {"bend", 4, {-31, 0, 5}, {-1, 0, 0}, {{-5, 0, 5}}},
          {"bend", 8, {-28, 1.5, -5}, {-0.95, 0, -0.3}, crossed},
          {"thread", 6, {-18, 2, -14}, {0, 0.3, -1}, crossed},
          {"thread", 6, {-8, 4, -12}, {1, 0.2, 0}, crossed},
          {"thread", 6, {-4, 6, -4}, {0.3, -0.3, 0.9}, crossed},
          {"thread", 4, {-3.5, 3, -1.2}, {0, -1, 0}, crossed},
          {"thread", 6, {-3.5, -4, -1.5}, {0, -1, -0.2}, crossed},
          {"thread", 6, {-3.5, -4, -10}, {0, -0.2, -1}, crossed},
          {"release", 4, {-3.5, 0, -10}, {0, 0, -1}, {}}};
}

/// Figure-eight: the rod is bent to an S, each end goes through the loop of the other half. The
/// knot is its own mirror image.
std::vector<TieMove> tie_figure_eight() {
  const Polyline bent{{0, 0, 4.9}, {5.6, 0, 7.7}};
  return {{"bend", 6, {20.5, 0, 23}, {0.87, 0, 0.5}, {{0, 0, 4.9}, {3.1, 0, 12.9}}},
          {"bend", 6, {23, 0, 0.6}, {0.87, 0, -0.5}, {{0, 0, 4.9}, {5.2, 0, 10.5}}},
          {"bend", 6, {6.4, 0, -12}, {0, 0, -1}, bent},
          {"thread", 8, {-2.9, 4, -5}, {-0.3, -0.9, -0.1}, bent},
          {"thread", 6, {-2.9, -4, -5.5}, {0, -0.9, -0.4}, bent},
          {"thread", 6, {-2, -4, -12}, {0, -0.2, -1}, bent},
          {"release", 6, {0, 0, -10.5}, {0, 0, -1}, {}}};
}

/// Part u of the way from the end of one move to that of the next.
TieMove between(const TieMove& from, const TieMove& to, double u) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(from.direction, to.direction);
  TieMove at = to;
  at.finish = (1 - u) * from.finish + u * to.finish;
  for (size_t i = 0; i < to.auxiliary.size(); ++i)
    at.auxiliary[i] = (1 - u) * from.auxiliary[i] + u * to.auxiliary[i];
  at.direction = Eigen::Quaterniond::Identity().slerp(u, turn) * from.direction;
  return at;
}

/// A rod whose ends and auxiliary points are moved about.
class TiedRod {
 public:
  TiedRod(const TieProtocol& protocol, double length)
      : scale_(length / protocol.length),
        symmetry_(protocol.symmetry, 2 * half_segments),
        rod_(uniform_rod(length, 2 * half_segments, 0.5)),
        effects_(make_effects(rod_, RodParameters{}, no_frames_)),
        halves_(symmetry_.halves(effects_.list)),
        x_(3 * rod_.nodes()),
        force_(rod_.bending_stiffness / (4 * scale_ * scale_)) {
    for (const double arc : protocol.auxiliary)
      auxiliary_.push_back(
          static_cast<int>(std::lround(2 * half_segments * arc / protocol.length)));
    for (int k = 0; k <= half_segments; ++k)
      place(k, Vector3(0, 0, k * 0.5 * length / half_segments));
    effects_.contact->set_law({4 * force_ / soft_overlap, soft_overlap});
  }

  /// Grips and auxiliary points elsewhere, the rest in equilibrium again.
  void move(const TieMove& to) {
    const Vector3 end = scale_ * to.finish, d = to.direction.normalized();
    place(half_segments, end);
    place(half_segments - 1, end - rod_.rest_length[0] * d);
    for (size_t i = 0; i < to.auxiliary.size(); ++i) place(auxiliary_[i], scale_ * to.auxiliary[i]);
    if (!equations_ || held_ != to.auxiliary.size()) set_equations(to.auxiliary.size());
    NewtonOptions options;
    options.energy_tolerance = 1e-6 * force_;
    options.force_tolerance = 1e-3 * force_;
    options.largest_move = 0.5;
    const NewtonResult result = newton(equations_->system, x_, options);
    // A state on the way need not be an equilibrium, but it must be one without overlap.
    if (result.status == NewtonStatus::not_finite || result.status == NewtonStatus::no_descent)
      throw std::runtime_error("the rod cannot be tied: " + result.reason);
    x_ = result.x;
    if (effects_.contact->touching(x_).second > largest_overlap)
      throw std::runtime_error("the rod cannot be tied: its strands overlap");
  }

  RodState state() const {
    RodState state;
    state.nodes = nodes_of(rod_, x_);
    state.s = rod_.arc_length();
    state.ebar = state.s.back() - (state.nodes.back() - state.nodes.front()).norm();
    state.curvature = curvature(rod_, x_);
    state.stretch = stretch(rod_, x_);
    state.contact_force = contact_force(rod_, effects_.contact->points(x_));
    state.determinant = knot_determinant(state.nodes);
    return state;
  }

 private:
  struct Equations {
    Unknowns unknowns;
    Assembler assembler;
    SparseCholesky cholesky;
    System system;
    Equations(const std::vector<int>& blocks, const std::vector<bool>& held,
              const std::vector<Image>& images, const EffectList& list)
        : unknowns(blocks, static_cast<int>(held.size()), held, {}, images),
          assembler(unknowns, list),
          system{assembler, cholesky, Ordering::minimum_degree,
                 [this](Vector& x, const Vector& dx) { unknowns.advance(x, dx); }} {}
  };

  /// The k-th node from the middle on the finish half, and its image.
  void place(int k, const Vector3& at) {
    x_.segment<3>(Rod::position(half_segments + k)) = at;
    x_.segment<3>(Rod::position(half_segments - k)) = symmetry_.image(at);
  }
  void set_equations(size_t auxiliary_held) {
    held_ = auxiliary_held;
    std::vector<bool> held(static_cast<size_t>(x_.size()), false);
    const auto hold = [&](int k) {
      for (const int node : {half_segments - k, half_segments + k})
        for (int c = 0; c < 3; ++c) held[Rod::position(node) + c] = true;
    };
    hold(half_segments), hold(half_segments - 1);
    for (size_t i = 0; i < auxiliary_held; ++i) hold(auxiliary_[i]);
    std::vector<int> blocks;
    for (int i = 0; i < rod_.nodes(); ++i) blocks.push_back(Rod::position(i));
    symmetry_.hold_middle(held);
    equations_ = std::make_unique<Equations>(blocks, held, symmetry_.images(false), halves_);
  }

  double scale_;
  TwoFold symmetry_;
  std::vector<int> auxiliary_;  ///< nodes, counted from the middle
  Rod rod_;
  Frames no_frames_;
  RodEffects effects_;
  EffectList halves_;  ///< the same, summed over one half and its image
  Vector x_;
  double force_;     ///< in a loop of the protocol's size [E D^2]
  size_t held_ = 0;  ///< auxiliary points
  std::unique_ptr<Equations> equations_;
};

}  // namespace

double TieProtocol::shortening() const {
  return 1 - 2 * std::abs(moves.back().finish.z()) / length;
}

const TieProtocol& tie_protocol(std::string_view knot) {
  static const std::vector<TieProtocol> protocols = {
      {"overhand", 70, TwoFold::Kind::half_turn, {8}, tie_overhand()},
      {"figure-eight", 70, TwoFold::Kind::inversion, {5, 14}, tie_figure_eight()},
  };
  for (const TieProtocol& protocol : protocols)
    if (protocol.knot == knot) return protocol;
  throw std::invalid_argument("no way to tie the knot " + std::string(knot) + " is known");
}

Polyline tied(const TieProtocol& protocol, double length, double ebar,
              const std::function<void(std::string_view, const RodState&)>& observer) {
  const double part = ebar / protocol.shortening();
  const auto refuse = [&](const char* why) {
    std::ostringstream text;
    text << "a straight rod of length " << length << " D cannot be tied to a " << protocol.knot
         << " knot at ebar " << ebar << ": " << why;
    throw std::invalid_argument(text.str());
  };
  if (!(ebar >= tightest_tie)) refuse("the loop would be too small");
  if (!(ebar <= loosest_tie)) refuse("the loop would be too large");
  if (!(part <= length)) refuse("it is too short");

  TiedRod rod(protocol, part);
  const auto show = [&](std::string_view step) {
    if (observer) observer(step, rod.state());
  };
  TieMove from{"straight", 0, {0, 0, 0.5 * protocol.length}, {0, 0, 1}, {}};
  for (const double arc : protocol.auxiliary) from.auxiliary.push_back({0, 0, arc});
  show(from.step);
  for (const TieMove& to : protocol.moves) {
    for (int i = 1; i <= to.increments; ++i) {
      rod.move(between(from, to, static_cast<double>(i) / to.increments));
      show(to.step);
    }
    from = to;
  }
  Polyline line = rod.state().nodes;
  const Vector3 tail = 0.5 * (length - part) * from.direction.normalized();
  if (tail.norm() > 0) {
    line.insert(line.begin(), line.front() - tail);
    line.push_back(line.back() + tail);
  }
  return line;
}

}  // namespace bight::rod1d
