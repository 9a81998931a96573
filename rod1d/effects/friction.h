#pragma once

#include "mechanics/friction_law.h"
#include "rod1d/friction_spots.h"

namespace bight::rod1d {

/// Coulomb friction with stick and slip at the tube's surface. Normal forces, normals and the pairs
/// of points that touch are frozen with the spots: W is the incremental potential of one step,
/// convex in the slip. Its forces load bending (a moment about the centerline, of the lever D/2)
/// and twist.
class Friction final : public Effect {
 public:
  Friction(const Rod& rod, const Contact& contact, double coefficient,
           SlipOf slip_of = SlipOf::surface)
      : rod_(rod), contact_(contact), coefficient_(coefficient), slip_of_(slip_of) {}

  std::string_view name() const override { return "friction"; }
  int stencils() const override { return static_cast<int>(groups_.size()); }
  std::span<const int> coordinates(int i) const override { return groups_[i].coordinates; }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override;
  void couplings(const std::function<void(std::span<const int>)>& couple) const override;

  /// Freezes the spots that these contact points of x make, with its frames. To be changed between
  /// solves only.
  void freeze(const std::vector<ContactPoint>& points, const Vector& x, const Frames& frames,
              const FrictionHistory& history) {
    set_spots(friction_spots(rod_, rubbing_points(rod_, points), x, frames, history, slip_of_));
  }
  void set_spots(std::vector<FrictionSpot> spots);
  const std::vector<FrictionSpot>& spots() const { return spots_; }

  /// What the spots have become at x.
  std::vector<FrictionHistory::Memory> memory(const Vector& x) const;
  /// Elastic energy of sticking, and work lost by sliding since the last accepted state [E D^3].
  double stored(const Vector& x) const;
  double dissipated(const Vector& x) const;
  double normal_force() const;  ///< summed over the spots [E D^2]
  /// Adds to the gradient what it changes by where the normal forces follow dx, at the state for
  /// which the spots were frozen.
  void add_change(const Vector& dx, Vector& gradient) const;

 private:
  struct Group {  ///< spots between the same two segments
    int begin, end;
    std::array<int, friction_coordinates> coordinates;
  };
  FrictionLaw law(const FrictionSpot& spot) const;
  using Coordinates = Eigen::Matrix<double, friction_coordinates, 1>;
  struct Slip {
    Vector2 value;
    Eigen::Matrix<double, slip_variables, 2> gradient;  ///< by z
  };
  static Slip slip(const FrictionSpot& spot, const Coordinates& x);
  Coordinates gather(const Vector& x, int a, int b) const;
  double slip_size(const Vector& x, const FrictionSpot& spot) const;

  Rod rod_;
  const Contact& contact_;
  double coefficient_;
  SlipOf slip_of_;
  std::vector<FrictionSpot> spots_;
  std::vector<Group> groups_;
};

}  // namespace bight::rod1d
