#include "rod1d/effects/friction.h"

#include <algorithm>
#include <tuple>

namespace bight::rod1d {

FrictionLaw Friction::law(const FrictionSpot& spot) const {
  return FrictionLaw::with_limit(coefficient_ * spot.at.force);
}

Friction::Slip Friction::slip(const FrictionSpot& spot, const Coordinates& x) {
  Slip out;
  const Eigen::Matrix<double, slip_variables, 1> dz = spot.map * x - spot.z;
  for (const int c : {0, 1}) {
    const Eigen::Matrix<double, slip_variables, 1> change = spot.hessian[c] * dz;
    out.value[c] = spot.slip[c] + spot.gradient.col(c).dot(dz) + 0.5 * change.dot(dz);
    out.gradient.col(c) = spot.gradient.col(c) + change;
  }
  return out;
}

Friction::Coordinates Friction::gather(const Vector& x, int a, int b) const {
  const auto coordinates = friction_stencil(rod_, a, b);
  Coordinates values;
  for (int k = 0; k < friction_coordinates; ++k) values[k] = x[coordinates[k]];
  return values;
}

double Friction::slip_size(const Vector& x, const FrictionSpot& spot) const {
  return slip(spot, gather(x, spot.a, spot.b)).value.norm();
}

void Friction::element(const Vector& x, int i, Order order, ElementSlot& slot) const {
  const Group& group = groups_[i];
  Element<friction_coordinates> out;
  Coordinates values;
  for (int k = 0; k < friction_coordinates; ++k) values[k] = x[group.coordinates[k]];
  for (int k = group.begin; k < group.end; ++k) {
    const FrictionSpot& spot = spots_[k];
    const Slip s = slip(spot, values);
    const Element<2> at = friction_element(s.value, law(spot));
    out.energy += at.energy;
    if (order == Order::energy) continue;
    out.gradient += spot.map.transpose() * (s.gradient * at.gradient);
    if (order == Order::gradient) continue;
    const Eigen::Matrix<double, slip_variables, slip_variables> by_z =
        s.gradient * at.hessian * s.gradient.transpose() + at.gradient[0] * spot.hessian[0] +
        at.gradient[1] * spot.hessian[1];
    out.hessian += spot.map.transpose() * (by_z * spot.map);
  }
  slot.set(out, order);
}

void Friction::couplings(const std::function<void(std::span<const int>)>& couple) const {
  contact_.for_pattern_segments([&](int a, int b) { couple(friction_stencil(rod_, a, b)); });
  for (const Group& group : groups_) couple(group.coordinates);
}

void Friction::set_spots(std::vector<FrictionSpot> spots) {
  spots_ = std::move(spots);
  groups_.clear();
  std::sort(spots_.begin(), spots_.end(), [](const FrictionSpot& l, const FrictionSpot& r) {
    return std::tuple(l.a, l.b, l.at.arc_a) < std::tuple(r.a, r.b, r.at.arc_a);
  });
  for (int k = 0; k < static_cast<int>(spots_.size()); ++k) {
    const FrictionSpot& spot = spots_[k];
    if (k == 0 || spots_[k - 1].a != spot.a || spots_[k - 1].b != spot.b)
      groups_.push_back({k, k, friction_stencil(rod_, spot.a, spot.b)});
    groups_.back().end = k + 1;
  }
}

std::vector<FrictionHistory::Memory> Friction::memory(const Vector& x) const {
  std::vector<FrictionHistory::Memory> list;
  for (const FrictionSpot& spot : spots_) {
    const Vector2 s = slip(spot, gather(x, spot.a, spot.b)).value;
    const double size = s.norm();
    const bool slides = law(spot).slides(size);
    list.push_back(
        {spot.at.arc_a, spot.at.arc_b, slides ? Vector2(s * (largest_elastic_slip / size)) : s});
  }
  std::sort(list.begin(), list.end(), [](const auto& l, const auto& r) {
    return std::tuple(l.arc_a, l.arc_b) < std::tuple(r.arc_a, r.arc_b);
  });
  return list;
}

double Friction::stored(const Vector& x) const {
  double sum = 0;
  for (const FrictionSpot& spot : spots_)
    sum += law(spot).energy(std::min(slip_size(x, spot), largest_elastic_slip));
  return sum;
}

double Friction::dissipated(const Vector& x) const {
  double sum = 0;
  for (const FrictionSpot& spot : spots_) sum += law(spot).dissipated(slip_size(x, spot));
  return sum;
}

void Friction::add_change(const Vector& dx, Vector& gradient) const {
  for (const FrictionSpot& spot : spots_) {
    double change = 0;  // of N
    for (const auto& [node, slope] : spot.at.force_slope)
      change += slope.dot(dx.segment<3>(Rod::position(node)));
    const Vector2 by_slip =
        friction_element(spot.slip, law(spot)).gradient * (change / spot.at.force);
    const Coordinates by_x = spot.map.transpose() * (spot.gradient * by_slip);
    const auto coordinates = friction_stencil(rod_, spot.a, spot.b);
    for (int k = 0; k < friction_coordinates; ++k) gradient[coordinates[k]] += by_x[k];
  }
}

double Friction::normal_force() const {
  double sum = 0;
  for (const FrictionSpot& spot : spots_) sum += spot.at.force;
  return sum;
}

}  // namespace bight::rod1d
