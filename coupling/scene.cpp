#include "coupling/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "coupling/check_scene.h"
#include "coupling/errors.h"
#include "coupling/knot_start.h"
#include "coupling/scene_material.h"
#include "coupling/values.h"
#include "solid3d/elements.h"

namespace bight::coupling {
namespace {

std::string read_text(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) throw InputError(file.string() + ": there is no such file");
  if (!std::filesystem::is_regular_file(file)) throw InputError(file.string() + ": not a file");
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw FileError(file.string() + ": cannot be read");
  return text.str();
}

template <class T>
void derive(Values& values, const char* key, const T& value) {
  if (!values.has(key)) values.set(key, {value, ""});
}

// Defaults that follow from other keys; `bight keys` says how.
void derive_defaults(Values& values) {
  const double nu = values.number("material.poissons_ratio");
  derive(values, "material.bulk_to_shear", nu == 0.5 ? 1000.0 : 2 * (1 + nu) / (3 * (1 - 2 * nu)));
  if (moduli_sum(values) > 0)
    derive(values, "material.youngs_modulus", youngs_modulus_of(moduli_sum(values), values));
  if (!values.has("knot.centerline")) derive(values, "knot.type", std::string("overhand"));
  const bool straight =
      values.number("rod.natural_curvature") == 0 && values.number("rod.natural_twist") == 0;
  derive(values, "effects.twist",
         !straight || values.number("effects.friction") > 0 ||
             values.word("ends.finish") == "clamped");
  const auto waypoints = values.get<std::vector<double>>("path.ebar");
  if (!waypoints.empty()) {
    derive(values, "path.record", waypoints);
    derive(values, "solid3d.seed_ebar", waypoints.front());
  }
  const bool quadratic = solid3d::hex_element(values.word("solid3d.element")).degree == 2;
  derive(values, "solid3d.section_elements", quadratic ? 12.0 : 32.0);
  // In time, stiffer contact makes for shorter steps.
  derive(values, "solid3d.penetration", values.get<bool>("effects.inertia") ? 0.01 : 0.002);
  derive(values, "solid3d.contact_stiffness", 0.6 / values.number("solid3d.penetration"));
  if (!values.get<std::vector<double>>("solid3d.confirm_at").empty())
    derive(values, "solid3d.confirm_elements", quadratic ? 21.0 : 60.0);
  // An even number puts a node in the middle, where a symmetric knot can be held.
  const double slenderness = values.number("rod.length") / values.number("rod.diameter");
  derive(values, "rod1d.follow_knot", straight && !values.get<bool>("effects.inertia"));
  const double most = values.get<bool>("rod1d.follow_knot") ? 400 : 1e5;
  derive(values, "rod1d.segments", std::clamp(2 * std::round(4 * slenderness), 60.0, most));
}

// A size and a direction of three numbers that are not all zero, which is checked later.
Vector3 pointing(const Values& values, const char* size, const char* direction) {
  const auto numbers = values.get<std::vector<double>>(direction);
  const Vector3 along = numbers.size() == 3 ? Vector3(numbers.data()) : Vector3::Zero();
  return along.norm() > 0 ? Vector3(values.number(size) * along.normalized()) : along;
}

// m of rod1d/effects/magnetic.h.
Vector3 magnetic_moment(const Scene& scene) {
  constexpr double mu_0 = 1.25663706212e-6;  // N/A^2
  const double chi = scene.susceptibility;
  return scene.magnetic_field *
         std::sqrt(std::numbers::pi / 4 * chi * chi / (2 + chi) / (mu_0 * scene.youngs_modulus));
}

// The first waypoint after which the path has come by the seed.
size_t seed_leg(const Path& path, double seed_ebar) {
  size_t leg = 1;
  while (leg < path.waypoints.size() &&
         (seed_ebar - path.waypoints[leg - 1]) * (seed_ebar - path.waypoints[leg]) > 0)
    ++leg;
  return leg;
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 const std::vector<std::string>& fidelities) {
  Problems problems;
  Values values = read_values(read_text(file), file.string(), overrides, problems);
  problems.throw_if_any();
  if (!fidelities.empty()) values.set("fidelities", {fidelities, "the verb"});
  derive_defaults(values);
  if (values.has("knot.centerline"))
    values.set("knot.centerline",
               {absolute(file.parent_path() / values.word("knot.centerline")).string(),
                values.where("knot.centerline")});

  Scene scene;
  const auto asked = values.get<std::vector<std::string>>("fidelities");
  const auto asks = [&](const char* name) { return std::ranges::count(asked, name) > 0; };
  scene.name = file.stem().string();
  scene.title = values.word("title");
  scene.rod = asks("rod");
  scene.solid = asks("solid");
  scene.length = values.number("rod.length");
  scene.diameter = values.number("rod.diameter");
  scene.youngs_modulus = values.number("material.youngs_modulus");
  scene.poissons_ratio = values.number("material.poissons_ratio");
  scene.natural_curvature = values.number("rod.natural_curvature");
  scene.natural_twist = values.number("rod.natural_twist");
  scene.density = values.number("material.density");
  scene.material = material_parameters(values);
  scene.knot = values.word("knot.type");
  scene.from_straight = values.word("knot.start") == "straight";
  scene.centerline = values.word("knot.centerline");
  scene.finish_turns = values.word("ends.finish") == "free-twist";
  scene.finish_turn = values.number("ends.turn");
  scene.contact = values.get<bool>("effects.contact");
  scene.twist = values.get<bool>("effects.twist");
  scene.friction = values.number("effects.friction");
  scene.gravity = pointing(values, "effects.gravity", "effects.gravity_direction");
  scene.magnetic_field = pointing(values, "effects.magnetic_field", "effects.magnetic_direction");
  scene.susceptibility = values.number("material.susceptibility");
  scene.inertia = values.get<bool>("effects.inertia");
  scene.damping = values.number("effects.damping");
  scene.speed = values.number("path.speed");
  scene.time_tolerance = values.number("path.time_tolerance");
  scene.path.waypoints = values.get<std::vector<double>>("path.ebar");
  scene.path.record = values.get<std::vector<double>>("path.record");
  scene.forces = values.get<std::vector<double>>("path.force");
  scene.path.max_step = values.number("path.max_step");
  scene.segments = static_cast<int>(values.number("rod1d.segments"));
  scene.follow_knot = values.get<bool>("rod1d.follow_knot");
  scene.rod_friction_at_surface = values.word("rod1d.friction_slip") == "surface";
  scene.rod_penetration = values.number("rod1d.penetration");
  scene.stretch_stiffness_factor = values.number("rod1d.stretch_stiffness_factor");
  scene.section_elements = static_cast<int>(values.number("solid3d.section_elements"));
  scene.element = values.word("solid3d.element");
  scene.hourglass_factor = values.number("solid3d.hourglass_factor");
  scene.seed_ebar = values.number("solid3d.seed_ebar");
  scene.confirm_at = values.get<std::vector<double>>("solid3d.confirm_at");
  if (!scene.confirm_at.empty())
    scene.confirm_elements = static_cast<int>(values.number("solid3d.confirm_elements"));
  scene.axial_ratio = values.number("solid3d.axial_ratio");
  scene.tail_ratio = values.number("solid3d.tail_ratio");
  scene.contact_stiffness = values.number("solid3d.contact_stiffness");
  scene.solid_penetration = values.number("solid3d.penetration");
  scene.sample_spacing = values.number("solid3d.sample_spacing");
  scene.rod_symmetry = values.get<bool>("rod1d.symmetry");
  scene.symmetry = values.get<bool>("solid3d.symmetry");
  scene.cases = values.get<std::vector<std::string>>("cases");
  scene.grid = values.get<std::vector<std::string>>("study.grid");
  scene.extrapolate = values.word("study.extrapolate");
  scene.text = values.toml();
  check_scene(scene, values, problems);
  problems.throw_if_any();
  return scene;
}

Path path_to_seed(const Path& path, double seed_ebar) {
  Path part = path;
  part.waypoints.resize(seed_leg(path, seed_ebar));
  if (part.waypoints.back() != seed_ebar) part.waypoints.push_back(seed_ebar);
  part.record = {seed_ebar};
  return part;
}

Path path_from_seed(const Path& path, double seed_ebar) {
  Path part = path;
  part.waypoints = {seed_ebar};
  for (size_t i = seed_leg(path, seed_ebar); i < path.waypoints.size(); ++i)
    if (path.waypoints[i] != part.waypoints.back()) part.waypoints.push_back(path.waypoints[i]);
  const auto [low, high] = std::ranges::minmax(part.waypoints);
  std::erase_if(part.record, [&](double ebar) { return ebar < low || ebar > high; });
  return part;
}

rod1d::RodParameters rod_parameters(const Scene& scene) {
  rod1d::RodParameters rod;
  rod.length = scene.slenderness();
  rod.poissons_ratio = scene.poissons_ratio;
  rod.natural_curvature = scene.natural_curvature * scene.diameter;
  rod.natural_twist = scene.natural_twist * scene.diameter;
  rod.knot = scene.knot;
  rod.from_straight = scene.from_straight;
  rod.start = knot_start(scene);
  rod.finish_turns = scene.finish_turns;
  rod.finish_turn = scene.finish_turn;
  rod.contact = scene.contact;
  rod.twist = scene.twist;
  rod.friction = scene.friction;
  rod.friction_at_surface = scene.rod_friction_at_surface;
  rod.gravity = scene.gravity / scene.scales().acceleration();
  rod.magnetic = magnetic_moment(scene);
  rod.inertia = scene.inertia;
  rod.damping = scene.damping * scene.scales().time();
  rod.speed = scene.speed / scene.scales().speed();
  rod.time_tolerance = scene.time_tolerance;
  rod.segments = scene.segments;
  rod.follow_knot = scene.follow_knot;
  rod.symmetry = scene.rod_symmetry;
  rod.penetration = scene.rod_penetration;
  rod.stretch_stiffness_factor = scene.stretch_stiffness_factor;
  rod.path = scene.path;
  for (const double force : scene.forces) rod.forces.push_back(force / scene.scales().force());
  if (!scene.rod) rod.path = path_to_seed(scene.path, scene.seed_ebar);
  if (scene.solid && std::ranges::count(rod.path.record, scene.seed_ebar) == 0)
    rod.path.record.push_back(scene.seed_ebar);
  return rod;
}

SweepOptions sweep_options(const Scene& scene, int section_elements) {
  return {.section_elements = section_elements,
          .degree = solid3d::hex_element(scene.element).degree,
          .axial_ratio = scene.axial_ratio,
          .tail_ratio = scene.tail_ratio};
}

solid3d::SolidParameters solid_parameters(const Scene& scene) {
  solid3d::SolidParameters solid;
  solid.material = scene.material;
  solid.element = scene.element;
  solid.hourglass_factor = scene.hourglass_factor;
  solid.finish_turns = scene.finish_turns;
  solid.contact = scene.contact;
  solid.contact_stiffness = scene.contact_stiffness;
  solid.penetration = scene.solid_penetration;
  solid.sample_spacing = scene.sample_spacing;
  solid.symmetry = scene.symmetry;
  solid.friction = scene.friction;
  solid.gravity = scene.gravity / scene.scales().acceleration();
  solid.inertia = scene.inertia;
  solid.damping = scene.damping * scene.scales().time();
  solid.speed = scene.speed / scene.scales().speed();
  solid.time_tolerance = scene.time_tolerance;
  Path path = scene.path;
  for (const double ebar : scene.confirm_at)
    if (std::ranges::count(path.record, ebar) == 0) path.record.push_back(ebar);
  solid.path = path_from_seed(path, scene.seed_ebar);
  return solid;
}

}  // namespace bight::coupling
