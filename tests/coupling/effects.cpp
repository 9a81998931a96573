// Only the effects that a scene names are simulated: none other is built, and what an effect needs
// (angles, slips, search trees, masses, integrators) is not there without it.
#include "coupling/effects.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "call.h"
#include "coupling/expect.h"
#include "coupling/sweep.h"
#include "mechanics/types.h"
#include "rod1d/effects.h"
#include "small_scene.h"
#include "solid3d/effects.h"

using namespace bight;
using namespace bight::coupling;

namespace {

const std::vector<std::string> choices = {
    "effects.contact=false",         "effects.friction=0.3", "effects.twist=true",
    "rod.natural_curvature=5",       "effects.gravity=9.81", "effects.magnetic_field=0.1",
    "solid3d.element=reduced-hybrid"};

std::set<std::string> names(const EffectList& effects) {
  std::set<std::string> names;
  for (const auto& effect : effects) names.emplace(effect->name());
  return names;
}

/// Of what was asked for, the effects with stencils of their own.
std::set<std::string> asked_for(const Scene& scene, bool KnownEffect::*in) {
  std::set<std::string> names;
  for (const KnownEffect& effect : asked_effects(scene))
    if (effect.*in) names.insert(effect.name);
  // Masses of nodes are no stencils; a rod that is curved when free has another bend.
  for (const char* name : {"inertia", "damping", "natural curvature", "natural twist"})
    names.erase(name);
  return names;
}

/// Whether a run of the program calls SUNDIALS: the dynamic linker binds a function at its first
/// call.
bool integrates(const TemporaryFolder& folder, const std::string& words) {
  const std::string command = "cd '" + folder.path().string() +
                              "' && LD_DEBUG=bindings LD_DEBUG_OUTPUT=bound " BIGHT_PROGRAM " " +
                              words + " > said 2>&1 && cat bound.* > calls && rm bound.*";
  REQUIRE(std::system(command.c_str()) == 0);
  return text_of(folder / "calls").find("ARKStepCreate") != std::string::npos;
}

}  // namespace

TEST_CASE("a scene builds the effects that it names and no other, in every combination") {
  const TemporaryFolder folder;
  const auto file = folder.write("scene.toml", small_scene);
  int scenes = 0;
  for (unsigned mask = 0; mask < 1u << choices.size(); ++mask) {
    std::vector<std::string> settings = {"rod1d.segments=60"};
    for (size_t i = 0; i < choices.size(); ++i)
      if (mask >> i & 1) settings.push_back(choices[i]);
    for (const char* fidelity : {"rod", "solid"}) {
      std::optional<Scene> scene;
      try {
        scene = read_scene(file, settings, {fidelity});
      } catch (const std::exception&) {
        continue;  // refused: friction without contact, a curved solid, ...
      }
      ++scenes;
      CAPTURE(settings, fidelity);
      const rod1d::RodParameters parameters = rod_parameters(*scene);
      rod1d::Rod rod = rod1d::uniform_rod(parameters.length, 60, parameters.poissons_ratio);
      bend_naturally(rod, parameters.natural_curvature, parameters.natural_twist);
      const rod1d::Frames source;
      CHECK(names(make_effects(rod, parameters, source).list) ==
            asked_for(*scene, &KnownEffect::in_rod));
      if (!scene->solid) continue;
      const solid3d::Mesh mesh = solid3d::make_mesh(solid3d::make_section(12), {0, 1, 2});
      CHECK(names(make_effects(mesh, solid_parameters(*scene), 3 * mesh.nodes()).list) ==
            asked_for(*scene, &KnownEffect::in_solid));
    }
  }
  CHECK(scenes >= 48);
}

