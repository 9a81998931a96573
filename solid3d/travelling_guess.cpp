#include "solid3d/travelling_guess.h"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "solid3d/hex_reference.h"

namespace bight::solid3d {

namespace {

/// Near its ends a rod keeps the other guess, over this length [D] and so many layers at least:
/// what a grip does to its neighbourhood moves with the grip.
constexpr double kept_length = 1.5;
constexpr int kept_layers = 6;

/// Cubic interpolation (Lagrange) between columns or layers: of the four around a place.
struct Between {
  Between(double place, int count)
      : first(std::clamp(static_cast<int>(std::floor(place)) - 1, 0, count - 4)) {
    const double t = place - first;
    for (int i = 0; i < 4; ++i) {
      weight[i] = 1;
      for (int j = 0; j < 4; ++j) {
        if (j == i) continue;
        slope[i] = (slope[i] * (t - j) + weight[i]) / (i - j);
        weight[i] *= (t - j) / (i - j);
      }
    }
  }
  Vector of(const Eigen::MatrixXd& columns) const {
    Vector sum = Vector::Zero(columns.rows());
    for (int i = 0; i < 4; ++i) sum += weight[i] * columns.col(first + i);
    return sum;
  }
  int first;
  std::array<double, 4> weight{}, slope{};
};

/// A state by its sections. Layers may be asked for in between.
struct Sections {
  std::vector<SectionPlace> places;
  Eigen::MatrixXd shapes;  ///< by layer a column: its nodes as the section sees them

  Sections(const Mesh& mesh, const Vector& x)
      : places(section_places(mesh, x)), shapes(3 * mesh.points_per_layer(), mesh.layers()) {
    for (int k = 0; k < mesh.layers(); ++k)
      for (int p = 0; p < mesh.points_per_layer(); ++p)
        shapes.col(k).segment<3>(3 * p) = seen_from(places[k], x, 3 * mesh.node(k, p));
  }

  int count() const { return static_cast<int>(places.size()); }
  double inside(double layer) const { return std::clamp(layer, 0.0, count() - 1.0); }

  SectionPlace place(double layer) const {
    const Between near(layer, count());
    const Matrix3& R = places[std::lround(inside(layer))].rotation;
    Vector3 centre = Vector3::Zero(), turn = Vector3::Zero();
    for (int i = 0; i < 4; ++i) {
      const SectionPlace& neighbour = places[near.first + i];
      centre += near.weight[i] * neighbour.centre;
      turn += near.weight[i] * rotation_vector(R.transpose() * neighbour.rotation);
    }
    return {centre, R * rotation_by(turn)};
  }

