#include "coupling/expect.h"

#include <fmt/format.h>

#include <algorithm>

#include "coupling/effects.h"
#include "coupling/expect_effects.h"
#include "rod1d/knots.h"
#include "solid3d/elements.h"
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

// Fine cells take about 14 D + 1.2 ebar of the rod; the mesh is laid out when the knot's true place
// is known.
solid3d::Mesh expected_mesh(const Scene& scene, int cells, double ebar) {
  const solid3d::Section section =
      solid3d::make_section(cells, solid3d::hex_element(scene.element).degree);
  const double width = section.cell_width();
  const double middle = 0.5 * scene.slenderness();
  const double half = std::min(middle, 0.5 * std::max(20.0, 14 + 1.2 * ebar));
  return solid3d::make_mesh(
      section, solid3d::graded_layers(scene.slenderness(), scene.axial_ratio * width,
                                      scene.tail_ratio * width, middle - half, middle + half,
                                      solid3d::TailEnds::fine));
}

std::string size_text(const Scene& scene, const solid3d::Mesh& mesh) {
  // Of measured peaks with contact (one half, 12 to 108 cells: 0.14 to 3.0 GB): a part by unknowns
  // and one by the squares of the layers' blocks, the factor's fill.
  const double block = 3.0 * mesh.points_per_layer();
  const double of_half = 10.5e3 * 3 * mesh.nodes() + 2.2 * 8 * mesh.layers() * block * block;
  const double gigabytes = 0.04 + of_half * (scene.symmetry ? 1 : 2) / 1e9;
  return fmt::format("{} cells in a section, about {} layers, {} cells, {} unknowns, {:.1f} GB\n",
                     mesh.section.cells(), mesh.layers(), mesh.cells.size(), 3 * mesh.nodes(),
                     gigabytes);
}

std::string solid_line(const Scene& scene) {
  const solid3d::Mesh mesh = expected_mesh(scene, scene.section_elements, scene.seed_ebar);
  std::string text = "solid  " + size_text(scene, mesh) + costs_text(expected_solid(scene, mesh)) +
                     left_out(scene, &KnownEffect::in_solid);
  for (const double ebar : scene.confirm_at)
    text += fmt::format("       confirmed at ebar {:g}: ", ebar) +
            size_text(scene, expected_mesh(scene, scene.confirm_elements, ebar));
  return text;
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
