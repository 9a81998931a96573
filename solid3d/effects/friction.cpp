#include "solid3d/effects/friction.h"

#include <algorithm>

namespace bight::solid3d {

Eigen::Matrix<double, 3, 2> Friction::tangents(const Vector& x, const PatchWeights& own) const {
  const SurfacePoint p = contact_.surface().evaluate(x, own);
  Eigen::Matrix<double, 3, 2> E;
  E.col(0) = p.y_u.normalized();
  E.col(1) = p.normal.cross(Vector3(E.col(0)));
  return E;
}

Vector3 Friction::apart(const Vector& x, const Spot& spot) const {
  return contact_.surface().evaluate(x, spot.own).y - contact_.surface().evaluate(x, spot.facing).y;
}

Vector2 Friction::slip(const Vector& x, const Spot& spot) const {
  return spot.before + spot.tangents.transpose() * apart(x, spot);
}

void Friction::freeze(const Vector& x, const Vector& start) {
  spots_.clear();
  for (const Contact::Sample& sample : contact_.samples()) {
    if (!sample.faces || !contact_.law().touches(sample.gap)) continue;
    Spot spot;
    spot.sample = sample.id;
    spot.limit = -coefficient_ * sample.weight * contact_.law().slope(sample.gap);
    spot.own = contact_.own_weights(sample);
    spot.facing = contact_.surface().weights(sample.facing.x(), sample.facing.y());
    spot.normal = contact_.surface().evaluate(x, spot.facing).normal;
    spot.limit_by_gap = contact_.law().curvature(sample.gap) / contact_.law().slope(sample.gap);
    spot.coordinates = contact_.stencil(sample);
    spot.tangents = tangents(x, spot.own);
    const auto found = memory_.elastic_slip.find(sample.id);
    spot.before = (found == memory_.elastic_slip.end() ? Vector2(Vector2::Zero()) : found->second) -
                  tangents(start, spot.own).transpose() * apart(start, spot);
    spots_.push_back(spot);
  }
}

void Friction::element(const Vector& x, int i, Order order, ElementSlot& slot) const {
  const Spot& spot = spots_[static_cast<size_t>(i)];
  const Element<2> at = friction_element(slip(x, spot), law(spot));
  slot.energy = at.energy;
  if (order == Order::energy) return;

  Eigen::Matrix<double, 54, 2> ds;  // of the slip by the 18 nodes
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k) {
      const int a = 3 * j + k;
      ds.block<3, 2>(3 * a, 0) = spot.own.u[k] * spot.own.v[j] * spot.tangents;
      ds.block<3, 2>(27 + 3 * a, 0) = -spot.facing.u[k] * spot.facing.v[j] * spot.tangents;
    }
  Eigen::Matrix<double, 54, 1>::Map(slot.gradient) = ds * at.gradient;
  if (order == Order::gradient) return;
  const Eigen::Matrix<double, 54, 2> dsc = ds * at.hessian;
  Eigen::Matrix<double, 54, 54>::Map(slot.hessian).noalias() = dsc * ds.transpose();
}

void Friction::add_change(const Vector& x, const Vector& dx, Vector& gradient) const {
  for (const Spot& spot : spots_) {
    const Vector3 parting = apart(dx, spot);
    const Vector3 change = spot.limit_by_gap * spot.normal.dot(parting) *
                           (spot.tangents * friction_element(slip(x, spot), law(spot)).gradient);
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) {
        const int a = 3 * j + k;
        gradient.segment<3>(spot.coordinates[3 * a]) += spot.own.u[k] * spot.own.v[j] * change;
        gradient.segment<3>(spot.coordinates[27 + 3 * a]) -=
            spot.facing.u[k] * spot.facing.v[j] * change;
      }
  }
}

void Friction::accept(const Vector& x) {
  memory_.elastic_slip.clear();
  for (const Spot& spot : spots_) {
    const Vector2 s = slip(x, spot);
    const double size = s.norm();
    memory_.dissipated += law(spot).dissipated(size);
    memory_.elastic_slip[spot.sample] =
        law(spot).slides(size) ? Vector2(s * (largest_elastic_slip / size)) : s;
  }
}

double Friction::stored(const Vector& x) const {
  double sum = 0;
  for (const Spot& spot : spots_)
    sum += law(spot).energy(std::min(slip(x, spot).norm(), largest_elastic_slip));
  return sum;
}

double Friction::sliding_share(const Vector& x) const {
  double all = 0, sliding = 0;
  for (const Spot& spot : spots_) {
    all += spot.limit;
    if (law(spot).slides(slip(x, spot).norm())) sliding += spot.limit;
  }
  return all > 0 ? sliding / all : 0;
}

}  // namespace bight::solid3d
