#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "mechanics/assemble.h"
#include "mechanics/sparse_cholesky.h"

namespace bight {

/// A body in motion, as a list of effects sees it:
///
///   M a + alpha M v + dW/dx(x) = 0   for the unknowns; held coordinates follow prescribe(t)
///
/// M is diagonal, by coordinates. Time is in D sqrt(rho/E), so the unit of M is rho D^3.
struct MovingBody {
  Assembler& assembler;
  Vector mass;
  double damping = 0;  ///< alpha, in proportion to mass (Rayleigh) [1/time]
  /// Puts held coordinates where they are at a time, with their velocity. Empty: they stay.
  std::function<void(double time, Vector& x, Vector& v)> prescribe = {};
};

struct DynamicsOptions {
  /// Error allowed per step: of a coordinate [D or rad], and of a velocity over the larger of
  /// velocity_scale and the largest velocity there is.
  double tolerance = 1e-4;
  double velocity_scale = 1e-3;
  double max_step = std::numeric_limits<double>::infinity();  ///< [time]
  /// Largest change of a coordinate in one step: less than what strands need to pass each other.
  double largest_move = std::numeric_limits<double>::infinity();
};

/// Integrates the motion with steps of controlled error: SUNDIALS' door. The method is ARKODE's
/// ESDIRK 3(2) of second stage order, stiffly accurate and L-stable (Kennedy and Carpenter, NASA
/// TM-2016-219173): axial waves, which nobody wants to follow, die out, and slow motion may take
/// steps much longer than any vibration. Every stage is solved by Newton; its linear systems
///
///   dx = b_x + gamma dv,   (M + gamma alpha M + gamma^2 K) dv = M b_v - gamma K b_x
///
/// are symmetric and go to our sparse Cholesky. Where the tangent K is so unstable that the matrix
/// is not positive definite, the step is shortened until the motion is resolved.
class Dynamics {
 public:
  /// The body's assembler must outlive this object; its unknowns know no turns and no images.
  Dynamics(const MovingBody& body, const DynamicsOptions& options, double time, const Vector& x,
           const Vector& v);
  ~Dynamics();

  /// One step, not beyond `last`. False when the step cannot be taken; reason() says why.
  bool step(double last);
  /// To be called when forces changed between steps (frozen spots, stiffness).
  void forces_changed();

  double time() const;
  const Vector& x() const;  ///< by coordinates
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