TEST_CASE("without friction no slip, without twist no angle, without contact no pairs") {
  rod1d::RodParameters smooth;
  smooth.segments = 120;
  smooth.path.waypoints = smooth.path.record = {28, 27};
  const rod1d::RodResult knot = run_rod(smooth);
  CHECK(knot.states[0].twist_angle.empty());
  CHECK(knot.steps.back().dissipated == 0);
  int unknowns = 0;
  for (const EffectCost& cost : knot.costs) unknowns += cost.unknowns;
  CHECK(knot.unknowns == unknowns);
  CHECK(unknowns < 3 * (smooth.segments / 2 + 1));  // of one half
  rod1d::RodParameters rough = smooth;
  rough.friction = 0.1;
  rough.twist = true;
  const rod1d::RodResult rubbed = run_rod(rough);
  CHECK(rubbed.states[0].twist_angle.size() == 120);
  CHECK(rubbed.unknowns > unknowns + 50);

  // A bow is no knot, so it needs no contact.
  rod1d::RodParameters bow = smooth;
  bow.contact = false;
  bow.length = 20;
  bow.path.waypoints = bow.path.record = {4, 3};
  for (int i = 0; i <= 100; ++i) {
    const double u = 2 * M_PI * i / 100;
    bow.start.push_back({4.5 * (1 - std::cos(u)), 0, 16 * u / (2 * M_PI)});
  }
  const rod1d::RodResult untouched = run_rod(bow);
  REQUIRE(untouched.outcome.status == PathStatus::finished);
  for (const EffectCost& cost : untouched.costs) CHECK(cost.name != "contact");
  CHECK(untouched.effects == std::vector<std::string>{"stretch", "bend"});
}

TEST_CASE("equilibria need no time integrator") {
  const TemporaryFolder folder;
  folder.write("knot.toml", "fidelities = [\"rod\"]\n" +
                                small_scene_with("[30, 20]", "[30, 29.9]") +
                                "speed = \"50 mm/s\"\n[rod1d]\nsegments = 80\n");
  CHECK_FALSE(integrates(folder, "run knot.toml --out still --threads 1"));
  CHECK(integrates(folder, "run knot.toml --out moving --threads 1 --set effects.inertia=true"));
}

TEST_CASE("what the effects have cost is in the summary") {
  const TemporaryFolder folder;
  folder.write("knot.toml", "fidelities = [\"rod\"]\n" + small_scene_with("[30, 20]", "[30, 29]") +
                                "[rod1d]\nsegments = 120\n");
  REQUIRE(call(folder, "run knot.toml --out out").status == 0);
  const auto summary = nlohmann::json::parse(text_of(folder / "out/summary.json"));
  const auto& costs = summary["rod"]["cost_by_effect"];
  REQUIRE(costs.size() == 3);
  double seconds = 0;
  for (const char* effect : {"stretch", "bend", "contact"}) {
    CAPTURE(effect);
    CHECK(costs[effect]["seconds"] > 0);
    CHECK(costs[effect]["stencils"] > 0);
    CHECK(costs[effect]["matrix_MB"] > 0);
    seconds += costs[effect]["seconds"].get<double>();
  }
  CHECK(costs["stretch"]["unknowns"] == summary["rod"]["unknowns"]);
  // Their sum is what finding pairs and assembling took, up to the tying.
  CHECK(seconds < 1.2 * (summary["rod"]["seconds"]["pairs"].get<double>() +
                         summary["rod"]["seconds"]["assembly"].get<double>()) +
                      0.1);
}

TEST_CASE("a check says what each effect will cost and what is left out") {
  using Catch::Contains;
  const TemporaryFolder folder;
  const auto file = folder.write("knot.toml", small_scene);
  const std::string smooth = expectations(read_scene(file, {}));
  CHECK_THAT(smooth, Contains("strain") && Contains("contact") && Contains("equations"));
  CHECK_THAT(smooth, Contains("left out: friction (effects.friction), twist (effects.twist)"));
  CHECK_THAT(smooth, Contains("338 stencils") && Contains("% of the time"));
  CHECK_THAT(smooth, !Contains("gravity  "));
  const std::string rough =
      expectations(read_scene(file, {"effects.friction=0.3", "effects.gravity=9.81"}, {"rod"}));
  CHECK_THAT(rough, Contains("friction") && Contains("gravity ") && !Contains("(effects.gravity)"));
  CHECK_THAT(rough, !Contains("strain"));
}
