#include "solid3d/effects/contact.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "solid3d/surface_pairs.h"

namespace bight::solid3d {

namespace {

/// Pairs are searched anew when a node has moved this far [D].
constexpr double search_slack = 0.05;
/// One iteration may close a gap down to this overlap, no further [D].
constexpr double deepest_overlap = 0.08;
/// Samples this near to touching have their place in the pattern of the Hessian [D].
constexpr double pattern_margin = 0.03;
/// Of a patch, more than any sample spacing makes.
constexpr int most_samples = 4096;
/// Normals of facing surfaces must oppose each other at least this much.
constexpr double opposing = -0.1;

std::array<int, 9> patch_coordinates(const ContactSurface& surface, int around, int along) {
  std::array<int, 9> first;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      first[3 * j + i] = surface.coordinate(around + i - 1, along + j - 1);
  return first;
}

}  // namespace

Contact::Contact(std::span<const Mesh> strands, ContactLaw law, Options options)
    : surface_(strands), law_(law), options_(options) {}

PatchWeights Contact::own_weights(const Sample& sample) const {
  return surface_.face_weights(surface_.around(sample.patch) + sample.local.x(),
                               surface_.along(sample.patch) + sample.local.y());
}

std::array<int, 54> Contact::stencil(const Sample& sample) const {
  const PatchWeights facing = surface_.weights(sample.facing.x(), sample.facing.y());
  const PatchWeights face = own_weights(sample);
  const auto own = patch_coordinates(surface_, face.around, face.along);
  const auto other = patch_coordinates(surface_, facing.around, facing.along);
  std::array<int, 54> all;
  for (int a = 0; a < 9; ++a)
    for (int c = 0; c < 3; ++c) {
      all[3 * a + c] = own[a] + c;
      all[27 + 3 * a + c] = other[a] + c;
    }
  return all;
}

Vector3 Contact::position(const Vector& x, const Sample& sample) const {
  const PatchWeights w = own_weights(sample);
  return surface_.evaluate(x, w).y;
}

void Contact::find_samples(const Vector& x) {
  const double reach = 2 * options_.largest_move + 4 * search_slack;
  const auto near = near_patches(surface_, x, reach, options_.exclusion);
  std::vector<SurfacePoint> middle(near.size());
  for (int patch = 0; patch < surface_.patches(); ++patch)
    if (!near[patch].empty())
      middle[patch] =
          surface_.evaluate(x, surface_.weights(surface_.around(patch), surface_.along(patch)));

  samples_.clear();
  for (int patch = surface_.patch(0, options_.first_layer); patch < surface_.patches(); ++patch) {
    if (near[patch].empty()) continue;
    const bool on_first = options_.first_layer > 0 && surface_.along(patch) == options_.first_layer;
    const Vector2 extent = surface_.extent(patch);
    const int nu = std::max(1, static_cast<int>(std::lround(extent.x() / options_.sample_spacing)));
    const int nv = std::max(1, static_cast<int>(std::lround(extent.y() / options_.sample_spacing)));
    for (int j = 0; j < nv; ++j)
      for (int i = 0; i < nu; ++i) {
        Sample sample;
        sample.patch = patch;
        sample.id = patch * most_samples + j * nu + i;
        sample.local = {(i + 0.5) / nu - 0.5, (j + 0.5) / nv - 0.5};
        sample.weight = 0.5 * surface_.area(patch) / (nu * nv);
        // The patches of the first layer reach halfway before it.
        if (on_first && sample.local.y() < -1e-12) continue;
        if (on_first && sample.local.y() < 1e-12) sample.weight *= 0.5;
        const Vector3 at = position(x, sample);
        double least = std::numeric_limits<double>::max();
        for (int other : near[patch]) {
          if (middle[patch].normal.dot(middle[other].normal) > opposing) continue;
          const double square = (middle[other].y - at).squaredNorm();
          if (square >= least) continue;
          least = square;
          sample.facing = {surface_.around(other), surface_.along(other)};
        }
        if (least < std::numeric_limits<double>::max()) samples_.push_back(sample);
      }
  }
  searched_at_ = x;
  way_ = 0;  // all samples are new, and will be projected
}

void Contact::project(const Vector& x, Sample& sample) const {
  const PatchWeights w = own_weights(sample);
  const SurfacePoint here = surface_.evaluate(x, w);
  const auto uv = surface_.project(x, here.y, sample.facing);
  sample.faces = false;
  sample.seen_at = way_;
  if (!uv) return;
  const PatchWeights facing = surface_.weights(uv->x(), uv->y());
  const SurfacePoint there = surface_.evaluate(x, facing);
  const double apart = surface_.apart(w.along, static_cast<int>(std::lround(uv->y())));
  if (here.normal.dot(there.normal) > opposing || apart < 0.5 * options_.exclusion) return;
  sample.facing = *uv;
  sample.gap = there.normal.dot(here.y - there.y) - skins(sample, facing.along);
  // Deeper than a quarter of D is the far side of the strand, not an overlap.
  sample.faces = sample.gap > -0.25;
}

double Contact::farthest_move(const Vector& from, const Vector& to) const {
  double square = 0;
  for (int patch = 0; patch < surface_.patches(); ++patch) {
    const int c = surface_.coordinate(surface_.around(patch), surface_.along(patch));
    square = std::max(square, (to.segment<3>(c) - from.segment<3>(c)).squaredNorm());
  }
  return std::sqrt(square);
}

/// What the gap of a sample can have become since it was projected.
double Contact::least_gap(const Sample& sample) const {
  return sample.gap - 2 * (way_ - sample.seen_at);
}

void Contact::project_all(const Vector& x) {
  const int count = static_cast<int>(samples_.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (int i = 0; i < count; ++i) project(x, samples_[i]);
}

void Contact::refresh(const Vector& x) {
  const bool known = last_.size() == x.size();
  if (known && last_ == x) return;
  if (known) way_ += farthest_move(last_, x);
  last_ = x;
  if (searched_at_.size() != x.size() || farthest_move(searched_at_, x) > search_slack)
    find_samples(x);

  const int count = static_cast<int>(samples_.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (int i = 0; i < count; ++i)
    if (!samples_[i].faces || least_gap(samples_[i]) < 0.5 * law_.onset + pattern_margin)
      project(x, samples_[i]);

  touching_.clear();
  coordinates_.clear();
  for (int i = 0; i < count; ++i) {
    const Sample& sample = samples_[i];
    if (!sample.faces || !law_.touches(sample.gap)) continue;
    touching_.push_back(i);
    coordinates_.push_back(stencil(sample));
  }
}

void Contact::element(const Vector& x, int stencil, Order order, ElementSlot& slot) const {
  const Sample& sample = samples_[touching_[stencil]];
  const PatchWeights own = own_weights(sample);
  const PatchWeights facing = surface_.weights(sample.facing.x(), sample.facing.y());
  const SurfacePoint p = surface_.evaluate(x, facing);
  const double distance = p.normal.dot(surface_.evaluate(x, own).y - p.y);
  const double gap = distance - skins(sample, facing.along);
  slot.energy = sample.weight * law_.energy(gap);
  if (order == Order::energy) return;

  // Every variation is a weighted sum over the 18 nodes times n, y_u or y_v.
  std::array<double, 18> A, Bu, Bv;  // of x_sample - y, of y_u and of y_v
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const int a = 3 * j + i;
      A[a] = own.u[i] * own.v[j];
      Bu[a] = Bv[a] = 0;
      A[9 + a] = -facing.u[i] * facing.v[j];
      Bu[9 + a] = facing.du[i] * facing.v[j];
      Bv[9 + a] = facing.u[i] * facing.dv[j];
    }
  // Columns: dg, du, dv (motion of the projection), n . dy_u, n . dy_v.
  Eigen::Matrix<double, 54, 5> W;
  const double muu = p.y_u.squaredNorm(), muv = p.y_u.dot(p.y_v), mvv = p.y_v.squaredNorm();
  const double kuu = p.normal.dot(p.y_uu), kuv = p.normal.dot(p.y_uv), kvv = p.normal.dot(p.y_vv);
  Eigen::Matrix2d m, k;
  m << muu, muv, muv, mvv;
  k << kuu, kuv, kuv, kvv;
  const Eigen::Matrix2d M_inverse = (m - distance * k).inverse();
  for (int a = 0; a < 18; ++a) {
    W.block<3, 1>(3 * a, 0) = A[a] * p.normal;
    const Vector3 bu = Bu[a] * p.normal, bv = Bv[a] * p.normal;
    const Vector3 ru = A[a] * p.y_u + distance * bu, rv = A[a] * p.y_v + distance * bv;
    W.block<3, 1>(3 * a, 1) = M_inverse(0, 0) * ru + M_inverse(0, 1) * rv;
    W.block<3, 1>(3 * a, 2) = M_inverse(1, 0) * ru + M_inverse(1, 1) * rv;
    W.block<3, 1>(3 * a, 3) = bu;
    W.block<3, 1>(3 * a, 4) = bv;
  }
  const double slope = sample.weight * law_.slope(gap);
  Eigen::Matrix<double, 54, 1>::Map(slot.gradient) = slope * W.col(0);
  if (order == Order::gradient) return;

  // d2g = -(xi.b + b.xi) - xi.k xi + g (b + k xi).m^-1 (b + k xi), xi the motion (du, dv)
  Eigen::Matrix<double, 5, 5> core = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 2, 5> c = Eigen::Matrix<double, 2, 5>::Zero();
  c.block<2, 2>(0, 1) = k;
  c.block<2, 2>(0, 3).setIdentity();
  core = distance * c.transpose() * m.inverse() * c;
  core.block<2, 2>(1, 1) -= k;
  core.block<2, 2>(1, 3) -= Eigen::Matrix2d::Identity();
  core.block<2, 2>(3, 1) -= Eigen::Matrix2d::Identity();
  core *= slope;
  core(0, 0) += sample.weight * law_.curvature(gap);
  const Eigen::Matrix<double, 54, 5> WC = W * core;
  Eigen::Matrix<double, 54, 54>::Map(slot.hessian).noalias() = WC * W.transpose();
}

void Contact::couplings(const std::function<void(std::span<const int>)>& couple) const {
  // A facing point may wander to a neighbouring patch before the pattern is built again.
  std::vector<std::pair<int, int>> pairs;  // patches in the middle of own nodes and facing ones
  for (const Sample& sample : samples_) {
    if (!sample.faces || sample.gap > 0.5 * law_.onset + pattern_margin) continue;
    const PatchWeights facing = surface_.weights(sample.facing.x(), sample.facing.y());
    const PatchWeights face = own_weights(sample);
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        if (surface_.has_patch(facing.along + j))
          pairs.emplace_back(surface_.patch(face.around, face.along),
                             surface_.patch(facing.around + i, facing.along + j));
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::array<int, 18> clique;
  for (const auto& [own, facing] : pairs) {
    const auto a = patch_coordinates(surface_, surface_.around(own), surface_.along(own));
    const auto b = patch_coordinates(surface_, surface_.around(facing), surface_.along(facing));
    std::copy(a.begin(), a.end(), clique.begin());
    std::copy(b.begin(), b.end(), clique.begin() + 9);
    couple(clique);
  }
}

double Contact::longest_step(const Vector& x, const Vector& dx) const {
  double longest = 1;
  for (const Sample& sample : samples_) {
    if (!sample.faces) continue;
    const PatchWeights own = own_weights(sample);
    const PatchWeights facing = surface_.weights(sample.facing.x(), sample.facing.y());
    const Vector3 normal = surface_.evaluate(x, facing).normal;
    Vector3 closing = Vector3::Zero();
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        closing += own.u[i] * own.v[j] *
                   dx.segment<3>(surface_.coordinate(own.around + i - 1, own.along + j - 1));
        closing -= facing.u[i] * facing.v[j] *
                   dx.segment<3>(surface_.coordinate(facing.around + i - 1, facing.along + j - 1));
      }
    const double rate = normal.dot(closing);
    const double room = std::max(least_gap(sample), 0.0) + deepest_overlap;
    if (rate < 0 && -rate * longest > room) longest = room / -rate;
  }
  return longest;
}

double Contact::max_penetration() const {
  double deepest = 0;
  for (const Sample& sample : samples_)
    if (sample.faces) deepest = std::max(deepest, -sample.gap);
  return deepest;
}

bool Contact::stiffen(double bound) {
  const double overlap = max_penetration();
  if (overlap <= bound) return false;
  law_.stiffness *= std::clamp(1.5 * overlap / bound, 1.5, 4.0);
  return true;
}

}  // namespace bight::solid3d
