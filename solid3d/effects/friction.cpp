#include "solid3d/effects/friction.h"

#include <Eigen/Dense>
#include <algorithm>

namespace bight::solid3d {

Friction::Tangents Friction::tangents(const SurfacePoint& at) {
  Tangents E;
  E.col(0) = at.y_u.normalized();
  E.col(1) = at.normal.cross(Vector3(E.col(0)));
  return E;
}

Vector3 Friction::apart(const Vector& x, const Spot& spot) const {
  return contact_.surface().evaluate(x, spot.own).y - contact_.surface().evaluate(x, spot.facing).y;
}

Vector2 Friction::slip(const Vector& x, const Spot& spot) const {
  return spot.before + spot.tangents.transpose() * apart(x, spot);
}

void Friction::freeze(const Vector& x, const Vector& start) {
  const ContactSurface& surface = contact_.surface();
  spots_.clear();
  for (const Contact::Sample& sample : contact_.samples()) {
    if (!sample.faces || !contact_.law().touches(sample.gap)) continue;
    Spot spot;
    spot.sample = sample.id;
    spot.limit = -coefficient_ * sample.weight * contact_.law().slope(sample.gap);
    spot.limit_by_gap = contact_.law().curvature(sample.gap) / contact_.law().slope(sample.gap);
    spot.own = contact_.own_weights(sample);
    spot.facing = surface.weights(sample.facing.x(), sample.facing.y());
    spot.coordinates = contact_.stencil(sample);
    spot.here = surface.evaluate(x, spot.own);
    spot.there = surface.evaluate(x, spot.facing);
    spot.apart = spot.here.y - spot.there.y;
    spot.tangents = tangents(spot.here);
    spot.wandering = surface.projection_matrix(spot.there, spot.apart).inverse();

    const auto found = memory_.elastic_slip.find(sample.id);
    const SurfacePoint own_then = surface.evaluate(start, spot.own);
    const SurfacePoint facing_then = surface.evaluate(start, spot.facing);
    const Tangents tangents_then = tangents(own_then);
    spot.before = (found == memory_.elastic_slip.end() ? Vector2(Vector2::Zero()) : found->second) -
                  tangents_then.transpose() * (own_then.y - facing_then.y);
    spot.before_by_facing.col(0) = tangents_then.transpose() * facing_then.y_u;
    spot.before_by_facing.col(1) = tangents_then.transpose() * facing_then.y_v;
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

Vector2 Friction::wander(const Spot& spot, const SurfacePoint& here, const SurfacePoint& there) {
  // Of y_u . d = y_v . d = 0, with d = x - y along the normal.
  const Vector3 parting = here.y - there.y;
  return spot.wandering * Vector2(spot.there.y_u.dot(parting) + spot.apart.dot(there.y_u),
                                  spot.there.y_v.dot(parting) + spot.apart.dot(there.y_v));
}

Friction::Tangents Friction::turn(const Spot& spot, const SurfacePoint& here) {
  const Vector3 &e = spot.tangents.col(0), n = spot.here.normal;
  const double size = spot.here.y_u.cross(spot.here.y_v).norm();
  Vector3 of_n = (here.y_u.cross(spot.here.y_v) + spot.here.y_u.cross(here.y_v)) / size;
  of_n -= n * n.dot(of_n);
  const Vector3 of_e = (here.y_u - e * e.dot(here.y_u)) / spot.here.y_u.norm();
  Tangents change;
  change.col(0) = of_e;
  change.col(1) = of_n.cross(e) + n.cross(of_e);
  return change;
}

void Friction::add_change(const Vector& x, const Vector& dx, Vector& gradient) const {
  for (const Spot& spot : spots_) {
    const SurfacePoint here = contact_.surface().evaluate(dx, spot.own);
    const SurfacePoint there = contact_.surface().evaluate(dx, spot.facing);
    const Vector3 parting = here.y - there.y;
    const Vector2 along = wander(spot, here, there);
    const Tangents turned = turn(spot, here);

    const Element<2> at = friction_element(slip(x, spot), law(spot));
    const Vector2 slip_change =
        turned.transpose() * spot.apart + spot.before_by_facing * along -
        spot.tangents.transpose() * (along.x() * spot.there.y_u + along.y() * spot.there.y_v);
    const Vector2 traction_change =
        at.hessian * slip_change + spot.limit_by_gap * spot.there.normal.dot(parting) * at.gradient;
    const Vector3 force = spot.tangents * at.gradient;
    const Vector3 change = turned * at.gradient + spot.tangents * traction_change;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const int a = 3 * j + i;
        const double moved = along.x() * spot.facing.du[i] * spot.facing.v[j] +
                             along.y() * spot.facing.u[i] * spot.facing.dv[j];
        gradient.segment<3>(spot.coordinates[3 * a]) += spot.own.u[i] * spot.own.v[j] * change;
        gradient.segment<3>(spot.coordinates[27 + 3 * a]) -=
            spot.facing.u[i] * spot.facing.v[j] * change + moved * force;
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
