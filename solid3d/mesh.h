#pragma once

#include <array>
#include <span>
#include <vector>

#include "mechanics/types.h"
#include "solid3d/hex.h"

namespace bight::solid3d {

/// A disc cut into quadrilaterals (O-grid: a square core and rings around it). Scaled so that its
/// second moment is pi d^4/64, that of the disc.
///
/// Of degree 2 the cells have nine points: their sides are parabolas, those on the rim with all
/// three points on the circle. The points form the grid of a section whose cells are cut into four.
struct Section {
  int degree = 1;
  std::vector<Vector2> points;            ///< [D]
  std::vector<std::array<int, 4>> quads;  ///< of the grid of points, counter-clockwise: a cell, or
                                          ///< quarters 4c ... of cell c, corner i at place i
  std::vector<int> rim;                   ///< boundary points, counter-clockwise, equally spaced
  std::vector<int> centre;                ///< points whose mean is the centre: one, or four
  double diameter = 1;                    ///< d [D]
  double area() const;                    ///< [D^2]
  double second_moment() const;           ///< about x [D^4]
  double cell_width() const;              ///< mean of the cells, sqrt(area / cells) [D]
  int cells() const { return static_cast<int>(quads.size()) / (degree * degree); }
  /// Points of a cell's grid, (degree + 1)^2 row by row.
  std::vector<int> cell(int number) const;
};

/// About `cells` quadrilaterals: m x m core and r <= m/2 rings of 4 m (12, 21, 32, 60, 108 fit
/// exactly; of degree 2 also 5).
Section make_section(int cells, int degree = 1);
/// The same of another diameter [D]: a drum beside a rod.
Section scaled(Section section, double diameter);

struct Mesh;
/// Nodes and cells of strands, each numbered behind the one before.
HexMesh hexahedra(std::span<const Mesh> strands);

/// A rod swept from a section: layer k holds the section's points at arc length s[k]. A cell spans
/// as many layers as its degree.
/// Node number = first_node + layer * section.points.size() + point. The reference rod lies
/// straight along z.
struct Mesh {
  Section section;
  std::vector<double> s;  ///< undeformed arc length of the layers [D], 0 ... L0/D
  std::vector<HexCell> cells;
  int first_node = 0;  ///< behind those of other strands
  int layers() const { return static_cast<int>(s.size()); }
  int points_per_layer() const { return static_cast<int>(section.points.size()); }
  int nodes() const { return layers() * points_per_layer(); }
  int node(int layer, int point) const { return first_node + layer * points_per_layer() + point; }
  /// Reference position of a node [D].
  Vector3 reference(int node) const;
  /// Nodes and cells alone.
  HexMesh hexahedra() const { return bight::solid3d::hexahedra({this, 1}); }
  double cell_width() const { return section.cell_width(); }
  int degree() const { return section.degree; }
  /// Number of cells up to a layer between cells.
  int cells_before(int layer) const { return layer / degree() * section.cells(); }
};

/// `layers`: arc lengths between which cells lie; of degree 2 each has a further layer in its
/// middle.
Mesh make_mesh(const Section& section, const std::vector<double>& layers, int first_node = 0);

/// How long cells are where the tails of a rod end.
enum class TailEnds { coarse, fine };

/// Arc lengths of layers between cells: spacing `fine` between knot_begin and knot_end, growing
/// geometrically to `coarse` in the tails, which may be `fine` again at their ends. All in D; the
/// last entry is exactly `length`.
std::vector<double> graded_layers(double length, double fine, double coarse, double knot_begin,
                                  double knot_end, TailEnds ends = TailEnds::coarse);

}  // namespace bight::solid3d
