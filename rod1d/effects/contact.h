#pragma once

#include <array>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "mechanics/contact_law.h"
#include "mechanics/effect.h"
#include "rod1d/contact_pairs.h"
#include "rod1d/curve.h"

namespace bight::rod1d {

/// Quadrature points of one segment, a row each: weights of its four nodes in the point, and the
/// undeformed arc length from the start of the rod to it [D].
struct SegmentSamples {
  SegmentSamples() = default;
  /// `count` points in the middles of equal parts of a segment that begins at `arc`.
  SegmentSamples(const CurveSegment& curve, int count, double begin);

  Eigen::Matrix<double, Eigen::Dynamic, 4> value;
  Eigen::ArrayXd arc;
  double spacing = 0;  ///< undeformed arc length that each stands for [D]
  int size() const { return static_cast<int>(value.rows()); }
};

/// A quadrature point i of one segment, and those of another from `first` to `last`.
struct PointRun {
  int i, first, last;
};

/// Contact between two segments of the round tube, as a double integral over their centerlines:
///
///   W = sum over s, t of ds dt law(|p(s) - q(t)| - 1)   [E D^3]
///
/// by the midpoint rule. Unlike the distance to a nearest point, which ceases to be smooth where
/// one strand winds around the other with curvature 1/D (every point of the bend is nearest then,
/// as in a tight knot), this is as smooth as the law, and needs no projection. The law is of short
/// range, so that along a line of contact only points within sqrt(2 onset) of each other count.
/// `runs` hold all that touch. x: four nodes of either segment.
void contact_element(const Eigen::Matrix<double, 24, 1>& x, const SegmentSamples& a,
                     const SegmentSamples& b, std::span<const PointRun> runs, const ContactLaw& law,
                     Order order, ElementSlot& slot);

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
