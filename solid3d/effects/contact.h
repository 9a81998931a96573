#pragma once

#include <array>
#include <span>
#include <vector>

#include "mechanics/contact_law.h"
#include "mechanics/effect.h"
#include "solid3d/contact_surface.h"

namespace bight::solid3d {

/// Frictionless contact of strands with each other and themselves, surface to surface by
/// quadrature: sample points of every patch are projected on the facing strand, and each adds half
/// its area times the energy of its gap,
///
///   E = sum_samples (A/2) phi(g),   g = n . (x_sample - y(u, v)) - skin - skin of the facing one,
///
/// with (u, v) the projection: y_u . d = y_v . d = 0. Both strands are sampled (two half-weighted
/// passes). Gradient and Hessian of g include the motion of the projection, so this is a true
/// potential with a symmetric tangent. (Konyukhov and Schweizerhof, Computational Contact
/// Mechanics, 2013, ch. 4: second variation of the gap.)
class Contact : public Effect {
 public:
  struct Options {
    double sample_spacing = 0.05;  ///< [D]
    double exclusion = 1.5;        ///< neighbours along the rod closer than this never touch [D]
    double largest_move = 0.15;    ///< of a node in one Newton iteration [D]
    int first_layer = 0;           ///< only the surface beyond this layer is sampled
  };
  Contact(std::span<const Mesh> strands, ContactLaw law, Options options);

  std::string_view name() const override { return "contact"; }
  int stencils() const override { return static_cast<int>(touching_.size()); }
  std::span<const int> coordinates(int stencil) const override {
    return coordinates_[static_cast<size_t>(stencil)];
  }
  void element(const Vector& x, int stencil, Order order, ElementSlot& slot) const override;
  void refresh(const Vector& x) override;
  void couplings(const std::function<void(std::span<const int>)>& couple) const override;
  double longest_step(const Vector& x, const Vector& dx) const override;

  ContactLaw& law() { return law_; }
  const ContactLaw& law() const { return law_; }
  /// Projects every sample. refresh() leaves out those that were so far apart that they cannot
  /// touch by now: their gaps are old.
  void project_all(const Vector& x);
  /// Largest overlap now [D].
  double max_penetration() const;
  /// Where strands overlap more than the bound [D]: makes contact stiffer; false where they do not.
  bool stiffen(double bound);

  const ContactSurface& surface() const { return surface_; }

  struct Sample {
    int patch = 0;
    int id = 0;          ///< the same for the same place in every search
    Vector2 local;       ///< place in the patch, in [-1/2, 1/2]^2
    double weight = 0;   ///< half its reference area [D^2]
    Vector2 facing;      ///< its projection (u, v) on the facing strand
    double gap = 0;      ///< [D]; meaningful when it faces something
    bool faces = false;  ///< a projection exists and the normals oppose each other
    double seen_at = 0;  ///< the surface's way since the search when it was projected last [D]
  };
  const std::vector<Sample>& samples() const { return samples_; }

  PatchWeights own_weights(const Sample& sample) const;
  /// Coordinates of the 9 nodes that carry a sample and the 9 around its facing point.
  std::array<int, 54> stencil(const Sample& sample) const;

 private:
  double skins(const Sample& sample, int facing_layer) const {
    return surface_.face_skin(surface_.along(sample.patch)) + surface_.skin(facing_layer);
  }
  void find_samples(const Vector& x);
  void project(const Vector& x, Sample& sample) const;
  double least_gap(const Sample& sample) const;
  double farthest_move(const Vector& from, const Vector& to) const;
  Vector3 position(const Vector& x, const Sample& sample) const;

  ContactSurface surface_;
  ContactLaw law_;
  Options options_;
  std::vector<Sample> samples_;                   ///< of patches that have others near
  std::vector<int> touching_;                     ///< samples that carry load, by stencil
  std::vector<std::array<int, 54>> coordinates_;  ///< by stencil: 9 nodes of the sample, 9 facing
  Vector searched_at_;                            ///< state of the last pair search
  Vector last_;                                   ///< state of the last refresh
  double way_ = 0;  ///< that the surface has gone at most since the last search [D]
};

}  // namespace bight::solid3d
