#include "coupling/scene.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "coupling/cases.h"
#include "coupling/errors.h"
#include "coupling/expect.h"
#include "coupling/keys.h"
#include "small_scene.h"
#include "temporary_folder.h"

using namespace bight::coupling;

namespace {

std::string complaint(const std::string& scene, const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  try {
    read_scene(folder.write("scene.toml", scene), overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

}  // namespace

TEST_CASE("a scene of four tables is complete") {
  const TemporaryFolder folder;
  const Scene scene = read_scene(folder.write("knot.toml", small_scene), {});
  CHECK(scene.name == "knot");
  CHECK(scene.slenderness() == Approx(42.1687).epsilon(1e-5));
  CHECK(scene.youngs_modulus == 1.25e6);
  CHECK(scene.segments == 338);
  CHECK(scene.material.bulk_to_shear == 1000);
  CHECK(scene.knot == "overhand");
  CHECK(scene.finish_turns);
  CHECK_FALSE(scene.twist);
  CHECK(scene.seed_ebar == 30);
  CHECK(scene.path.record == std::vector<double>{30, 20});
}

TEST_CASE("the filled-in scene reads back to itself") {
  const TemporaryFolder folder;
  const auto overrides =
      GENERATE(std::vector<std::string>{},
               std::vector<std::string>{"material.poissons_ratio=0.3",
                                        "title=a \"quoted\" \\ title", "rod.length=1.1 ft",
                                        "path.record=[29.1, 21]", "solid3d.confirm_at=[22]"});
  const Scene scene = read_scene(folder.write("knot.toml", small_scene), overrides);
  const Scene again = read_scene(folder.write("again.toml", scene.text), {});
  CHECK(again.text == scene.text);
  CHECK(again.length == scene.length);
  CHECK(again.title == scene.title);
  CHECK(again.confirm_at == scene.confirm_at);
  CHECK(again.confirm_elements == scene.confirm_elements);
  for (const Key& key : all_keys()) {
    const std::string name(key.path.substr(key.path.find('.') + 1));
    if (key.path == "knot.centerline" || key.path == "path.force") continue;
    if (key.path.starts_with("solid3d.confirm_") && scene.confirm_at.empty()) continue;
    if (key.otherwise.starts_with("needed by")) continue;  // a model that this one is not
    // What a study or cases vary is no part of a run: runs are found again when the grid grows.
    const bool written = scene.text.find(name + " = ") != std::string::npos;
    CHECK(written == !(key.path.starts_with("study.") || key.path == "cases"));
  }
}

TEST_CASE("an override takes the same way as the file") {
  const TemporaryFolder folder;
  const auto file = folder.write("knot.toml", small_scene);
  const Scene scene = read_scene(
      file, {"rod.diameter=8 mm", "fidelities=rod", "path.record=25", "rod1d.segments=100"});
  CHECK(scene.diameter == Approx(0.008));
  CHECK(scene.rod);
  CHECK_FALSE(scene.solid);
  CHECK(scene.path.record == std::vector<double>{25});
  CHECK(scene.segments == 100);
  CHECK(complaint(small_scene, {"rod.diamter=1 mm"}) ==
        "--set: rod.diamter: unknown key; nearest is rod.diameter");
  CHECK(complaint(small_scene, {"rod.diameter"}) ==
        "--set rod.diameter: write --set key.path=value");
}

TEST_CASE("a bad scene is refused with a line that names place, key, value and what is allowed") {
  struct Bad {
    std::string scene;
    std::vector<std::string> words;
  };
  const auto bad = GENERATE(values<Bad>({
      {small_scene_with("diameter =", "diamter ="),
       {":3", "rod.diamter", "nearest is rod.diameter"}},
      {small_scene_with("8.3 mm", "8.3 kg"), {":3", "rod.diameter", "8.3 kg", "unit of m"}},
      {small_scene_with("8.3 mm", "-8.3 mm"), {":3", "rod.diameter", "-8.3 mm", "(0, inf)"}},
      {small_scene_with("\"8.3 mm\"", "nan"), {":3", "rod.diameter", "nan"}},
      {small_scene_with("\"8.3 mm\"", "true"), {":3", "rod.diameter", "true"}},
      {small_scene_with("[path]", "poissons_ratio = 2\n[path]"),
       {":6", "poissons_ratio", "[0, 0.5]"}},
      {small_scene_with("[path]", "model = \"steel\"\n[path]"), {"steel", "neo-hookean"}},
      {small_scene_with("[30, 20]", "[40, 20]"), {":7", "path.ebar", "40", "at most 38.17"}},
      {small_scene_with("[30, 20]", "[30, -50]"), {":7", "path.ebar", "-50"}},
      {small_scene_with("[30, 20]", "[30, nan]"), {":7", "path.ebar", "nan"}},
      {small_scene_with("[30, 20]", "[]"), {":7", "path.ebar"}},
      {small_scene_with("[30, 20]", "[30, 20]\nrecord = [10]"), {":8", "path.record", "20 to 30"}},
      {small_scene + "[solid3d]\nseed_ebar = 5\n", {":9", "solid3d.seed_ebar", "20 to 30"}},
      {small_scene + "[solid3d]\nseed_ebar = 25\nconfirm_at = [26]\n",
       {":10", "solid3d.confirm_at", "26 is not on the solid's path, 25 to 20"}},
      {small_scene_with("350 mm", "80 mm"), {"rod.length", "too short"}},
      {small_scene_with("\"350 mm\"", "1e300"), {":2", "rod.length", "too long"}},
      {small_scene_with("8.3 mm", "1e-320 m"), {"rod.length", "too long"}},
      {small_scene_with("ebar = [30, 20]", ""), {"path.ebar", "missing"}},
      {small_scene + "[effects]\nfriction = -0.3\n", {":9", "effects.friction", "[0, 5]"}},
      {small_scene + "[ends]\nturn = \"90 degree\"\n", {":9", "ends.turn", "clamped"}},
      {small_scene + "[effects]\nmagnetism = true\n",
       {":9", "effects.magnetism", "no such effect"}},
      {small_scene + "[knot]\ntype = \"granny\"\n", {":9", "knot.type", "granny", "figure-eight"}},
      {small_scene + "[knot]\ncenterline = \"no.csv\"\n",
       {":9", "knot.centerline", "no such file"}},
      {small_scene + "[rod1d]\nsegments = 10.5\n", {":9", "rod1d.segments", "whole number"}},
      {"title = [", {":1"}},
      {"", {"empty"}},
      {std::string("\x7f"
                   "ELF\0\1\2",
                   7),
       {"binary"}},
  }));
  const std::string said = complaint(bad.scene);
  CAPTURE(bad.scene, said);
  CHECK(std::ranges::count(said, '\n') == 0);
  CHECK(said.find("scene.toml") != said.npos);
  for (const std::string& word : bad.words) {
    CAPTURE(word);
    CHECK(said.find(word) != said.npos);
  }
}

TEST_CASE("all problems are reported at once") {
  const std::string said = complaint(
      "[rod]\nlength = 0.35\ndiamter = \"8.3 mm\"\n[material]\nyoungs_modulus = \"1 m\"\n",
      {"x=1"});
  CHECK(std::ranges::count(said, '\n') == 3);  // diamter, modulus, x, no path
}

TEST_CASE("a material's own moduli say Young's modulus") {
  const TemporaryFolder folder;
  const auto file =
      folder.write("knot.toml", small_scene_with("youngs_modulus = \"1.25 MPa\"", ""));
  const Scene mooney = read_scene(
      file, {"material.model=mooney-rivlin", "material.c10=0.15 MPa", "material.c01=0.05 MPa"});
  CHECK(mooney.youngs_modulus == Approx(9 * 1000.0 / 3001 * 0.4e6));
  CHECK(mooney.material.model == "mooney-rivlin");
  CHECK(mooney.material.c01_share == Approx(0.25));
  CHECK(read_scene(folder.write("again.toml", mooney.text), {}).text == mooney.text);

  const std::vector<std::string> ogden = {"material.model=ogden", "material.poissons_ratio=0.25",
                                          "material.ogden_moduli=[\"0.3 MPa\", \"0.1 MPa\"]",
                                          "material.ogden_exponents=[1.5, -3]"};
  const Scene scene = read_scene(file, ogden);
  CHECK(scene.youngs_modulus == Approx(2 * (1 + 0.25) * 0.4e6));
  REQUIRE(scene.material.ogden.size() == 2);
  CHECK(scene.material.ogden[0].share == Approx(0.75));
  CHECK(scene.material.ogden[1].exponent == -3);
  CHECK(solid_parameters(scene).material.model == "ogden");
  CHECK(read_scene(folder.write("ogden.toml", scene.text), {}).text == scene.text);
}

TEST_CASE("moduli that are missing, foreign or at odds with Young's modulus are refused") {
  const std::string scene = small_scene_with("youngs_modulus = \"1.25 MPa\"", "");
  CHECK(complaint(scene).find("youngs_modulus: missing") != std::string::npos);
  const auto said = [&](std::vector<std::string> overrides) {
    const std::string complaints = complaint(small_scene, overrides);
    CHECK(std::ranges::count(complaints, '\n') == 0);
    return complaints;
  };
  CHECK(said({"material.c10=1 MPa"}).find("belongs to model mooney-rivlin") != std::string::npos);
  CHECK(said({"material.model=mooney-rivlin", "material.c10=1 MPa"}).find("c01: missing") !=
        std::string::npos);
  CHECK(said({"material.model=mooney-rivlin", "material.c10=1 MPa", "material.c01=0"})
            .find("the moduli mean 5998000") != std::string::npos);
  CHECK(said({"material.model=ogden", "material.ogden_moduli=[416805.556]",
              "material.ogden_exponents=[1, 2]"})
            .find("as many as moduli") != std::string::npos);
  CHECK(said({"material.model=ogden", "material.ogden_moduli=[416805.556]",
              "material.ogden_exponents=[0]"})
            .find("stores no energy") != std::string::npos);
}

TEST_CASE("hardly meant values are warned about") {
  const TemporaryFolder folder;
  const auto file = folder.write("knot.toml", small_scene);
  CHECK(read_scene(file, {}).warnings.empty());
  const Scene scene = read_scene(file, {"material.density=1.160 kg/m^3"});
  REQUIRE(scene.warnings.size() == 1);
  CHECK(scene.warnings[0].find("slip") != std::string::npos);
}

TEST_CASE("a path is parted where it first comes by the seed") {
  bight::Path path;
  path.waypoints = {30, 5, 25};
  path.record = {30, 20, 5};
  CHECK(path_to_seed(path, 20).waypoints == std::vector<double>{30, 20});
  CHECK(path_from_seed(path, 20).waypoints == std::vector<double>{20, 5, 25});
  CHECK(path_from_seed(path, 20).record == std::vector<double>{20, 5});
  CHECK(path_to_seed(path, 30).waypoints == std::vector<double>{30});
  CHECK(path_from_seed(path, 30).waypoints == std::vector<double>{30, 5, 25});
  CHECK(path_from_seed(path, 5).waypoints == std::vector<double>{5, 25});
}

TEST_CASE("every case that comes along is a valid scene without warnings") {
  int cases = 0;
  for (const auto& file : std::filesystem::recursive_directory_iterator(BIGHT_ROOT "/cases")) {
    if (file.path().extension() != ".toml") continue;
    INFO(file.path());
    for (const SceneCase& c : read_cases(file.path(), {}, {}, "")) {
      INFO(c.name);
      CHECK(c.scene.warnings.empty());
      ++cases;
    }
  }
  CHECK(cases >= 7);
}

TEST_CASE("gravity, inertia and damping reach rod and solid in their own units") {
  const TemporaryFolder folder;
  const Scene scene =
      read_scene(folder.write("knot.toml", small_scene),
                 {"effects.gravity=9.81 m/s^2", "effects.gravity_direction=[0, 0, -0.5]",
                  "effects.inertia=true", "effects.damping=4 1/s", "path.speed=0.5 mm/s",
                  "path.time_tolerance=1e-3"});
  const auto rod = rod_parameters(scene);
  const double wave = std::sqrt(1.25e6 / 1160);  // m/s
  CHECK(rod.inertia);
  CHECK(rod.speed == Approx(0.5e-3 / wave));
  CHECK(rod.damping == Approx(4 * 8.3e-3 / wave));
  CHECK(rod.gravity.z() == Approx(-9.81 * 1160 * 8.3e-3 / 1.25e6));
  CHECK(rod.gravity.head<2>().norm() == 0);
  CHECK_FALSE(rod.follow_knot);
  const auto solid = solid_parameters(scene);
  CHECK(solid.inertia);
  CHECK(solid.speed == rod.speed);
  CHECK(solid.damping == rod.damping);
  CHECK(solid.gravity == rod.gravity);
  CHECK(solid.time_tolerance == 1e-3);
  const std::string text = expectations(scene);
  const std::string of_solid = text.substr(text.find("\nsolid "));
  for (const char* effect : {"gravity ", "inertia ", "damping "})
    CHECK_THAT(of_solid, Catch::Contains(effect));
}

TEST_CASE("strands may overlap by 0.2 % D, and by 1 % D in time") {
  const TemporaryFolder folder;
  const auto file = folder.write("scene.toml", small_scene);
  CHECK(solid_parameters(read_scene(file, {})).penetration == 0.002);
  const Scene moving = read_scene(file, {"effects.inertia=true", "path.speed=0.5 mm/s"});
  CHECK(solid_parameters(moving).penetration == 0.01);
  CHECK(solid_parameters(moving).contact_stiffness == Approx(60));
}

TEST_CASE("a magnetic field reaches the rod in its own units, and is refused with the solid") {
  const TemporaryFolder folder;
  const std::vector<std::string> field = {"effects.magnetic_field=50 mT",
                                          "effects.magnetic_direction=[0, 0.3, 0.4]",
                                          "material.susceptibility=2"};
  const Scene scene =
      read_scene(folder.write("knot.toml", "fidelities = [\"rod\"]\n" + small_scene), field);
  const auto m = rod_parameters(scene).magnetic;
  // B^2/mu_0 is 1989 Pa, of which chi^2/(2 + chi) = 1.
  CHECK(m.squaredNorm() == Approx(0.25 * M_PI * 1989.4 / 1.25e6).epsilon(1e-4));
  CHECK(m.z() / m.y() == Approx(4.0 / 3));
  CHECK(m.x() == 0);
  CHECK(complaint(small_scene, field).find("magnetic cannot be simulated with the solid") !=
        std::string::npos);
}

TEST_CASE("gravity, inertia and damping are refused where they make no sense") {
  for (const char* fidelity : {"fidelities=rod", "fidelities=solid"})
    CHECK(complaint(small_scene, {fidelity, "effects.damping=1"}).find("needs effects.inertia") !=
          std::string::npos);
  CHECK(complaint(small_scene, {"effects.inertia=true", "solid3d.confirm_at=25"})
            .find("only equilibria are confirmed") != std::string::npos);
  CHECK(complaint(small_scene, {"fidelities=rod", "effects.gravity_direction=[0, 0]"})
            .find("three numbers") != std::string::npos);
}

TEST_CASE("natural curvature and twist reach the rod, and not the solid") {
  const TemporaryFolder folder;
  const std::vector<std::string> curved = {"rod.natural_curvature=12 1/m",
                                           "rod.natural_twist=90 degree/m"};
  std::vector<std::string> rod_alone = curved;
  rod_alone.push_back("fidelities=rod");
  const Scene scene = read_scene(folder.write("knot.toml", small_scene), rod_alone);
  CHECK(scene.twist);
  const auto rod = rod_parameters(scene);
  CHECK(rod.natural_curvature == Approx(12 * 8.3e-3));
  CHECK(rod.natural_twist == Approx(0.5 * M_PI * 8.3e-3));
  CHECK_FALSE(rod.follow_knot);
  CHECK(
      complaint(small_scene, curved).find("natural curvature cannot be simulated with the solid") !=
      std::string::npos);
}

TEST_CASE("the quadratic element has its own numbers of cells") {
  const TemporaryFolder folder;
  const auto file = folder.write("scene.toml", small_scene);
  const std::string quadratic = "solid3d.element=quadratic";
  CHECK(read_scene(file, {}).section_elements == 32);
  const Scene scene = read_scene(file, {quadratic, "solid3d.confirm_at=[25]"});
  CHECK(scene.section_elements == 12);
  CHECK(scene.confirm_elements == 21);
  CHECK(sweep_options(scene, 5).degree == 2);
  CHECK_THAT(expectations(read_scene(file, {quadratic, "solid3d.section_elements=5"})),
             Catch::Contains("solid  5 cells in a section"));
  CHECK_THAT(complaint(small_scene, {"solid3d.section_elements=5"}),
             Catch::Contains("fewer than 12") && Catch::Contains("quadratic"));
}

TEST_CASE("what is to be confirmed is said before it runs") {
  const TemporaryFolder folder;
  const Scene scene = read_scene(folder.write("scene.toml", small_scene),
                                 {"solid3d.confirm_at=[25, 20]", "solid3d.confirm_elements=108"});
  const std::string text = expectations(scene);
  for (const char* ebar : {"25", "20"})
    CHECK_THAT(text, Catch::Contains(fmt::format("confirmed at ebar {}: 108 cells", ebar)));
}

TEST_CASE("a pulling force is a path for the rod alone, in newtons") {
  using Catch::Contains;
  const TemporaryFolder folder;
  const std::string pulled = small_scene_with("ebar = [30, 20]", "force = [\"50 mN\", 1]");
  const Scene scene = read_scene(folder.write("pulled.toml", pulled), {"fidelities=rod"});
  CHECK(scene.forces == std::vector<double>{0.05, 1});
  CHECK(rod_parameters(scene).forces[1] == Approx(1 / (1.25e6 * 8.3e-3 * 8.3e-3)));
  CHECK(rod_parameters(scene).path.waypoints.empty());
  CHECK_THAT(expectations(scene), Contains("force -> 0.05 N -> 1 N, 2 states"));
  CHECK(read_scene(folder.write("again.toml", scene.text), {}).text == scene.text);
  CHECK_THAT(complaint(pulled), Contains(":7") && Contains("path.force") && Contains("ebar: only"));
  const auto refused = [&](const std::string& setting) {
    return complaint(pulled, {"fidelities=rod", setting});
  };
  CHECK_THAT(refused("path.ebar=[30, 20]"), Contains("either path.ebar or path.force"));
  CHECK_THAT(refused("path.force=-1 N"), Contains("(0, inf)"));
  CHECK_THAT(refused("path.force=1 m"), Contains("unit of N"));
  CHECK_THAT(refused("path.record=20"), Contains("path.record"));
  CHECK_THAT(refused("effects.inertia=true"), Contains("effects.inertia"));
}
