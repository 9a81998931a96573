#pragma once

#include <array>
#include <functional>
#include <vector>

#include "mechanics/contact_law.h"
#include "mechanics/effect.h"
#include "rod1d/contact_pairs.h"
#include "rod1d/curve.h"

namespace bight::rod1d {

/// Quadrature points of one segment: weights of its four nodes in each point, and the undeformed
/// arc length from the start of the rod to it [D].
struct SegmentSamples {
  std::vector<std::array<double, 4>> value;
  std::vector<double> arc;
  double spacing = 0;  ///< undeformed arc length that each stands for [D]
};

/// Contact between two segments of the round tube, as a double integral over their centerlines:
///
///   W = sum over s, t of ds dt law(|p(s) - q(t)| - 1)   [E D^3]
///
/// by the midpoint rule. Unlike the distance to a nearest point, which ceases to be smooth where
/// one strand winds around the other with curvature 1/D (every point of the bend is nearest then,
/// as in a tight knot), this is as smooth as the law, and needs no projection. The law is of short
/// range, so that along a line of contact only points within sqrt(2 onset) of each other count.
/// `exclusion`: points nearer than this along the rod do not touch. x: four nodes of either
/// segment.
Element<24> contact_element(const Eigen::Matrix<double, 24, 1>& x, const SegmentSamples& a,
                            const SegmentSamples& b, double exclusion, const ContactLaw& law,
                            Order order);

/// Two points of the rod that press on each other.
struct ContactPoint {
  int segment_a = 0, segment_b = 0;
  double u_a = 0, u_b = 0;  ///< place inside the segment, 0 to 1
  double gap = 0;           ///< [D]
  double force = 0;         ///< [E D^2]
};

/// Self-contact of the tube.
class Contact final : public Effect {
 public:
  /// `spacing`: of the quadrature points [D]; half of sqrt(2 onset) or less.
  Contact(const Rod& rod, double spacing);

  std::string_view name() const override { return "contact"; }
  int stencils() const override { return static_cast<int>(touching_.size()); }
  std::span<const int> coordinates(int i) const override { return touching_[i].coordinates; }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override;
  void refresh(const Vector& x) override;
  void couplings(const std::function<void(std::span<const int>)>& couple) const override;
  double longest_step(const Vector& x, const Vector& dx) const override;

  const ContactLaw& law() const { return law_; }
  /// To be changed between solves only: it is part of the energy.
  void set_law(const ContactLaw& law) { law_ = law; }

  /// Everything that touches at x, which was refreshed last.
  std::vector<ContactPoint> points(const Vector& x) const;

 private:
  struct Pair {
    int a, b;
    double gap;  ///< between quadrature points where it is small, otherwise less than that
    std::array<int, 24> coordinates;
  };
  Pair pair(int a, int b) const;
  double smallest_gap(const Vector& x, const Pair& at) const;
  double largest_move(const Vector& dx) const;

  int nodes_;
  std::vector<double> arc_;              ///< undeformed arc length of the nodes
  std::vector<SegmentSamples> samples_;  ///< by segment
  ContactLaw law_;
  Vector searched_;  ///< state for which windows_ were found
  std::vector<ContactWindow> windows_;
  std::vector<Pair> touching_, near_;
};

}  // namespace bight::rod1d
