#include "solid3d/measure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mechanics/knot_type.h"
#include "solid3d/section_motion.h"
#include "solid3d/skin_crossings.h"

namespace bight::solid3d {

namespace {

/// Of points along a line.
struct Extent {
  double low = std::numeric_limits<double>::max(), high = -low;
  void add(double at) { low = std::min(low, at), high = std::max(high, at); }
  double width() const { return high - low; }
};

}  // namespace

Polyline centerline(const Mesh& mesh, const Vector& x) {
  Polyline line;
  for (int k = 0; k < mesh.layers(); ++k) {
    Vector3 mean = Vector3::Zero();
    for (int p : mesh.section.centre) mean += x.segment<3>(3 * mesh.node(k, p));
    line.push_back(mean / static_cast<double>(mesh.section.centre.size()));
  }
  return line;
}

std::vector<double> curvature(const Polyline& r, const std::vector<double>& s) {
  const size_t n = r.size();
  std::vector<double> kappa(n, 0.0);
  for (size_t i = 1; i + 1 < n; ++i) {
    const double a = s[i] - s[i - 1], b = s[i + 1] - s[i];
    const Vector3 before = (r[i] - r[i - 1]) / a, behind = (r[i + 1] - r[i]) / b;
    const Vector3 dr = (b * before + a * behind) / (a + b), ddr = 2 * (behind - before) / (a + b);
    kappa[i] = dr.cross(ddr).norm() / dr.squaredNorm();
  }
  if (n > 2) kappa[0] = kappa[1], kappa[n - 1] = kappa[n - 2];
  return kappa;
}

std::vector<double> flattening(const Mesh& mesh, const Vector& x) {
  constexpr int directions = 36;
  const auto places = section_places(mesh, x);
  std::vector<double> result(static_cast<size_t>(mesh.layers()), 0.0);
  for (int k = 0; k < mesh.layers(); ++k) {
    for (int i = 0; i < directions; ++i) {
      const double angle = std::numbers::pi * i / directions;
      const Vector2 d(std::cos(angle), std::sin(angle));
      const Vector3 in_space = places[k].rotation.leftCols<2>() * d;
      // Against the undeformed polygon in the same direction: its width varies by cos(pi/n).
      Extent now, undeformed;
      for (int p : mesh.section.rim) {
        now.add(in_space.dot(x.segment<3>(3 * mesh.node(k, p))));
        undeformed.add(d.dot(mesh.section.points[p]));
      }
      result[k] = std::max(result[k], 1 - now.width() / undeformed.width());
    }
  }
  return result;
}

SectionLoads section_loads(const Mesh& mesh, const SolidEffects& effects, const Vector& x) {
  const Polyline centre = centerline(mesh, x);
  const int layers = mesh.layers();
  struct Load {
    Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
    int sides = 0;
  };
  std::vector<Load> loads(static_cast<size_t>(layers));
  for (int k = 0; k < layers; ++k) loads[k].sides = (k > 0) + (k + 1 < layers);
  for (const Effect* effect :
       {static_cast<Effect*>(effects.strain), static_cast<Effect*>(effects.hourglass)}) {
    if (!effect) continue;
    for (int i = 0; i < effect->stencils(); ++i) {
      const auto at = effect->coordinates(i);
      const int nodes = static_cast<int>(at.size()) / 3;
      Vector gradient = Vector::Zero(3 * nodes);
      ElementSlot slot{0, gradient.data(), nullptr};
      effect->element(x, i, Order::gradient, slot);
      const auto layer_of = [&](int a) { return at[3 * a] / 3 / mesh.points_per_layer(); };
      const int first = layer_of(0), last = first + mesh.degree();
      for (int a = 0; a < nodes; ++a) {
        const int layer = layer_of(a);
        if (layer != first && layer != last) continue;
        const Vector3 f = (layer == last ? 1 : -1) * gradient.segment<3>(3 * a);
        const auto add = [&](int k, double part) {
          loads[k].force += part * f;
          loads[k].moment += part * (x.segment<3>(at[3 * a]) - centre[k]).cross(f);
        };
        add(layer, 1.0 / loads[layer].sides);
        if (mesh.degree() == 2) add(first + 1, 0.5);
      }
    }
  }
  SectionLoads result;
  for (int k = 0; k < layers; ++k) {
    const Vector3 t =
        (centre[std::min(k + 1, layers - 1)] - centre[std::max(k - 1, 0)]).normalized();
    result.axial.push_back(loads[k].force.dot(t));
    result.twisting.push_back(loads[k].moment.dot(t));
    result.bending.push_back((loads[k].moment - result.twisting.back() * t).norm());
  }
  return result;
}

SolidState fields(const Mesh& mesh, const SolidEffects& effects, const Vector& x) {
  SolidState state;
  for (int n = 0; n < mesh.nodes(); ++n) state.nodes.push_back(x.segment<3>(3 * n));
  state.centerline = centerline(mesh, x);
  state.s = mesh.s;
  state.curvature = curvature(state.centerline, mesh.s);
  state.flattening = flattening(mesh, x);
  state.loads = section_loads(mesh, effects, x);
  state.determinant = knot_determinant(state.centerline);

  for (int cell = 0; cell < effects.strain->cells(); ++cell) {
    const auto s = effects.strain->stress(x, cell);
    const double mean = s.cauchy.trace() / 3;
    const Matrix3 deviator = s.cauchy - mean * Matrix3::Identity();
    state.jacobian.push_back(s.jacobian);
    state.pressure.push_back(mean);
    state.von_mises.push_back(std::sqrt(1.5) * deviator.norm());
    state.min_jacobian = std::min(state.min_jacobian, s.least_jacobian);
  }

  constexpr double nothing_near = 1.0;  // gap written where no strand faces [D]
  state.contact_pressure.assign(state.nodes.size(), 0.0);
  state.gap.assign(state.nodes.size(), nothing_near);
  if (!effects.contact) return state;
  effects.contact->project_all(x);
  const ContactSurface& surface = effects.contact->surface();
  std::vector<int> samples(state.nodes.size(), 0);
  for (const auto& sample : effects.contact->samples()) {
    const int node = surface.node(sample.patch);
    ++samples[node];
    if (!sample.faces) continue;
    state.contact_pressure[node] -= effects.contact->law().slope(sample.gap);
    state.gap[node] = std::min(state.gap[node], sample.gap);
  }
  for (size_t n = 0; n < samples.size(); ++n)
    if (samples[n] > 0) state.contact_pressure[n] /= samples[n];
  constexpr double hair = 0.002;  // [D]
  state.skin_crossings =
      skin_crossings(surface, x, 0.5 * effects.contact->max_penetration() + hair);
  return state;
}

}  // namespace bight::solid3d
