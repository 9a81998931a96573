#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mechanics/effect.h"
#include "mechanics/unknowns.h"
#include "rod1d/effects/contact.h"
#include "rod1d/frames.h"

namespace bight::rod1d {

/// Two-fold symmetry of a rod between equal grips: half a turn about the x axis, which goes through
/// its middle node, maps node i on node N - i,
///
///   x' = x, y' = -y, z' = -z,   angle' = -angle of segment N - 1 - i,
///
/// where the reference frames are images too. A loose overhand knot has it. The equilibria of one
/// half with its image are equilibria of the whole (principle of symmetric criticality, Palais
/// 1979): half the unknowns, and none of the motions that cost a knot nothing. Those are the turn
/// about the pulling axis, the roll of the rod and the slide of the knot along it, which are
/// antisymmetric. With friction a knot that slides everywhere resists the slide along the rod no
/// more than without, so that round-off would decide about it.
class TwoFold {
 public:
  explicit TwoFold(int segments) : last_(segments) {}

  /// The start turned about z so that its symmetry axis is x, if it has one to `tolerance` [D].
  static std::optional<Polyline> aligned(const Polyline& start, double tolerance = 1e-6);

  /// Coordinates of the second half are images of the first; the middle node stays on the axis.
  std::vector<Image> images(bool twist) const;
  void hold_middle(std::vector<bool>& held) const;

  /// Makes the second half exactly the image of the first.
  void impose(std::vector<double>& arc) const;
  void impose(Vector& x) const;
  void impose(Frames& frames) const;
  /// Turns the directors of twist-free frames of a symmetric rod so that they are images.
  void align(Frames& frames) const;

  /// How often a stencil counts in a sum over one half and its image: twice in the first half, once
  /// where it is its own image, not at all in the second half.
  int weight(std::span<const int> coordinates) const;
  /// Contact points of the whole rod as points of one half that count for their images too.
  std::vector<ContactPoint> halved(std::vector<ContactPoint> points, double length) const;

 private:
  int last_;  ///< last node N
};

/// An effect of the whole rod, summed over one half and its image. `halved`: its stencils are those
/// of one half already, and count for their images too.
class HalfEffect final : public Effect {
 public:
  HalfEffect(Effect& whole, const TwoFold& symmetry, bool halved)
      : whole_(whole), symmetry_(symmetry), halved_(halved) {
    list();
  }

  std::string_view name() const override { return whole_.name(); }
  int stencils() const override { return static_cast<int>(kept_.size()); }
  std::span<const int> coordinates(int i) const override {
    return whole_.coordinates(kept_[i].stencil);
  }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override;
  void refresh(const Vector& x) override;
  void couplings(const std::function<void(std::span<const int>)>& couple) const override;
  double longest_step(const Vector& x, const Vector& dx) const override {
    return whole_.longest_step(x, dx);
  }

 private:
  struct Kept {
    int stencil, weight;
  };
  int weight(std::span<const int> coordinates) const {
    return halved_ ? 1 : symmetry_.weight(coordinates);
  }
  void list();

  Effect& whole_;
  TwoFold symmetry_;
  bool halved_;
  std::vector<Kept> kept_;
};

}  // namespace bight::rod1d
