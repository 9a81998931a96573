#include "coupling/check_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/effects.h"
#include "coupling/errors.h"
#include "coupling/knot_start.h"
#include "coupling/scene_material.h"
#include "solid3d/elements.h"

namespace bight::coupling {
namespace {

constexpr double shortest_rod = 12;    ///< L0/D: an open tight overhand alone takes about 10
constexpr double longest_rod = 1e5;    ///< L0/D: the range of ebar, too
constexpr double shortest_reach = 4;   ///< L/D: two diameters of straight tail at each end
constexpr double largest_stretch = 2;  ///< L/L0; the rod is linear, rubber is not

class Check {
 public:
  Check(Scene& scene, const Values& values, Problems& problems)
      : scene_(scene), values_(values), problems_(problems) {}

  void knot() {
    if (values_.has("knot.type") && values_.has("knot.centerline"))
      return refuse("knot.centerline", "give either knot.type or knot.centerline, not both");
    if (scene_.from_straight && values_.has("knot.centerline"))
      return refuse("knot.start", "a centerline is tied already; only knot.type can be tied");
    try {
      scene_.determinant = checked_determinant(scene_);
      if (scene_.determinant == 1)
        warn("knot.centerline", "its determinant is 1: an open curve, hardly a knot");
    } catch (const InputError& error) {
      refuse(scene_.centerline.empty() ? "knot.type" : "knot.centerline", error.what());
    }
  }

  bool path() {
    if (!scene_.forces.empty()) return force();
    bool fits = true;
    const auto refuse_ebar = [&](const std::string& what) {
      refuse("path.ebar", what);
      fits = false;
    };
    const double highest = scene_.slenderness() - shortest_reach;
    const double lowest = scene_.slenderness() * (1 - largest_stretch);
    for (const double ebar : scene_.path.waypoints) {
      if (ebar > highest)
        refuse_ebar(
            fmt::format("{} is more than a rod of L0 = {:.4g} D holds with straight "
                        "tails; at most {:.4g}",
                        ebar, scene_.slenderness(), highest));
      if (ebar < lowest)
        refuse_ebar(
            fmt::format("{} stretches the rod to more than twice its length; at "
                        "least {:.4g}",
                        ebar, lowest));
    }
    for (const double ebar : scene_.path.record) on_path("path.record", ebar);
    if (scene_.solid) on_path("solid3d.seed_ebar", scene_.seed_ebar);
    confirmation();
    return fits;
  }

  void confirmation() {
    if (!scene_.solid || scene_.confirm_at.empty()) return;
    if (scene_.inertia)
      refuse("solid3d.confirm_at", "only equilibria are confirmed, without effects.inertia");
    const auto [low, high] =
        std::ranges::minmax(path_from_seed(scene_.path, scene_.seed_ebar).waypoints);
    for (const double ebar : scene_.confirm_at)
      if (ebar < low || ebar > high)
        refuse("solid3d.confirm_at",
               fmt::format("{} is not on the solid's path, {} to {}", ebar, high, low));
  }

  bool force() {
    if (values_.has("path.ebar"))
      return refuse("path.force", "give either path.ebar or path.force, not both"), false;
    if (scene_.solid)
      refuse("path.force", "the solid follows ebar: only for fidelities = [\"rod\"]");
    if (scene_.inertia) refuse("path.force", "it is met by equilibria, without effects.inertia");
    if (values_.has("path.record"))
      refuse("path.record", "with path.force the states at the forces are recorded");
    return true;
  }

  bool length() {
    const double slenderness = scene_.slenderness();
    if (!(slenderness >= shortest_rod))
      refuse("rod.length", fmt::format("{:.3g} diameters are too short for a knot; at least {}",
                                       slenderness, shortest_rod));
    if (slenderness > longest_rod)
      refuse("rod.length", fmt::format("{:.3g} diameters are too long to simulate; at most {:g}",
                                       slenderness, longest_rod));
    return slenderness >= shortest_rod && slenderness <= longest_rod;
  }

