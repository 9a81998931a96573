#pragma once

#include <algorithm>
#include <vector>

namespace bight {

/// How ebar goes from one waypoint to the next in time: at a steady speed v, which is taken up and
/// given up smoothly within `rise`, so that no shock runs along the rod:
///
///   speed(t) = v (3 u^2 - 2 u^3),   u = t/rise
class Leg {
 public:
  Leg(double from, double to, double speed, double rise)
      : from_(from),
        to_(to),
        speed_(to < from ? -speed : speed),
        rise_(std::min(rise, (to - from) / speed_)),
        duration_((to - from) / speed_ + rise_) {}

  double duration() const { return duration_; }
  bool passes(double ebar) const { return (ebar - from_) * (ebar - to_) <= 0; }
  double to() const { return to_; }

  double ebar(double t) const {
    t = std::clamp(t, 0.0, duration_);
    return t > 0.5 * duration_ ? to_ - travelled(duration_ - t) : from_ + travelled(t);
  }
  /// d ebar/dt.
  double rate(double t) const {
    const double u = std::clamp(std::min(t, duration_ - t) / rise_, 0.0, 1.0);
    return speed_ * u * u * (3 - 2 * u);
  }
  /// When ebar is passed.
  double time_of(double ebar) const {
    double low = 0, high = duration_;
    if (ebar == from_) return low;
    if (ebar == to_) return high;
    for (int k = 0; k < 80; ++k) {
      const double t = 0.5 * (low + high);
      ((this->ebar(t) - ebar) * speed_ < 0 ? low : high) = t;
    }
    return high;
  }

 private:
  double travelled(double t) const {
    if (t >= rise_) return speed_ * (t - 0.5 * rise_);
    const double u = t / rise_;
    return speed_ * rise_ * u * u * u * (1 - 0.5 * u);
  }
  double from_, to_, speed_, rise_, duration_;
};

/// The legs of a path, one after the other from time zero on.
class EndMotion {
 public:
  EndMotion(const std::vector<double>& waypoints, double speed, double rise)
      : first_(waypoints.front()) {
    double begin = 0;
    for (size_t w = 1; w < waypoints.size(); ++w) {
      if (waypoints[w] == waypoints[w - 1]) continue;
      legs_.push_back({begin, Leg(waypoints[w - 1], waypoints[w], speed, rise)});
      begin += legs_.back().leg.duration();
    }
  }
  double ebar(double t) const {
    const Timed* at = leg_at(t);
    return at ? at->leg.ebar(t - at->begin) : first_;
  }
  /// d ebar/dt.
  double rate(double t) const {
    const Timed* at = leg_at(t);
    return at ? at->leg.rate(t - at->begin) : 0;
  }
  /// The first time from `t` on at which ebar is met, on the leg that is under way or a later one.
  double next(double ebar, double t) const {
    for (const auto& [begin, leg] : legs_) {
      if (begin + leg.duration() < t || !leg.passes(ebar)) continue;
      const double time = begin + leg.time_of(ebar);
      if (time >= t) return time;
    }
    return t;
  }

 private:
  struct Timed {
    double begin;
    Leg leg;
  };
  const Timed* leg_at(double t) const {
    const Timed* found = nullptr;
    for (const Timed& at : legs_)
      if (!found || at.begin <= t) found = &at;
    return found;
  }
  double first_;
  std::vector<Timed> legs_;
};

}  // namespace bight
