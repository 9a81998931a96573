#pragma once

#include "mechanics/newton.h"
#include "rod1d/effects.h"
#include "rod1d/effects/load.h"
#include "rod1d/rod_motion.h"

namespace bight::rod1d {

/// A rod with any supports and loads, for equilibria other than those of knots:
///
///   RodProblem problem(uniform_rod(10, 80, 0.5), straight_line, true);
///   problem.hold(0), problem.hold(1), problem.hold_angle(0);  // clamped at the start
///   problem.load(80, Vector3(1e-4, 0, 0));                    // a force at the other end
///   const NewtonResult result = problem.solve();
///
/// Lengths in D, forces in E D^2, or in any other consistent units: only the stiffnesses of the rod
/// count. Where strands touch, lengths are in D.
class RodProblem {
 public:
  /// Contact between strands of the tube, and friction where its coefficient is not zero.
  struct Touch {
    ContactLaw law;
    double friction = 0;
  };
  /// `nodes`: the state to begin from. The material frames there are without twist; `twist`: the
  /// angles of the segments are unknowns.
  RodProblem(Rod rod, const Polyline& nodes, bool twist);
  RodProblem(Rod rod, const Polyline& nodes, bool twist, const Touch& touch);
  // The effects look at the frames of this very object.
  RodProblem(const RodProblem&) = delete;
  RodProblem& operator=(const RodProblem&) = delete;

  /// Supports. A held node stays where it is or is moved to; along one axis or all.
  void hold(int node);
  void hold(int node, int axis);
  void move(int node, const Vector3& to);
  /// The angle of a segment is held; turn() turns it further [rad].
  void hold_angle(int segment);
  void turn(int segment, double by);
  /// A dead force on a node, and one per undeformed length on all (weight).
  void load(int node, const Vector3& force);
  void weigh(const Vector3& force_per_length);

  /// Gives all segments a uniform twist, so that the last one has turned by `by` [rad].
  void twist_uniformly(double by);

  /// Equilibrium near the present state, which it becomes when it was found. With friction it is
  /// one step: what slid stays where it slid.
  NewtonResult solve(int max_iterations = 300);
  /// Whether the energy rises in every direction from the present state.
  bool stable();

  /// Motion from the present state, with these velocities by coordinates. The problem keeps its own
  /// state, and must outlive the motion.
  std::unique_ptr<RodMotion> release(const Vector& velocity, const MotionParameters& parameters);
  std::unique_ptr<RodMotion> release(const MotionParameters& parameters) {
    return release(Vector::Zero(x_.size()), parameters);
  }

  const Rod& rod() const { return rod_; }
  Polyline nodes() const;
  double angle(int segment) const { return x_[rod_.angle(segment)]; }
  /// Force that a support exerts on a held node, torque about the tangent on a held segment.
  Vector3 reaction(int node);
  double torque(int segment);

  /// Overlap of strands [D], zero or more, and energy lost to friction so far [E D^3].
  double overlap();
  double dissipated() const { return dissipated_; }

 private:
  RodProblem(Rod rod, const Polyline& nodes, bool twist, const Touch* touch);
  Unknowns unknowns() const;
  Vector gradient();
  NewtonResult minimise(System& system, const Vector& x, int max_iterations);
  void freeze(const Vector& x);

  Rod rod_;
  bool twist_;
  Vector x_;
  Frames source_;
  RodEffects effects_;
  FrictionHistory history_;  ///< the present state, where friction acts
  double dissipated_ = 0;
  Load* loads_;
  std::vector<bool> held_;
};

}  // namespace bight::rod1d