  void material() {
    const double nu = scene_.poissons_ratio;
    const double of_nu = 2 * (1 + nu) / (3 * (1 - 2 * nu));
    if (nu < 0.5 && std::abs(scene_.material.bulk_to_shear - of_nu) > 1e-9 * of_nu)
      refuse("material.bulk_to_shear",
             fmt::format("only free when poissons_ratio is 0.5; {} means {}", nu, of_nu));
    check_moduli(values_, problems_);
    const double density = values_.number("material.density");
    if (density < 10)
      warn("material.density", fmt::format("{} kg/m^3 is hardly a solid (the paper's printed 1.160 "
                                           "kg/m^3 is a slip for 1160)",
                                           density));
    if (scene_.youngs_modulus < 1e3 || scene_.youngs_modulus > 1e12)
      warn("material.youngs_modulus",
           fmt::format("{} Pa is not that of a common solid", scene_.youngs_modulus));
  }

  void resolution() {
    const double segment = scene_.slenderness() / scene_.segments;
    if (segment > 0.5 && !scene_.follow_knot)
      warn("rod1d.segments",
           fmt::format("segments of {:.2g} D are too long for smooth contact", segment));
    if (solid3d::hex_element(scene_.element).degree == 1)
      for (const char* key : {"solid3d.section_elements", "solid3d.confirm_elements"})
        if (values_.has(key) && values_.number(key) < 12)
          refuse(key, "fewer than 12 hexahedra are only for solid3d.element = \"quadratic\"");
  }

  void ends() {
    if (!scene_.finish_turns && !scene_.twist)
      refuse("effects.twist", "a clamped finish end needs the rod's twist");
    if (scene_.finish_turns && scene_.finish_turn != 0)
      refuse("ends.turn", "only a finish end that is clamped can be turned");
    else if (scene_.finish_turn != 0 && scene_.solid)
      refuse("ends.turn", "the solid does not simulate it yet: only for fidelities = [\"rod\"]");
  }

  void friction() {
    if (scene_.friction > 0 && !scene_.twist)
      refuse("effects.twist", "friction needs the rod's twist");
    if (scene_.friction > 0 && !scene_.contact) refuse("effects.contact", "friction needs contact");
  }

  void motion() {
    for (const char* key : {"effects.gravity_direction", "effects.magnetic_direction"}) {
      const auto direction = values_.get<std::vector<double>>(key);
      if (direction.size() != 3 || Vector3(direction.data()) == Vector3::Zero())
        refuse(key, "give three numbers, x, y and z, that are not all zero");
    }
    if (scene_.damping > 0 && !scene_.inertia)
      refuse("effects.damping",
             "a path of equilibria has no motion to damp; needs effects.inertia");
  }

  void effects() {
    if (scene_.follow_knot && (scene_.inertia || !scene_.naturally_straight()))
      refuse("rod1d.follow_knot",
             "inertia and natural shape belong to material points, which nodes must not leave");
    if (!scene_.naturally_straight() && !scene_.twist)
      refuse("effects.twist", "natural curvature and twist need the rod's twist");
    bool refused = false;  // what friction brings along is not to be blamed on the user
    for (const KnownEffect& effect : asked_effects(scene_))
      if (!effect.available && !(refused && !values_.written(effect.key))) {
        refused = true;
        refuse(effect.key,
               effect.name + " cannot be simulated with the solid yet; available: " + available());
      }
  }

 private:
  std::string available() const {
    std::string names;
    for (const KnownEffect& effect : asked_effects(scene_))
      if (effect.available) names += (names.empty() ? "" : ", ") + effect.name;
    return names;
  }

  void on_path(const char* key, double ebar) {
    const auto [low, high] = std::ranges::minmax(scene_.path.waypoints);
    if (ebar < low || ebar > high)
      refuse(key,
             fmt::format("{} is not on the path; path.ebar runs from {} to {}", ebar, low, high));
  }

  void refuse(const std::string& key, const std::string& what) {
    problems_.add(values_.where(key), key, what);
  }
  void warn(const std::string& key, const std::string& what) {
    scene_.warnings.push_back(fmt::format("{}: {}: {}", values_.where(key), key, what));
  }
  Scene& scene_;
  const Values& values_;
  Problems& problems_;
};

}  // namespace

void check_scene(Scene& scene, const Values& values, Problems& problems) {
  Check check(scene, values, problems);
  if (check.length() && check.path()) check.knot();
  check.material();
  check.resolution();
  check.ends();
  check.friction();
  check.motion();
  check.effects();
}

}  // namespace bight::coupling
