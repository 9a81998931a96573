#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "mechanics/friction_law.h"
#include "solid3d/effects/contact.h"

namespace bight::solid3d {

/// What friction remembers of accepted steps.
struct FrictionMemory {
  std::map<int, Vector2> elastic_slip;  ///< by contact sample, in its tangents [D]
  double dissipated = 0;                ///< by all accepted steps [E D^3]
};

/// Coulomb friction with stick and slip of the surface, at the samples of contact. In one step a
/// sample's slip against the material point that faces it is
///
///   s = m + E^T (x - y)|now - E^T (x - y)|start of the step,
///
/// m its elastic slip at the start and E two unit tangents that the surface carries along. Its
/// energy is that of the friction law at |s|. Which points face each other, their normal force and
/// E(now) are frozen: the tangent of the spots is symmetric, and positive. They are taken anew at
/// every iteration, with add_change() for the tangent's other part, or, from a poor guess, from the
/// solution of a solve until the end tension stays (Alart and Curnier 1991 iterate that way).
class Friction final : public Effect {
 public:
  Friction(const Contact& contact, double coefficient)
      : contact_(contact), coefficient_(coefficient) {}

  std::string_view name() const override { return "friction"; }
  int stencils() const override { return static_cast<int>(spots_.size()); }
  std::span<const int> coordinates(int i) const override {
    return spots_[static_cast<size_t>(i)].coordinates;
  }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override;

  /// Freezes what the contact samples say of x, to which contact has been refreshed last; slips
  /// count from `start`, the newest accepted state. To be called between solves.
  void freeze(const Vector& x, const Vector& start);
  /// Adds the change of the gradient with dx that freezing leaves out, to first order: limits
  /// follow the normal forces, spots the points that face each other, their tangents turn with the
  /// surface.
  void add_change(const Vector& x, const Vector& dx, Vector& gradient) const;
  /// Takes x over as the newest accepted state: what every sample remembers, and what sliding cost.
  void accept(const Vector& x);

  /// Until the next accepted state, tractions do not follow slip: their directions, and their sizes
  /// against the normal force, are those of the elastic slips that another model of the knot had at
  /// the nearest places of the one rod. For a start, to which contact has been refreshed last: what
  /// moves while it is relaxed is not what has rubbed. Nothing is dissipated then.
  void prescribe(std::vector<Rub> rubs, const Vector& start);
  bool prescribes() const { return !prescribed_.empty(); }
  /// What is remembered, as vectors at the newest accepted state x, to which contact has been
  /// refreshed last.
  std::vector<Rub> rubs(const Vector& x) const;

  /// What has been dissipated so far is of the start's making, and not counted.
  void begin_books() { memory_.dissipated = 0; }

  const FrictionMemory& memory() const { return memory_; }
  void remember(FrictionMemory memory) { memory_ = std::move(memory), prescribed_.clear(); }

  double stored(const Vector& x) const;                     ///< elastic energy of sticking [E D^3]
  double dissipated() const { return memory_.dissipated; }  ///< by all accepted steps [E D^3]
  double sliding_share(const Vector& x) const;  ///< of the normal force, where spots slide

 private:
  using Tangents = Eigen::Matrix<double, 3, 2>;
  struct Spot {
    int sample;  ///< its id
    double limit;
    double limit_by_gap;  ///< dlimit/dgap over limit [1/D]
    PatchWeights own, facing;
    std::array<int, 54> coordinates;
    Tangents tangents;
    Vector2 before;             ///< m - E^T (x - y) at the start of the step
    Vector2 remembered;         ///< m
    Vector3 apart;              ///< x - y where it was frozen [D]
    SurfacePoint here, there;   ///< both places of the surface, where it was frozen
    Eigen::Matrix2d wandering;  ///< motion (du, dv) of the facing point by d(y_u . d, y_v . d)
    Eigen::Matrix2d before_by_facing;  ///< dbefore/d(u, v) of the facing point
  };
  /// Motion (du, dv) of the facing point, and change of the tangents, with a motion of the surface
  /// under both places.
  static Vector2 wander(const Spot& spot, const SurfacePoint& here, const SurfacePoint& there);
  static Tangents turn(const Spot& spot, const SurfacePoint& here);

  FrictionLaw law(const Spot& spot) const { return FrictionLaw::with_limit(spot.limit); }
  Element<2> traction(const Vector& x, const Spot& spot) const;
  /// Undeformed arc lengths of a sample and of what it faces [D].
  std::pair<double, double> arc_lengths(const Contact::Sample& sample) const;
  /// The elastic slip that is prescribed for the places nearest to a sample and what it faces, in
  /// its tangents at the start; zero where none are near.
  Vector2 prescribed(const Contact::Sample& sample, const Vector& start) const;
  Vector3 apart(const Vector& x, const Spot& spot) const;
  static Tangents tangents(const SurfacePoint& at);
  Vector2 slip(const Vector& x, const Spot& spot) const;

  const Contact& contact_;
  double coefficient_;
  std::vector<Spot> spots_;
  FrictionMemory memory_;
  std::vector<Rub> prescribed_;  ///< sorted by s_a, every pair from both sides
};

}  // namespace bight::solid3d
