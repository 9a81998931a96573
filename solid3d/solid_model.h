#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/end_motion.h"
#include "mechanics/newton.h"
#include "mechanics/path.h"
#include "mechanics/snap.h"
#include "solid3d/checkpoint.h"
#include "solid3d/effects.h"
#include "solid3d/effects/grip.h"
#include "solid3d/rubbing.h"
#include "solid3d/run_solid.h"
#include "solid3d/solid_motion.h"
#include "solid3d/two_fold.h"

namespace bight::solid3d {

/// The solid as follow() sees it: its accepted states, how the next is guessed, solved and
/// measured. With inertia the start is an equilibrium, from which on the ends move at their speed:
/// to "solve" for an ebar is to let time go on until they are there.
class SolidModel final : public PathModel {
 public:
  using Clock = std::chrono::steady_clock;

  SolidModel(const Mesh& mesh, const std::vector<Vector3>& start, double start_ebar,
             const SolidParameters& parameters, Clock::time_point began);

  Vector predict(double ebar) const override;
  NewtonResult solve(const Vector& guess, double ebar) override;
  StepRow accept(const NewtonResult& result, double ebar) override;

  SolidState state(double ebar);

  /// The first state has no rate to go on with, but a tangent that is not saved.
  bool can_be_saved() const { return history_.size() > 1; }

  SolidCheckpoint saved() const;
  void restore(const SolidCheckpoint& at);

  int unknowns() const { return unknowns_.size(); }
  bool symmetric() const { return symmetry_.has_value(); }
  const EffectList& effects() const { return effects_.list; }
  const std::map<std::string, double>& seconds() const { return system_.seconds; }
  const std::map<std::string, double>& seconds_by_effect() const {
    return assembler_.seconds_by_effect();
  }
  std::vector<EffectCost> costs(const std::map<std::string, double>& before) const {
    return assembler_.costs(before);
  }
  void observe(NewtonObserver observer) { observer_ = std::move(observer); }

 private:
  NewtonResult relax(const Vector& start);
  NewtonResult relax_at_once(const Vector& start);
  NewtonResult relax_slowly();
  NewtonResult settle(const Vector& start);
  NewtonResult settle_or_minimise(const Vector& guess);
  NewtonResult solve_frictionless(const Vector& guess);
  NewtonResult stiffened(NewtonResult solved);
  /// Normal forces, facing points and tangents are frozen, then taken from the solution, until the
  /// end tension stays. The start is relaxed with friction, too: the shape of a rod with friction
  /// is held by it.
  NewtonResult solve_with_friction_frozen(const Vector& guess);
  NewtonResult solve_rubbing(const Vector& guess);
  NewtonResult solve_with_friction(const Vector& guess);
  NewtonResult solve_at_rest(const Vector& guess, double ebar);

  void take_over(std::vector<Rub> rubs);
  void stiffen_ahead(double growth);

  /// Friction of a solution since the last state, by the whole knot as by its half.
  void freeze_whole(const Vector& last);
  void accept_friction(const Vector& x);

  /// Takes a state over as the newest one and measures it.
  StepRow take(const NewtonResult& result, double ebar);

  void set_in_motion(const MotionState& from);
  NewtonResult move_to(double ebar);
  void move_grips(double time, Vector& x, Vector& v) const;
  void follow_overlap(double moved);
  Vector held(Vector x, double ebar) const;
  Vector best_guess(const Vector& guess, double ebar);

  const Vector& newest() const { return history_.back().x; }
  const SolidEffects& whole() const { return symmetry_ ? whole_effects_ : effects_; }

  /// Largest out-of-balance force on a node between the grips [E D^2].
  double largest_inner(const Vector& gradient) const;

  /// The model works in a frame with the pulling axis along z and z = 0 halfway between the ends; a
  /// symmetry axis lies along x.
  static Eigen::Isometry3d frame(const Mesh& mesh, const std::vector<Vector3>& start,
                                 const std::optional<TwoFold>& symmetry);

  /// Without friction the knot may slide along the rod and, where the finish turns, revolve about
  /// the pulling axis while the rod rolls about its own, at no cost but what the mesh is uneven by.
  /// A symmetry excludes all three. Without one, each is stopped at the middle section: its centre
  /// along z and across its radius, and a point of its x axis sideways. A choice of place and
  /// angles among equals; what the pin along z carries is seen as a difference of the end tensions.
  static Grip make_grip(const Mesh& mesh, const std::vector<Vector3>& start,
                        const SolidParameters& parameters, const std::optional<TwoFold>& symmetry);

  NewtonOptions options() const;
  double round_off() const;
  double energy(const Vector& x);

  /// Solves on from a solution after something has changed; counts on, too.
  NewtonResult go_on(NewtonResult solved);

  /// Sections move rigidly through the exponential map, turned ends about their axis.
  void advance(Vector& x, const Vector& dx) const;

  /// Turned ends as their angles say.
  void turn_grips(Vector& x, const Vector& from) const;

  /// Held coordinates exactly as they were.
  void hold_grips(Vector& x, const Vector& as) const;

  /// Tangent predictor: the linear answer of the last tangent to the motion of the ends.
  Vector follow_grip(double ebar) const;

  /// Of a guess: no shift is known yet. The tangent there is mostly indefinite, so zero is not
  /// tried.
  static constexpr double unknown_shift = std::numeric_limits<double>::infinity();

  const Mesh& mesh_;
  const SolidParameters& parameters_;
  double start_ebar_;
  std::optional<TwoFold> symmetry_;  ///< then one half is simulated
  Eigen::Isometry3d from_frame_;     ///< of the model, to where the start was given
  Grip grip_;
  int internal_begin_;
  SolidEffects effects_;
  Unknowns unknowns_;
  mutable Assembler assembler_;
  SparseCholesky cholesky_;
  System system_;
  double tension_, energy_ = 0;  ///< of the newest state, whole
  int determinant_ = 0;
  bool relaxing_ = true;        ///< the start is not yet in equilibrium
  bool far_ = false;            ///< the equilibrium to be found may be behind a fold
  double start_energy_ = 0;     ///< while relaxing
  SolidEffects whole_effects_;  ///< of a symmetric knot, to measure with
  std::optional<Assembler> whole_assembler_;
  std::vector<Station> history_;  ///< the last accepted states, newest last
  Rubbing rubbing_{effects_, history_};
  Vector gradient_;  ///< by coordinates, at the newest
  std::optional<EndMotion> ends_;
  std::unique_ptr<SolidMotion> motion_;  ///< with inertia, once the start is relaxed
  StepRow moved_;                        ///< the newest time step
  std::string halted_;                   ///< why time cannot go on; empty while it can
  NewtonObserver observer_;
  Clock::time_point begin_;
};

}  // namespace bight::solid3d
