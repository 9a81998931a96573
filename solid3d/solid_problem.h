#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "mechanics/newton.h"
#include "mechanics/path.h"
#include "solid3d/effects.h"
#include "solid3d/effects/load.h"
#include "solid3d/rubbing.h"
#include "solid3d/section_motion.h"
#include "solid3d/solid_motion.h"

namespace bight::solid3d {

/// Where a point is brought until time t from where it was at t = 0.
using Motion = std::function<Vector3(const Vector3& from, double t)>;

/// A steady rigid one: by angle |turn| t about the line through `centre` along `turn`, and shift t.
struct RigidMotion {
  Vector3 shift = Vector3::Zero();   ///< [D] per unit of t
  Vector3 turn = Vector3::Zero();    ///< axis times angle [rad] per unit of t
  Vector3 centre = Vector3::Zero();  ///< [D]
  Vector3 operator()(const Vector3& from, double t) const;
};

/// Strands with any supports, moves and dead loads, for equilibria other than those of knots:
///
///   SolidProblem problem({{section, layers, lower}, {section, layers, upper}}, parameters);
///   problem.hold(problem.section(0, 0));
///   problem.move(problem.section(1, 0), RigidMotion{.shift = {0, 0, -1}});
///   const PathOutcome outcome = problem.go(0.5, 0.05);  // until t = 0.5, in steps of 0.05
///   const Vector3 force = problem.reaction(problem.section(1, 0));
///
/// Strands touch each other and themselves, and rub, as `parameters` say (what belongs to knots
/// there is not looked at). Lengths in D, stresses in E.
class SolidProblem final : private PathModel {
 public:
  /// A straight strand along z, from s = 0, and where its points begin: stresses there are those of
  /// the way from the straight strand.
  struct Strand {
    Section section;
    std::vector<double> layers;  ///< arc lengths
    std::function<Vector3(const Vector3&)> place;
  };
  SolidProblem(const std::vector<Strand>& strands, const SolidParameters& parameters);
  // The solver looks at the effects of this very object.
  SolidProblem(const SolidProblem&) = delete;
  SolidProblem& operator=(const SolidProblem&) = delete;

  const std::vector<Mesh>& strands() const { return strands_; }
  std::vector<int> section(int strand, int layer) const;  ///< its nodes
  /// Nodes of a strand whose places in the straight strand are so.
  std::vector<int> nodes(int strand, const std::function<bool(const Vector3&)>& there) const;

  /// Supports: nodes that stay where they are, along one axis or all, or that are moved; the time
  /// of their motion begins now.
  void hold(const std::vector<int>& nodes);
  void hold(const std::vector<int>& nodes, int axis);
  void move(const std::vector<int>& nodes, Motion motion);
  void release(const std::vector<int>& nodes);
  /// A dead force, shared by the nodes in equal parts, instead of the one before [E D^2].
  void load(const std::vector<int>& nodes, const Vector3& force);

  /// Follows the moves, from the time that it is to `t`, in steps that are cut where a solve fails.
  /// With friction every step counts: what slid stays where it slid.
  PathOutcome go(
      double t, double max_step,
      const std::function<void(const StepRow&)>& on_step = [](const StepRow&) {});
  double time() const { return history_.back().ebar; }

  /// Motion from the present state, with these velocities by coordinates. The problem keeps its own
  /// state, goes nowhere meanwhile, and must outlive the motion. Nothing may rub.
  std::unique_ptr<SolidMotion> release(const Vector& velocity, const MotionParameters& parameters);
  std::unique_ptr<SolidMotion> release(const MotionParameters& parameters) {
    return release(Vector::Zero(state().size()), parameters);
  }

  const Vector& state() const { return history_.back().x; }
  Vector3 position(int node) const { return state().segment<3>(3 * node); }
  /// Force of the supports on nodes, and torque about a point.
  Vector3 reaction(const std::vector<int>& nodes) const;
  Vector3 torque(const std::vector<int>& nodes, const Vector3& about) const;
  double energy() const { return energy_; }

  /// What a piece of surface feels of the one that faces it.
  struct Touch {
    int strand;
    Vector3 position, normal;  ///< normal outwards
    double pressure;           ///< [E]
    double area;               ///< of the undeformed surface [D^2]
    double gap;                ///< [D]
  };
  std::vector<Touch> touches() const;

  const SolidEffects& effects() const { return effects_; }
  int unknowns() const { return solver_ ? solver_->unknowns.size() : 0; }
  void observe(NewtonObserver observer) { observer_ = std::move(observer); }

 private:
  struct Solver {
    Solver(std::vector<int> blocks, int positions, const std::vector<bool>& held,
           const EffectList& effects);
    Unknowns unknowns;
    Assembler assembler;
    SparseCholesky cholesky;
    System system;
  };
  struct Move {
    std::vector<int> nodes;
    std::vector<Vector3> from;
    double since;
    Motion motion;
  };

  Vector predict(double t) const override;
  NewtonResult solve(const Vector& guess, double t) override;
  StepRow accept(const NewtonResult& result, double t) override;

  NewtonResult minimise(const Vector& guess);
  NewtonResult solve_rubbing(const Vector& guess);
  NewtonResult solve_frozen(const Vector& guess);
  NewtonOptions options(double force_tolerance, double energy_tolerance) const;
  Vector held(Vector x, double t) const;
  Vector follow_moves(double t) const;
  void changed();
  void prepare();

  SolidParameters parameters_;
  std::vector<Mesh> strands_;
  int positions_;
  SolidEffects effects_;
  Load* loads_;  ///< in the list of effects
  std::vector<bool> held_;
  std::vector<Move> moves_;
  std::unique_ptr<Solver> solver_;  ///< for the present supports
  double scale_;                    ///< of forces [E D^2]
  std::vector<Station> history_;    ///< the last accepted states, newest last
  Rubbing rubbing_{effects_, history_};
  Vector gradient_;  ///< by coordinates, at the newest
  double energy_ = 0;
  NewtonObserver observer_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace bight::solid3d
