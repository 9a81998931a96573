#pragma once

#include <vector>

#include "mechanics/types.h"

namespace bight::coupling {

/// Natural cubic spline through points at parameters s: a C2 curve with its derivatives by s.
class Spline {
 public:
  Spline(std::vector<double> s, Polyline points);

  struct Point {
    Vector3 r, dr, ddr;
  };
  Point at(double s) const;

 private:
  std::vector<double> s_;
  Polyline r_, second_;  ///< points, and second derivatives there
};

}  // namespace bight::coupling