  /// Where on the centerline a point lies abreast, found from `layer`. May lie beyond the ends.
  double abreast(const Vector3& point, double layer) const {
    constexpr int most_iterations = 20;
    for (int i = 0; i < most_iterations; ++i) {
      const Between near(layer, count());
      Vector3 centre = Vector3::Zero(), tangent = Vector3::Zero();
      for (int j = 0; j < 4; ++j) {
        centre += near.weight[j] * places[near.first + j].centre;
        tangent += near.slope[j] * places[near.first + j].centre;
      }
      const double step = tangent.dot(point - centre) / tangent.squaredNorm();
      layer += std::clamp(step, -1.0, 1.0);
      if (std::abs(step) < 1e-10) break;
    }
    return layer;
  }
};

/// The internal coordinates of a state, a column for the cells between two layers.
Eigen::MatrixXd internals(const Mesh& mesh, const Vector& x, int begin) {
  const int rows = mesh.section.cells() * internals_per_cell(mesh.degree());
  return Eigen::Map<const Eigen::MatrixXd>(&x[begin], rows, (mesh.layers() - 1) / mesh.degree());
}

/// A place between layers as one between the columns of internals().
double column_at(const Mesh& mesh, double layer) {
  return std::clamp(layer / mesh.degree() - 0.5, 0.0, (mesh.layers() - 1.0) / mesh.degree() - 1);
}
double column_at(const Mesh& mesh, const std::vector<double>& layer, int column) {
  return column_at(mesh,
                   0.5 * (layer[mesh.degree() * column] + layer[mesh.degree() * (column + 1)]));
}

}  // namespace

Vector travelling_guess(const Mesh& mesh, const std::vector<Station>& states, double ebar, Vector x,
                        int internal_begin) {
  const int layers = mesh.layers(), points = mesh.points_per_layer();
  if (layers < 2 * kept_layers + 4 * mesh.degree()) return x;
  const Station &last = states.back(), &earlier = states[states.size() - 2];
  const double ratio = (ebar - last.ebar) / (last.ebar - earlier.ebar);
  const Sections now(mesh, last.x), before(mesh, earlier.x), guessed(mesh, x);
  const Eigen::MatrixXd internals_now = internals(mesh, last.x, internal_begin),
                        internals_before = internals(mesh, earlier.x, internal_begin);

  // What each place on the present centerline has seen since: turn, shift and change of shape of
  // the section there, change of the internal coordinates.
  std::vector<double> was(layers), will_be(layers);
  Eigen::MatrixXd change(6 + 3 * points, layers);
#pragma omp parallel for schedule(static)
  for (int k = 0; k < layers; ++k) {
    const SectionPlace& place = now.places[k];
    was[k] = before.abreast(place.centre, k);
    will_be[k] = now.abreast(guessed.places[k].centre, k);
    const SectionPlace old = before.place(before.inside(was[k]));
    change.col(k) << rotation_vector(old.rotation.transpose() * place.rotation),
        old.rotation.transpose() * (place.centre - old.centre),
        now.shapes.col(k) - Between(before.inside(was[k]), layers).of(before.shapes);
  }
  Eigen::MatrixXd internals_change = internals_now;
  const int columns = static_cast<int>(internals_now.cols());
  for (int c = 0; c < columns; ++c)
    internals_change.col(c) -= Between(column_at(mesh, was, c), columns).of(internals_before);

  const auto travels = [&](int k) {
    return k >= kept_layers && k < layers - kept_layers && mesh.s[k] > kept_length &&
           mesh.s[k] < mesh.s.back() - kept_length && now.inside(will_be[k]) == will_be[k];
  };
#pragma omp parallel for schedule(static)
  for (int k = 0; k < layers; ++k) {
    if (!travels(k)) continue;
    const Between there(will_be[k], layers);
    const SectionPlace place = now.place(will_be[k]);
    const Vector further = ratio * there.of(change);
    const Matrix3 R = place.rotation * rotation_by(further.head<3>());
    const Vector3 centre = place.centre + place.rotation * further.segment<3>(3);
    const Vector shape = there.of(now.shapes) + further.tail(3 * points);
    for (int p = 0; p < points; ++p)
      x.segment<3>(3 * mesh.node(k, p)) = centre + R * shape.segment<3>(3 * p);
  }
  for (int c = 0; c < columns; ++c) {
    if (!travels(mesh.degree() * c) || !travels(mesh.degree() * (c + 1))) continue;
    const Between there(column_at(mesh, will_be, c), columns);
    x.segment(internal_begin + c * internals_now.rows(), internals_now.rows()) =
        there.of(internals_now) + ratio * there.of(internals_change);
  }
  return x;
}

Vector sliding_guess(const Mesh& mesh, const Vector& state, Vector ends, int internal_begin) {
  const int last = mesh.layers() - 1, points = mesh.points_per_layer();
  if (last < 4) return ends;
  const Sections now(mesh, state);
  std::vector<double> arc{0};
  for (int k = 1; k <= last; ++k)
    arc.push_back(arc.back() + (now.places[k].centre - now.places[k - 1].centre).norm());
  const std::vector<SectionPlace> moved = section_places(mesh, ends);
  const auto slides = [&](int k) {
    return now.places[k].rotation.col(2).dot(moved[k].centre - now.places[k].centre);
  };
  const double first = slides(0), stretch = 1 + (slides(last) - first) / arc.back();
  if (!(stretch > 0)) return ends;

  std::vector<double> will_be(arc.size());
  for (int k = 1; k < last; ++k) {
    const double there = first + stretch * arc[k];
    const auto next =
        std::clamp(std::ranges::upper_bound(arc, there), arc.begin() + 1, arc.end() - 1);
    const double layer =
        static_cast<double>(next - arc.begin()) - (*next - there) / (*next - *(next - 1));
    will_be[k] = now.inside(layer);
    SectionPlace place = now.place(will_be[k]);
    if (layer != will_be[k])  // beyond an end, which is straight
      place.centre += place.rotation.col(2) * (there - (layer < 0 ? 0 : arc.back()));
    const Vector shape = Between(will_be[k], mesh.layers()).of(now.shapes) / std::sqrt(stretch);
    for (int p = 0; p < points; ++p)
      ends.segment<3>(3 * mesh.node(k, p)) =
          place.centre + place.rotation * shape.segment<3>(3 * p);
  }
  will_be[last] = last;
  const Eigen::MatrixXd internals_now = internals(mesh, state, internal_begin);
  const int columns = static_cast<int>(internals_now.cols());
  for (int c = 0; c < columns; ++c)
    ends.segment(internal_begin + c * internals_now.rows(), internals_now.rows()) =
        Between(column_at(mesh, will_be, c), columns).of(internals_now);
  return ends;
}

}  // namespace bight::solid3d
