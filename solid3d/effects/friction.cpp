#include "solid3d/effects/friction.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace bight::solid3d {

namespace {

/// A sample takes over what was said of places no farther than this from its own [D].
constexpr double same_place = 1;

}  // namespace

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

    const SurfacePoint own_then = surface.evaluate(start, spot.own);
    const SurfacePoint facing_then = surface.evaluate(start, spot.facing);
    const Tangents tangents_then = tangents(own_then);
    auto found = memory_.elastic_slip.find(sample.id);
    if (found == memory_.elastic_slip.end() && !prescribed_.empty())
      found = memory_.elastic_slip.emplace(sample.id, prescribed(sample, start)).first;
    spot.remembered = found == memory_.elastic_slip.end() ? Vector2::Zero() : found->second;
    spot.before = spot.remembered - tangents_then.transpose() * (own_then.y - facing_then.y);
    spot.before_by_facing.col(0) = tangents_then.transpose() * facing_then.y_u;
    spot.before_by_facing.col(1) = tangents_then.transpose() * facing_then.y_v;
    spots_.push_back(spot);
  }
}

Element<2> Friction::traction(const Vector& x, const Spot& spot) const {
  const Vector2 s = slip(x, spot);
  if (prescribed_.empty()) return friction_element(s, law(spot));
  Element<2> out;
  out.gradient = law(spot).stick_stiffness * spot.remembered;
  out.energy = out.gradient.dot(s);
  out.hessian.setZero();
  return out;
}

void Friction::element(const Vector& x, int i, Order order, ElementSlot& slot) const {
  const Spot& spot = spots_[static_cast<size_t>(i)];
  const Element<2> at = traction(x, spot);
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

    const Element<2> at = traction(x, spot);
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
  const bool begins = !prescribed_.empty();
  if (begins)
    for (Spot& spot : spots_) spot.before += spot.remembered - slip(x, spot);
  prescribed_.clear();
  memory_.elastic_slip.clear();
  for (const Spot& spot : spots_) {
    const Vector2 s = slip(x, spot);
    const double size = s.norm();
    if (!begins) memory_.dissipated += law(spot).dissipated(size);
    memory_.elastic_slip[spot.sample] =
        law(spot).slides(size) ? Vector2(s * (largest_elastic_slip / size)) : s;
  }
}

void Friction::prescribe(std::vector<Rub> rubs, const Vector& start) {
  for (size_t i = 0, count = rubs.size(); i < count; ++i)
    rubs.push_back({rubs[i].s_b, rubs[i].s_a, -rubs[i].elastic_slip});
  std::sort(rubs.begin(), rubs.end(), [](const Rub& l, const Rub& r) { return l.s_a < r.s_a; });
  prescribed_ = std::move(rubs);
  // Once and for all: where a sample followed now this, now that, Newton would not settle.
  for (const Contact::Sample& sample : contact_.samples())
    if (sample.faces) memory_.elastic_slip[sample.id] = prescribed(sample, start);
}

std::pair<double, double> Friction::arc_lengths(const Contact::Sample& sample) const {
  const ContactSurface& surface = contact_.surface();
  return {surface.arc_length_at(surface.along(sample.patch) + sample.local.y()),
          surface.arc_length_at(sample.facing.y())};
}

Vector2 Friction::prescribed(const Contact::Sample& sample, const Vector& start) const {
  const auto [s, s_facing] = arc_lengths(sample);
  const auto first = std::lower_bound(prescribed_.begin(), prescribed_.end(), s - same_place,
                                      [](const Rub& rub, double arc) { return rub.s_a < arc; });
  Vector3 nearest = Vector3::Zero();
  double least = same_place;
  for (auto rub = first; rub != prescribed_.end() && rub->s_a < s + least; ++rub) {
    const double apart = std::hypot(rub->s_a - s, rub->s_b - s_facing);
    if (apart < least) least = apart, nearest = rub->elastic_slip;
  }
  const SurfacePoint at = contact_.surface().evaluate(start, contact_.own_weights(sample));
  return tangents(at).transpose() * nearest;
}

std::vector<Rub> Friction::rubs(const Vector& x) const {
  std::vector<Rub> list;
  for (const Contact::Sample& sample : contact_.samples()) {
    const auto found = memory_.elastic_slip.find(sample.id);
    if (!sample.faces || found == memory_.elastic_slip.end()) continue;
    const auto [s, s_facing] = arc_lengths(sample);
    const SurfacePoint at = contact_.surface().evaluate(x, contact_.own_weights(sample));
    list.push_back({s, s_facing, tangents(at) * found->second});
  }
  return list;
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
