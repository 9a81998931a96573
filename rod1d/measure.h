#pragma once

#include <vector>

#include "rod1d/effects/contact.h"
#include "rod1d/rod.h"

namespace bight::rod1d {

Polyline nodes_of(const Rod& rod, const Vector& x);

/// Curvature at the nodes |kb|/l [1/D]; zero at the ends.
std::vector<double> curvature(const Rod& rod, const Vector& x);

/// Deformed over undeformed length of the segments.
std::vector<double> stretch(const Rod& rod, const Vector& x);

/// Twist per undeformed length at the nodes [1/D], from the angles of the segments against
/// twist-free frames; zero at the ends.
std::vector<double> twist_rate(const Rod& rod, const std::vector<double>& twist_angle);

/// Size of the contact forces per undeformed length, at the nodes [E D].
std::vector<double> contact_force(const Rod& rod, const std::vector<ContactPoint>& points);

/// Writhe of the open centerline: Gauss's double integral over all pairs of segments, exactly by
/// solid angles where they are near (Klenin and Langowski, Biopolymers 54, 307 (2000), method 1a),
/// at midpoints where they are far.
double writhe(const Polyline& line);

}  // namespace bight::rod1d
