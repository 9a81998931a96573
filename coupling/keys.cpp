#include "coupling/keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "solid3d/elements.h"
#include "solid3d/material.h"

namespace bight::coupling {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Range above(double low) { return {low, infinity, true}; }

// Levenshtein distance: insertions, deletions and replacements between two words.
int edits(std::string_view a, std::string_view b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (size_t i = 1; i <= a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i);
    for (size_t j = 1; j <= b.size(); ++j) {
      const int replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

std::string_view in_a_study(Fineness fineness) {
  switch (fineness) {
    case Fineness::size:
      return "    finer when: smaller\n";
    case Fineness::count:
    case Fineness::count_per_area:
      return "    finer when: larger\n";
    default:
      return "";
  }
}

std::vector<std::string_view> element_names() {
  std::vector<std::string_view> names;
  for (const solid3d::HexElement& element : solid3d::hex_elements()) names.push_back(element.name);
  return names;
}

std::string_view last_part(std::string_view path) { return path.substr(path.rfind('.') + 1); }

}  // namespace

const std::vector<Key>& all_keys() {
  using enum Kind;
  // clang-format off
  // path, kind, unit, range, words, default, how it is found otherwise, meaning
  static const std::vector<Key> keys = {
      {"title", text, "", {}, {}, R"("")", "", "What the scene is; copied into the results"},
      {"fidelities", words, "", {}, {"rod", "solid"}, R"(["rod", "solid"])", "",
       "What `bight run` simulates; the rod always ties the knot", Fineness::choice},

      {"rod.length", quantity, "m", above(0), {}, "", "required", "Undeformed length L0"},
      {"rod.diameter", quantity, "m", above(0), {}, "", "required", "Undeformed diameter D"},
      {"rod.natural_curvature", quantity, "1/m", {-1e6, 1e6}, {}, "0", "",
       "Of the free rod, alike everywhere; the rod alone, and with twist"},
      {"rod.natural_twist", quantity, "rad/m", {-1e6, 1e6}, {}, "0", "",
       "Of the free rod's material frames, about which natural_curvature turns along it: a helix"},

      {"material.model", word, "", {}, solid3d::material_names(), R"("neo-hookean")", "",
       "Stored energy of the solid; the rod is linear in its strains"},
      {"material.youngs_modulus", quantity, "Pa", above(0), {}, "",
       "required, unless c10 and c01 or ogden_moduli say it",
       "Young's modulus E at small strain"},
      {"material.poissons_ratio", number, "", {0, 0.5}, {}, "0.5", "",
       "Poisson's ratio; 0.5 is incompressible, which the solid approaches by bulk_to_shear"},
      {"material.bulk_to_shear", number, "", {0.66, 1e6}, {}, "",
       "1000 for poissons_ratio 0.5, else 2 (1 + nu)/(3 (1 - 2 nu))",
       "Bulk modulus over shear modulus of the solid"},
      {"material.c10", quantity, "Pa", {0, infinity}, {}, "", "needed by mooney-rivlin",
       "Of C10 (I1 - 3) + C01 (I2 - 3); the shear modulus is 2 (C10 + C01), D1 is 2/K"},
      {"material.c01", quantity, "Pa", {0, infinity}, {}, "", "needed by mooney-rivlin", "See c10"},
      {"material.ogden_moduli", quantities, "Pa", {}, {}, "", "needed by ogden",
       "mu_i, at most 3, of the sum of 2 mu_i/a_i^2 (l1^a_i + l2^a_i + l3^a_i - 3); their sum is the shear modulus"},
      {"material.ogden_exponents", numbers, "", {-30, 30}, {}, "", "needed by ogden", "a_i, see ogden_moduli"},
      {"material.density", quantity, "kg/m^3", above(0), {}, "1160", "",
       "Mass per volume; used by effects that know inertia or gravity"},

      {"material.susceptibility", number, "", {0, 1e6}, {}, "1", "",
       "Magnetic, per volume; used with effects.magnetic_field"},

      {"knot.type", word, "", {}, {"overhand", "figure-eight"}, "",
       "overhand, unless knot.centerline is given", "Knot to be tied"},
      {"knot.start", word, "", {}, {"loose", "straight"}, R"("loose")", "",
       "Where knot.type comes from: laid out loosely, or tied by moves of a straight rod's ends"},
      {"knot.centerline", file, "", {}, {}, "", "none: knot.type is tied",
       "Tied start instead of knot.type: CSV x,y,z in metres, or rows of x y z theta"},

      {"ends.start", word, "", {}, {"clamped"}, R"("clamped")", "", "Grip at s = 0"},
      {"ends.finish", word, "", {}, {"free-twist", "clamped"}, R"("free-twist")", "",
       "Grip at s = L0; free-twist may turn about the pulling axis"},
      {"ends.turn", quantity, "rad", {-1e4, 1e4}, {}, "0", "",
       "Turn given to a clamped finish end of the rod once the knot is tied free of twist"},

      {"effects.contact", boolean, "", {}, {}, "true", "", "Strands keep each other outside"},
      {"effects.friction", number, "", {0, 5}, {}, "0", "", "Coulomb coefficient of the surface"},
      {"effects.twist", boolean, "", {}, {}, "",
       "false for a frictionless, naturally straight rod with a free-twist end, else true",
       "The rod's twist angles are unknowns"},
      {"effects.gravity", quantity, "m/s^2", {0, 1e6}, {}, "0", "",
       "Acceleration of gravity, by which mass is drawn"},
      {"effects.gravity_direction", numbers, "", {-1, 1}, {}, "[0, -1, 0]", "",
       "Where gravity points; the ends lie on the z axis"},
      {"effects.magnetic_field", quantity, "T", {0, 1e3}, {}, "0", "",
       "Uniform field that turns a paramagnetic rod into its line"},
      {"effects.magnetic_direction", numbers, "", {-1, 1}, {}, "[1, 0, 0]", "",
       "Where the magnetic field points; the ends lie on the z axis"},
      {"effects.inertia", boolean, "", {}, {}, "false", "",
       "The path is followed in time, at path.speed, instead of through equilibria"},
      {"effects.damping", quantity, "1/s", {0, 1e9}, {}, "0", "",
       "Rayleigh's alpha: force against motion per mass and velocity; needs inertia"},

      {"path.ebar", numbers, "", {-1e5, 1e5}, {}, "", "required without path.force",
       "Waypoints of (L0 - L)/D: tightening when falling, loosening when rising"},
      {"path.force", quantities, "N", above(0), {}, "", "none: path.ebar is followed",
       "Waypoints of the pulling force instead of path.ebar, each recorded; the rod alone"},
      {"path.max_step", number, "", {1e-4, 100}, {}, "0.5", "",
       "Largest step in ebar; the solver may take smaller ones", Fineness::size},
      {"path.record", numbers, "", {-1e5, 1e5}, {}, "", "the waypoints of ebar",
       "ebar at which full states are written"},
      {"path.speed", quantity, "m/s", above(0), {}, "0.0005", "",
       "Speed of the moving end; used by effects that know time"},
      {"path.time_tolerance", number, "", {1e-8, 0.05}, {}, "1e-4", "",
       "Error allowed in a time step, in D; used by effects that know time", Fineness::size},

      {"rod1d.segments", integer, "", {5, 1e5}, {}, "", "8 per diameter, even, at least 60, at most 400 if they follow the knot",
       "Segments of the centerline", Fineness::count},
      {"rod1d.follow_knot", boolean, "", {}, {}, "", "true without inertia and natural curvature or twist",
       "Nodes follow the knot along the rod, densest where strands are near each other", Fineness::choice},
      {"rod1d.symmetry", boolean, "", {}, {}, "true", "",
       "Of a knot with a two-fold axis or an inversion, simulate one half; the other is its image",
       Fineness::choice},
      {"rod1d.stretch_stiffness_factor", number, "", {1, 1e4}, {}, "1", "",
       "Stretching stiffness over that of the section: 100 makes the rod almost inextensible"},
      {"rod1d.friction_slip", word, "", {}, {"surface", "centerline"}, R"("surface")", "",
       "What friction of the rod resists: slip of the surfaces, or of the centerlines, as in codes whose friction knows no spin"},
      {"rod1d.penetration", number, "", {1e-6, 0.1}, {}, "0.002", "",
       "Largest overlap of strands aimed at, in D", Fineness::size},

      {"solid3d.section_elements", integer, "", {5, 2000}, {}, "", "32, or 12 of the quadratic element",
       "About this many hexahedra in a cross-section (12, 32, 60, 108 fit exactly; quadratic 5, 12, 21, 32)", Fineness::count_per_area},
      {"solid3d.element", word, "", {}, element_names(), R"("three-field")", "",
       "Hexahedron: three fields of 8 nodes, the same at one point with hourglass stiffness, or three fields of 27 nodes", Fineness::choice},
      {"solid3d.hourglass_factor", number, "", {0.01, 10}, {}, "1", "",
       "Of the hourglass stiffness of reduced-hybrid; 1 bends a brick exactly", Fineness::choice},
      {"solid3d.seed_ebar", number, "", {-1e5, 1e5}, {}, "", "the first waypoint",
       "ebar at which the rod's state becomes the solid's start"},
      {"solid3d.confirm_at", numbers, "", {-1e5, 1e5}, {}, "", "none",
       "ebar, on the solid's path, at which its state is found again on a finer section"},
      {"solid3d.confirm_elements", integer, "", {5, 2000}, {}, "", "60, or 21 of the quadratic element, with solid3d.confirm_at",
       "About this many hexahedra in the section of solid3d.confirm_at", Fineness::count_per_area},
      {"solid3d.axial_ratio", number, "", {0.1, 5}, {}, "0.8", "",
       "Length over width of a cell in the knot; one of the quadratic element has nodes in its middle, too", Fineness::size},
      {"solid3d.tail_ratio", number, "", {0.1, 20}, {}, "3", "",
       "Length over width of a cell in the straight tails", Fineness::size},
      {"solid3d.contact_stiffness", number, "", {0.1, 1e5}, {}, "", "0.6 over solid3d.penetration",
       "First contact penalty per area, in E/D; a start with T < 0.006 E D^2 takes less in proportion", Fineness::count},
      {"solid3d.penetration", number, "", {1e-5, 0.1}, {}, "", "0.002; 0.01 with inertia",
       "Largest overlap allowed, in D; the penalty is stiffened until it is met", Fineness::size},
      {"solid3d.symmetry", boolean, "", {}, {}, "true", "",
       "Of a knot with a two-fold axis or an inversion, simulate one half; the other is its image", Fineness::choice},
      {"solid3d.sample_spacing", number, "", {0.005, 0.5}, {}, "0.05", "",
       "Distance of contact samples on the surface, in D", Fineness::size},

      {"cases", cases, "", {}, {}, "", "none: the scene is one case",
       "Cases run one after another: a table of names, each with the keys that differ from the scene"},
      {"study.grid", grid, "", {}, {}, "", "none: given by --grid",
       "What `bight study` varies: a table of keys, each with a list of values"},
      {"study.extrapolate", text, "", {}, {}, R"("")", "",
       "Key of the grid over which the study's reference is extrapolated; else it is the finest run"},
  };
  // clang-format on
  return keys;
}

bool Range::contains(double value) const {
  return (low_open ? value > low : value >= low) && value <= high;
}

std::string Range::text() const {
  return fmt::format("{}{}, {}{}", low_open || low == -infinity ? '(' : '[', low, high,
                     high == infinity ? ')' : ']');
}

const Key* find_key(std::string_view path) {
  const auto& keys = all_keys();
  const auto found = std::ranges::find(keys, path, &Key::path);
  return found == keys.end() ? nullptr : &*found;
}

const Key& nearest_key(std::string_view path) {
  return *std::ranges::min_element(all_keys(), {}, [&](const Key& key) {
    return 2 * edits(path, key.path) + edits(last_part(path), last_part(key.path));
  });
}

std::string allowed(const Key& key) {
  switch (key.kind) {
    case Kind::quantity:
      return fmt::format("a quantity such as \"1 {0}\" (a plain number is in {0}) in {1}", key.unit,
                         key.range.text());
    case Kind::number:
      return "a number in " + key.range.text();
    case Kind::integer:
      return "a whole number in " + key.range.text();
    case Kind::boolean:
      return "true or false";
    case Kind::word:
      return fmt::format("one of: {}", fmt::join(key.words, ", "));
    case Kind::words:
      return fmt::format("a list of: {}", fmt::join(key.words, ", "));
    case Kind::numbers:
      return "a list of numbers in " + key.range.text();
    case Kind::quantities:
      return fmt::format("a list of quantities such as \"1 {0}\" (plain numbers are in {0}) in {1}",
                         key.unit, key.range.text());
    case Kind::text:
      return "text";
    case Kind::file:
      return "the name of a file, relative to the scene";
    case Kind::cases:
      return "tables such as [cases.rough] with effects.friction = 0.32";
    case Kind::grid:
      return "a table such as { rod1d.segments = [85, 170, 340] }";
  }
  return {};
}

std::string keys_table() {
  std::string table;
  for (const Key& key : all_keys())
    table += fmt::format("{}\n    {}.\n    allowed: {}\n    default: {}\n{}", key.path, key.meaning,
                         allowed(key), key.fallback.empty() ? key.otherwise : key.fallback,
                         in_a_study(key.fineness));
  return table;
}

}  // namespace bight::coupling
