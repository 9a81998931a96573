#include "coupling/expect.h"

#include <fmt/format.h>

#include <algorithm>

#include "coupling/effects.h"
#include "coupling/expect_effects.h"
#include "rod1d/knots.h"
#include "solid3d/mesh.h"

namespace bight::coupling {
namespace {

// What this fidelity could simulate and the scene does not ask for.
std::string left_out(const Scene& scene, bool KnownEffect::*in) {
  std::string text;
  for (const KnownEffect& effect : known_effects(scene))
    if (effect.*in && !effect.asked)
      text += fmt::format("{} {} ({})", text.empty() ? "" : ",", effect.name, effect.key);
  return text.empty() ? "" : "       left out:" + text + "\n";
}

std::string knot_line(const Scene& scene) {
  if (scene.centerline.empty())
    return fmt::format("knot   {}, determinant {}, {}\n", scene.knot, scene.determinant,
                       scene.from_straight ? "tied from a straight rod" : "laid out loosely");
  std::string like;
  for (const rod1d::Knot& knot : rod1d::all_knots())
    if (knot.determinant == scene.determinant) like = fmt::format(", that of the {}", knot.name);
  return fmt::format("knot   {}, determinant {}{}\n", scene.centerline.filename().string(),
                     scene.determinant, like);
}

std::string rod_line(const Scene& scene) {
  const std::vector<ExpectedCost> costs = expected_rod(scene);
  int unknowns = 0;
  for (const ExpectedCost& cost : costs) unknowns += cost.unknowns;
  return fmt::format("rod    {} segments of {:.3g} D, {} unknowns, less than 0.1 GB\n{}{}",
                     scene.segments, scene.slenderness() / scene.segments, unknowns,
                     costs_text(costs), left_out(scene, &KnownEffect::in_rod));
}

// The knot takes about ebar + 6 D of the rod; the mesh is laid out when its true place is known.
std::string solid_line(const Scene& scene) {
  const solid3d::Section section = solid3d::make_section(scene.section_elements);
  const double width = section.cell_width();
  const double middle = 0.5 * scene.slenderness();
  const double half = std::min(middle, 0.5 * (scene.seed_ebar + 6));
  const solid3d::Mesh mesh = solid3d::make_mesh(
      section, solid3d::graded_layers(scene.slenderness(), scene.axial_ratio * width,
                                      scene.tail_ratio * width, middle - half, middle + half));
  // A layer couples with itself and the next: b (1.5 b) entries a layer, b = 3 points, and fill;
  // strands in contact about double that.
  const double block = 3.0 * mesh.points_per_layer();
  const double entries = 1.2 * mesh.layers() * block * block * (scene.contact ? 2 : 1);
  const double gigabytes = (8 * entries + 3000.0 * mesh.nodes()) / 1e9;
  return fmt::format(
      "solid  {} cells in a section, about {} layers, {} cells, {} unknowns, {:.1f} GB\n{}{}",
      section.quads.size(), mesh.layers(), mesh.cells.size(), 3 * mesh.nodes(), gigabytes,
      costs_text(expected_solid(scene, mesh)), left_out(scene, &KnownEffect::in_solid));
}

}  // namespace

std::string expectations(const Scene& scene) {
  const Scales scales = scene.scales();
  std::string text = fmt::format(
      "{}\nL0 = {:.4g} m = {:.5g} D, D = {:.4g} m, E = {:.4g} Pa, B = {:.4g} N m^2; Tbar = 1 is "
      "{:.4g} N\n",
      scene.title.empty() ? scene.name : scene.title, scene.length, scene.slenderness(),
      scene.diameter, scene.youngs_modulus,
      scales.force() * scales.length() * scales.length() / normalised_force(4),
      scales.force() / normalised_force(1));
  text += scene.forces.empty() ? "ebar" : "force";
  for (const double ebar : scene.path.waypoints) text += fmt::format(" -> {:g}", ebar);
  for (const double force : scene.forces) text += fmt::format(" -> {:g} N", force);
  text += fmt::format(", {} states recorded\n", scene.path.record.size() + scene.forces.size());
  text += knot_line(scene);
  text += rod_line(scene);
  if (scene.solid) text += solid_line(scene);
  if (scene.symmetry || scene.rod_symmetry)
    text += "       of a knot that has a symmetry one half is simulated, with half the unknowns\n";
  for (const std::string& warning : scene.warnings) text += "warning: " + warning + "\n";
  return text;
}

}  // namespace bight::coupling
