#pragma once

#include <array>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "mechanics/contact_law.h"
#include "mechanics/effect.h"
#include "rod1d/contact_element.h"
#include "rod1d/contact_pairs.h"

namespace bight::rod1d {

/// Two points of the rod that press on each other: on a acts +force * normal, on b the opposite.
struct ContactPoint {
  int segment_a = 0, segment_b = 0;
  double u_a = 0, u_b = 0;           ///< place inside the segment, 0 to 1
  double s_a = 0, s_b = 0;           ///< undeformed arc length from the start of the rod [D]
  Vector3 normal = Vector3::Zero();  ///< unit vector from b to a
  double gap = 0;                    ///< [D]
  double force = 0;                  ///< [E D^2]
  double stiffness = 0;              ///< -dforce/dgap [E D]
};

/// Share of the overlap allowed that the stiffness of contact aims at.
constexpr double aimed_overlap = 0.6;

/// Self-contact of the tube.
class Contact final : public Effect {
 public:
  /// `spacing`: of the quadrature points [D]; half of sqrt(2 onset) or less.
  Contact(const Rod& rod, double spacing);

  std::string_view name() const override { return "contact"; }
  int stencils() const override { return static_cast<int>(listed_.size()); }
  std::span<const int> coordinates(int i) const override { return listed_[i].coordinates; }
  void element(const Vector& x, int i, Order order, ElementSlot& slot) const override;
  void refresh(const Vector& x) override;
  void couplings(const std::function<void(std::span<const int>)>& couple) const override;
  double longest_step(const Vector& x, const Vector& dx) const override;

  /// Calls `visit(a, b)` for the pairs of segments that are given room in the Hessian's pattern.
  void for_pattern_segments(const std::function<void(int, int)>& visit) const;

  const ContactLaw& law() const { return law_; }
  /// To be changed between solves only: it is part of the energy.
  void set_law(const ContactLaw& law);

  /// Everything that touches at x, which was refreshed last.
  std::vector<ContactPoint> points(const Vector& x) const;
  /// How many pairs of points that is, and the largest overlap [D].
  std::pair<int, double> touching(const Vector& x) const;

 private:
  using Stencil = std::array<int, 24>;
  /// Two segments and the quadrature points that are nearer than touching and a slack.
  struct SegmentPair {
    int a, b;
    size_t begin, end;  ///< in runs_
    Stencil coordinates;
  };
  std::span<const PointRun> runs_of(const SegmentPair& at) const {
    return {runs_.data() + at.begin, at.end - at.begin};
  }
  Stencil stencil(int a, int b) const;
  /// Calls `visit(a, b)` for the segments of windows_ that may be nearer at x than `gap`.
  template <class Visit>
  void for_near_segments(const Vector& x, double gap, Visit&& visit) const;
  struct Placed;
  void place_segment(const Vector& x, int k, Placed& placed) const;
  void list_runs(const Vector& x);
  void make_samples(int k);
  double largest_move(const Vector& dx) const;

  int nodes_;
  std::vector<double> rest_length_;
  double spacing_;
  std::vector<SegmentSamples> samples_;  ///< by segment; empty where nothing is near
  std::vector<double> arc_;              ///< undeformed arc length of the nodes
  ContactLaw law_;
  Vector searched_;  ///< state for which windows_ were found
  std::vector<ContactWindow> windows_;
  Vector listed_at_;  ///< state for which runs_ were listed
  std::vector<SegmentPair> listed_;
  std::vector<PointRun> runs_;
  double deepest_ = 0;  ///< smallest gap of a listed pair at listed_at_
};

}  // namespace bight::rod1d
