#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "mechanics/assemble.h"
#include "mechanics/damping.h"
#include "mechanics/sparse_cholesky.h"

namespace bight {

/// An implicit stage of a time step. With x' = v its equations of motion are those of the state
/// where
///
///   W(x) + strength/2 |x - target|^2_M
///
/// is least, strength = (1 + gamma alpha)/gamma^2, gamma the stage's share of the time step.
struct Stage {
  double time = 0, strength = 0;
  Vector target;  ///< by coordinates
  Vector from;    ///< the newest state that was solved, by coordinates
  Vector step;    ///< from there to this stage, as its velocities say
};

/// A body in motion, as a list of effects sees it:
///
///   M a + alpha M v + dW/dx(x) = 0   for the unknowns; held coordinates follow prescribe(t)
///
/// M is diagonal, by coordinates (Unknowns::moved_mass). Time is in D sqrt(rho/E), so the unit of M
/// is rho D^3. Internal coordinates are settled: they have no inertia.
struct MovingBody {
  Assembler& assembler;
  Vector mass;
  double damping = 0;  ///< alpha, in proportion to mass (Rayleigh) [1/time]
  /// Puts held coordinates where they are at a time, with their velocity. Empty: they stay.
  std::function<void(double time, Vector& x, Vector& v)> prescribe = {};
  /// Solves a stage: the state by coordinates, or nothing. Empty: Newton without a search.
  std::function<std::optional<Vector>(const Stage&)> minimise = {};
};

struct DynamicsOptions {
  /// Error allowed per step: of a coordinate [D or rad], and of a velocity over the larger of
  /// velocity_scale and the largest velocity there is.
  double tolerance = 1e-4;
  double velocity_scale = 1e-3;
  double first_step = 0;                                      ///< that is tried [time]; 0: chosen
  double max_step = std::numeric_limits<double>::infinity();  ///< [time]
  /// Largest change of a coordinate in one step: less than what strands need to pass each other.
  double largest_move = std::numeric_limits<double>::infinity();
};

/// How a body moves in time: damped or not, its held coordinates at rest or driven, how exactly.
/// Time in D sqrt(rho/E), velocities in sqrt(E/rho).
struct MotionParameters {
  Damping damping;
  DynamicsOptions options;
  std::function<void(double time, Vector& x, Vector& v)> prescribe;
};

/// Integrates the motion with steps of controlled error: SUNDIALS' door. The methods are ARKODE's
/// diagonally implicit ones, of third order with an error estimate of second, stiffly accurate and
/// L-stable: axial waves, which nobody wants to follow, die out, and slow motion may take steps
/// much longer than any vibration.
///
/// Without `minimise` it is ESDIRK 3(2) of second stage order (Kennedy and Carpenter, NASA
/// TM-2016-219173). Every stage is solved by Newton; its linear systems
///
///   dx = b_x + gamma dv,   (M + gamma alpha M + gamma^2 K) dv = M b_v - gamma K b_x
///
/// are symmetric and go to our sparse Cholesky. Where the tangent K is so unstable that the matrix
/// is not positive definite, the step is shortened until the motion is resolved.
///
/// With `minimise` it is SDIRK 3 (Alexander, SIAM J. Numer. Anal. 14, 1006 (1977), theorem 5),
/// whose stages are energies of the model's own Newton. No stage is explicit and rates are deduced
/// from the stages: accelerations that a change of forces (a stiffer contact, other friction) or
/// the residual of a solve would give to light cells never enter the next step.
class Dynamics {
 public:
  /// The body's assembler must outlive this object.
  Dynamics(const MovingBody& body, const DynamicsOptions& options, double time, const Vector& x,
           const Vector& v);
  ~Dynamics();

  /// One step, not beyond `last`. False when the step cannot be taken; reason() says why.
  bool step(double last);
  /// To be called when forces changed between steps (frozen spots, stiffness).
  void forces_changed();

  double time() const;
  double next_step() const;  ///< that will be tried
  const Vector& x() const;   ///< by coordinates
  const Vector& v() const;
  const std::string& reason() const;

  /// Gradient of the energy at the present state: on held coordinates, what moves them [E D^2].
  const Vector& gradient();
  double potential_energy();
  double kinetic_energy() const;

  int steps() const, iterations() const, factorisations() const;

 private:
  struct Package;
  std::unique_ptr<Package> package_;
};

}  // namespace bight
