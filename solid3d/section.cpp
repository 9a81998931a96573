#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "solid3d/mesh.h"

namespace bight::solid3d {

namespace {

struct Division {
  int core;   ///< cells along a side of the square core
  int rings;  ///< layers of 4 * core cells around it
  int cells() const { return core * core + 4 * core * rings; }
};

/// The division with the number of cells nearest to what is asked, on a logarithmic scale. At most
/// core/2 rings: more of them make flat cells at the rim. Straight sides need a core of 2.
Division divide(int cells, int degree) {
  const int smallest = degree == 1 ? 2 : 1;
  Division best{smallest, 1};
  double least = std::numeric_limits<double>::max();
  for (int core = smallest; core <= 40; ++core)
    for (int rings = 1; rings <= std::max(1, core / 2); ++rings) {
      const Division division{core, rings};
      const double off = std::abs(std::log(static_cast<double>(division.cells()) / cells));
      if (off < least - 1e-12) best = division, least = off;
    }
  return best;
}

/// From the square [-1, 1]^2 to a shape half-way to the disc: sides bulge so that the three cells
/// that meet at a corner of the core share the angle fairly.
Vector2 bulge(const Vector2& q) {
  const double reach = q.cwiseAbs().maxCoeff();
  if (reach == 0) return q;
  const Vector2 on_disc = q / q.norm() * reach;
  return 0.5 * q * std::sqrt(std::numbers::pi) / 2 + 0.5 * on_disc;
}

/// A side of the rim, r(t) = m + t d + t^2 c for t in [-1, 1]: a parabola through three points, or
/// a straight line.
struct Side {
  Vector2 m, d, c;
};

std::vector<Side> sides(const Section& section) {
  std::vector<Side> all;
  const auto at = [&](size_t i) { return section.points[section.rim[i % section.rim.size()]]; };
  const size_t step = static_cast<size_t>(section.degree);
  for (size_t i = 0; i < section.rim.size(); i += step) {
    const Vector2 a = at(i), b = at(i + step), chord = 0.5 * (a + b);
    const Vector2 m = step == 1 ? chord : at(i + 1);
    all.push_back({m, 0.5 * (b - a), chord - m});
  }
  return all;
}

/// The sum over the rim of int f(r) (x dy - y dx); f of up to fourth degree in t.
template <class F>
double around(const Section& section, F&& f) {
  // Gauss and Legendre, 4 points.
  const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2)),
               outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2));
  const double of_inner = (18 + std::sqrt(30.0)) / 36, of_outer = (18 - std::sqrt(30.0)) / 36;
  double sum = 0;
  for (const Side& side : sides(section))
    for (const auto& [t, weight] : {std::pair(-outer, of_outer), std::pair(-inner, of_inner),
                                    std::pair(inner, of_inner), std::pair(outer, of_outer)}) {
      const Vector2 r = side.m + t * side.d + t * t * side.c, dr = side.d + 2 * t * side.c;
      sum += weight * f(r) * (r.x() * dr.y() - r.y() * dr.x());
    }
  return sum;
}

/// Of degree 2: a point in the middle of every side, straight inside and on the circle of the rim,
/// and in the middle of every cell.
Section with_middles(const Section& coarse) {
  Section fine = coarse;
  fine.degree = 2;
  fine.quads.clear();
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) -> int& { return middles[std::minmax(a, b)]; };
  const auto add = [&](const Vector2& p) {
    fine.points.push_back(p);
    return static_cast<int>(fine.points.size()) - 1;
  };
  fine.rim.clear();
  for (size_t i = 0; i < coarse.rim.size(); ++i) {
    const int a = coarse.rim[i], b = coarse.rim[(i + 1) % coarse.rim.size()];
    const Vector2 chord = 0.5 * (coarse.points[a] + coarse.points[b]);
    middle(a, b) = add(chord.normalized() * coarse.points[a].norm());
    fine.rim.insert(fine.rim.end(), {a, middle(a, b)});
  }
  for (const auto& corner : coarse.quads) {
    std::array<int, 4> side;
    Vector2 centre = Vector2::Zero();  // Coons: half the middles of sides less a quarter of corners
    for (int i = 0; i < 4; ++i) {
      const int a = corner[i], b = corner[(i + 1) % 4];
      if (!middles.contains(std::minmax(a, b)))
        middle(a, b) = add(0.5 * (coarse.points[a] + coarse.points[b]));
      side[i] = middle(a, b);
      centre += 0.5 * fine.points[side[i]] - 0.25 * coarse.points[a];
    }
    const int m = add(centre);
    if (centre.norm() < 1e-12) fine.centre = {m};
    fine.quads.push_back({corner[0], side[0], m, side[3]});
    fine.quads.push_back({side[0], corner[1], side[1], m});
    fine.quads.push_back({m, side[1], corner[2], side[2]});
    fine.quads.push_back({side[3], m, side[2], corner[3]});
  }
  return fine;
}

}  // namespace

