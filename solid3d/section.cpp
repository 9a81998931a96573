#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solid3d/mesh.h"

namespace bight::solid3d {

namespace {

struct Division {
  int core;   ///< cells along a side of the square core
  int rings;  ///< layers of 4 * core cells around it
  int cells() const { return core * core + 4 * core * rings; }
};

/// The division with the number of cells nearest to what is asked, on a logarithmic scale. At most
/// core/2 rings: more of them make flat cells at the rim.
Division divide(int cells) {
  Division best{2, 1};
  double least = std::numeric_limits<double>::max();
  for (int core = 2; core <= 40; ++core)
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

}  // namespace

double Section::area() const {
  double sum = 0;
  for (size_t i = 0; i < rim.size(); ++i) {
    const Vector2 &a = points[rim[i]], &b = points[rim[(i + 1) % rim.size()]];
    sum += 0.5 * (a.x() * b.y() - b.x() * a.y());
  }
  return sum;
}

double Section::cell_width() const { return std::sqrt(area() / static_cast<double>(quads.size())); }

/// I = sum (x_i y_{i+1} - x_{i+1} y_i)(y_i^2 + y_i y_{i+1} + y_{i+1}^2) / 12 over the polygon.
double Section::second_moment() const {
  double sum = 0;
  for (size_t i = 0; i < rim.size(); ++i) {
    const Vector2 &a = points[rim[i]], &b = points[rim[(i + 1) % rim.size()]];
    sum += (a.x() * b.y() - b.x() * a.y()) * (a.y() * a.y() + a.y() * b.y() + b.y() * b.y()) / 12;
  }
  return sum;
}

Section make_section(int cells) {
  const auto [m, rings] = divide(cells);
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
