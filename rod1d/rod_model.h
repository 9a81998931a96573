#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "mechanics/force_path.h"
#include "mechanics/snap.h"
#include "rod1d/effects.h"
#include "rod1d/grip.h"
#include "rod1d/run_rod.h"
#include "rod1d/timed_rod.h"
#include "rod1d/two_fold.h"

namespace bight::rod1d {

/// The rod as follow() sees it: its accepted states, how the next is guessed, solved and measured.
class RodModel final : public ForceModel {
 public:
  RodModel(const RodParameters& parameters, const Polyline& start);
  ~RodModel() override;

  Vector predict(double ebar) const override;
  NewtonResult solve(const Vector& guess, double ebar) override;
  StepRow accept(const NewtonResult& result, double ebar) override;
  double tension(const NewtonResult& result) const override {
    return measured_forces(result).tension();
  }

  /// ebar of the start, as it was given.
  double start_ebar() const { return start_ebar_; }
  /// Knot type of the start: what every later state must have.
  int determinant() const { return determinant_; }

  /// From now on friction acts; until then the knot is formed without.
  void let_rub();
  /// The knot is tied: the finish end's turn is counted from here, and a clamped one held.
  void set_tied();
  /// Turns the held finish end about the pulling axis by `angle` [rad].
  void turn_finish(double angle) { finish_angle_ += symmetry_ ? 0.5 * angle : angle; }

  /// The newest accepted state in full.
  RodState state() const;

  /// What it is set in motion from.
  TiedRod tied() const;

  int unknowns() const;
  /// Wall seconds by phase of all solves so far.
  std::map<std::string, double> seconds() const;
  std::vector<std::string> effect_names() const;
  std::vector<EffectCost> costs() const;

 private:
  struct Equations;
  /// Steps in ebar below this are no steps.
  static constexpr double same_ebar = 1e-9;
  /// Longest step in ebar whose solves with friction may be relaxed. What they settle on behind a
  /// longer one may be another branch: it is better cut.
  static constexpr double longest_relaxed_step = 1;
  struct Accepted {
    double ebar;
    std::vector<double> arc;  ///< undeformed arc length of the nodes [D]
    Vector x;
  };
  /// Accepted states and their weights in the guess for an ebar.
  using Extrapolation = std::vector<std::pair<const Accepted*, double>>;
  Extrapolation extrapolation(double ebar, size_t most) const;
  Vector extrapolated(double ebar, size_t most) const;
  Vector best_guess(const Vector& guess, double ebar);
  std::vector<double> next_arc(double ebar) const;
  Polyline meshed(const Polyline& start);
  void set_arc(const std::vector<double>& arc);
  FrictionHistory on_nodes(const std::vector<double>& arc, const Accepted& state,
                           const Frames& frames) const;
  void keep_twist(const std::vector<double>& arc, const Vector& x, const Frames& frames,
                  const std::vector<double>& wanted, const Frames& frames_wanted,
                  Vector& x_wanted) const;
  std::vector<double> wished_arc(const Accepted& at) const;
  int angles() const { return parameters_.twist ? rod_.segments() : 0; }
  int middle_node() const { return rod_.segments() / 2; }
  double end_to_end(double ebar) const { return length_ - ebar; }
  bool choose_pin();
  void refuse_overlap(const Vector& x);
  void refuse_other_knot(int given) const;
  void set_equations();
  Vector tangent(double ebar) const;
  void freeze(const Vector& x);
  void halve();
  double turn_between_ends(const Vector& x) const;
  GripForces measured_forces(const NewtonResult& result) const;
  double energy_snapped(const Equilibrium& now) const;
  NewtonResult solve_once(const Vector& guess);
  Vector rolled(Vector x, double angle) const;
  Vector let_move(const Vector& x);
  /// Something acts from outside: weight, a field.
  bool acted_on() const {
    return std::ranges::any_of(effects_.list, [](const auto& e) { return e->from_outside(); });
  }
  /// A turn about the axis does change the energy.
  bool inverts() const { return symmetry_ && symmetry_->kind() == TwoFold::Kind::inversion; }
  bool turned_by_itself() const { return acted_on() || !rod_.straight(); }
  NewtonResult solve_rubbing(const Vector& guess);
  NewtonResult solve_contact(Vector x);

  RodParameters parameters_;
  bool follows_;  ///< nodes follow the knot
  Rod rod_;
  double length_, start_ebar_;
  int determinant_;
  Frames source_;            ///< frames that twist is counted from; empty without twist
  FrictionHistory history_;  ///< the newest accepted state; empty without twist
  FrictionHistory before_;   ///< the same on the nodes of the present solve
  bool finish_turns_ = true;
  bool rubs_ = false;                ///< friction acts
  double tied_turn_ = 0;             ///< between the ends, when tied [rad]
  double finish_angle_ = 0;          ///< of the last segment, when held [rad]
  std::optional<TwoFold> symmetry_;  ///< then one half is simulated
  RodEffects effects_;
  EffectList halves_;  ///< of a symmetric rod: the same, summed over one half and its image
  std::unique_ptr<Equations> equations_;
  int pin_ = -1;                     ///< node held at y = 0; -1: none
  double stiffness_ = 0;             ///< of contact, where the next solve begins
  double force_scale_;               ///< tension expected [E D^2]
  std::vector<Accepted> accepted_;   ///< the newest few, newest last
  double tension_ = 0, energy_ = 0;  ///< of the newest accepted state
  double normal_force_ = 0;          ///< summed over the spots that rub there [E D^2]
  double dissipated_ = 0;            ///< by friction so far [E D^3]
  int last_iterations_ = 0;          ///< of the last solve
  bool relaxes_ = false;             ///< solves with friction may be relaxed
  bool far_ = true;                  ///< the equilibrium to be found may be far from the guess
  std::map<std::string, double> energy_by_effect_;
  std::map<std::string, double> seconds_;            ///< of equations that were replaced
  std::map<std::string, double> seconds_by_effect_;  ///< the same
  std::chrono::steady_clock::time_point began_;
};

}  // namespace bight::rod1d
