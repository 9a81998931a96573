#pragma once

#include <chrono>
#include <memory>

#include "mechanics/end_motion.h"
#include "mechanics/path.h"
#include "rod1d/effects.h"
#include "rod1d/rod_motion.h"

namespace bight::rod1d {

/// A tied rod at rest, where its path begins.
struct TiedRod {
  Rod rod;
  FrictionHistory history;  ///< its state; frames are empty without twist
  ContactLaw contact;
  double dissipated = 0;  ///< by friction so far [E D^3]
  double turn = 0;        ///< between the ends, from which the finish end's turn is counted [rad]
};

/// The rod as follow() sees it when it has inertia: the ends move at a given speed, and "solving"
/// for an ebar is to let time go on until they are there.
///
/// Between time steps, what an equilibrium would be iterated for is brought up to date: the contact
/// stiffness follows the overlap by a factor of e at most while an end moves by D, and friction
/// takes its normal forces, directions and elastic slip from the state in which the step begins.
class TimedRod final : public PathModel {
 public:
  TimedRod(const TiedRod& tied, const RodParameters& parameters);

  Vector predict(double ebar) const override;
  NewtonResult solve(const Vector& guess, double ebar) override;
  StepRow accept(const NewtonResult& result, double ebar) override;

  /// The present state in full.
  RodState state();
  std::vector<EffectCost> costs() const { return motion_->costs(); }

 private:
  void move_grips(double time, Vector& x, Vector& v) const;
  void catch_up();
  void freeze();
  double tension();

  RodParameters parameters_;
  Rod rod_;
  FrictionHistory history_;
  double tied_turn_;
  Frames source_;
  RodEffects effects_;
  EndMotion ends_;
  std::unique_ptr<RodMotion> motion_;
  double followed_to_;  ///< ebar to which the contact stiffness has followed
  int determinant_;
  double rubbed_away_ = 0;  ///< energy lost to friction so far [E D^3]
  std::string failure_;
  std::chrono::steady_clock::time_point began_;
};

}  // namespace bight::rod1d