double Section::area() const {
  return 0.5 * around(*this, [](const Vector2&) { return 1.0; });
}

double Section::cell_width() const { return std::sqrt(area() / cells()); }

/// I = int y^2 dA = 1/4 the integral of y^2 (x dy - y dx) around it.
double Section::second_moment() const {
  return 0.25 * around(*this, [](const Vector2& r) { return r.y() * r.y(); });
}

std::vector<int> Section::cell(int number) const {
  if (degree == 1) {
    const auto& q = quads[number];
    return {q[0], q[1], q[3], q[2]};
  }
  const auto* q = &quads[4 * number];
  return {q[0][0], q[0][1], q[1][1], q[0][3], q[0][2], q[1][2], q[3][3], q[3][2], q[2][2]};
}

Section make_section(int cells, int degree) {
  const auto [m, rings] = divide(cells, degree);
  // Cells of equal area: the core takes its share m^2 / (m^2 + 4 m r) of the disc.
  const double core_radius = 0.5 * std::sqrt(m / (m + 4.0 * rings));
  Section section;

  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= m; ++i)
      section.points.push_back(core_radius * bulge({2.0 * i / m - 1, 2.0 * j / m - 1}));
  const auto core = [m = m](int i, int j) { return j * (m + 1) + i; };
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i)
      section.quads.push_back({core(i, j), core(i + 1, j), core(i + 1, j + 1), core(i, j + 1)});
  for (int j : {m / 2, (m + 1) / 2})
    for (int i : {m / 2, (m + 1) / 2})
      if (std::find(section.centre.begin(), section.centre.end(), core(i, j)) ==
          section.centre.end())
        section.centre.push_back(core(i, j));

  // Around the core, counter-clockwise from its corner at -45 degrees.
  std::vector<int> inner;
  for (int k = 0; k < m; ++k) inner.push_back(core(m, k));
  for (int k = 0; k < m; ++k) inner.push_back(core(m - k, m));
  for (int k = 0; k < m; ++k) inner.push_back(core(0, m - k));
  for (int k = 0; k < m; ++k) inner.push_back(core(k, 0));
  const int sides = 4 * m;
  const std::vector<int> boundary = inner;
  for (int ring = 1; ring <= rings; ++ring) {
    std::vector<int> outer;
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides - std::numbers::pi / 4;
      const Vector2 on_rim = 0.5 * Vector2(std::cos(angle), std::sin(angle));
      const double t = static_cast<double>(ring) / rings;
      outer.push_back(static_cast<int>(section.points.size()));
      section.points.push_back((1 - t) * section.points[boundary[k]] + t * on_rim);
    }
    for (int k = 0; k < sides; ++k) {
      const int next = (k + 1) % sides;
      section.quads.push_back({inner[k], outer[k], outer[next], inner[next]});
    }
    inner = outer;
  }
  section.rim = inner;
  if (degree == 2) section = with_middles(section);

  // A disc meshed with nodes on its rim loses stiffness (2.3 % of B at 24 sides): restore I.
  const double scale = std::pow(std::numbers::pi / 64 / section.second_moment(), 0.25);
  for (Vector2& p : section.points) p *= scale;
  return section;
}

Section scaled(Section section, double diameter) {
  for (Vector2& p : section.points) p *= diameter / section.diameter;
  section.diameter = diameter;
  return section;
}

}  // namespace bight::solid3d
