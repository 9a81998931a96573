#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mechanics/assemble.h"
#include "mechanics/effect.h"
#include "mechanics/friction_law.h"
#include "mechanics/unknowns.h"
#include "rod1d/effects/contact.h"
#include "rod1d/frames.h"

namespace bight::rod1d {

/// A symmetry of order two of a rod between equal grips, which maps node i on node N - i. Half a
/// turn about the x axis, which goes through the middle node (a loose overhand knot has it), or
/// inversion in the middle node (a figure-eight):
///
///   half turn  x' =  x, y' = -y, z' = -z,  angle' = -angle of segment N - 1 - i
///   inversion  x' = -x, y' = -y, z' = -z,  angle' =  angle
///
/// where the reference frames are images too. The equilibria of one half with its image are
/// equilibria of the whole (principle of symmetric criticality, Palais 1979), with half the
/// unknowns. The slide of the knot along the rod, which costs next to nothing, is antisymmetric.
/// With friction a knot that slides everywhere resists it no more than without, so that round-off
/// would decide about it. The half turn also excludes that the knot turns about the pulling axis,
/// and that the rod rolls; inversion excludes that one end turns against the other.
class TwoFold {
 public:
  enum class Kind { half_turn, inversion };
  TwoFold(Kind kind, int segments) : kind_(kind), last_(segments) {}

  /// The symmetry of a start whose chord is on the z axis with its middle at 0, if it has one to
  /// `tolerance` [D]. The start is turned about z so that the axis of a half turn is x, and made
  /// exactly symmetric.
  static std::optional<TwoFold> find(Polyline& start, int segments, double tolerance = 0.02);

  Kind kind() const { return kind_; }

  Vector3 image(const Vector3& point) const { return signs().cwiseProduct(point); }
  /// Coordinates of the second half are images of the first; the middle node stays where it is its
  /// own image.
  std::vector<Image> images(bool twist) const;
  void hold_middle(std::vector<bool>& held) const;

  /// Makes the second half exactly the image of the first.
  void impose(std::vector<double>& arc) const;
  void impose(Vector& x) const;
  void impose(Frames& frames) const;
  /// Sign of an angle's image.
  double angle_sign() const { return kind_ == Kind::half_turn ? -1 : 1; }
  /// Turns the directors of twist-free frames of a symmetric rod so that they are images.
  void align(Frames& frames) const;

  /// How often a stencil counts in a sum over one half and its image: twice in the first half, once
  /// where it is its own image, not at all in the second half.
  int weight(std::span<const int> coordinates) const;
  /// Effects of the whole rod, summed over one half and its image. Stencils of the effect `halved`
  /// are those of one half already.
  EffectList halves(const EffectList& whole, const Effect* halved = nullptr) const;
  /// Of one half that counts for both, and their images, in a rod of this length.
  std::vector<Rub> whole(std::vector<Rub> half, double length) const;
  /// Contact points of the whole rod as points of one half that count for their images too.
  std::vector<ContactPoint> halved(std::vector<ContactPoint> points, double length) const;

 private:
  Vector3 signs() const { return kind_ == Kind::half_turn ? Vector3(1, -1, -1) : -Vector3::Ones(); }

  Kind kind_;
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
