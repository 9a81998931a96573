#include "coupling/cases.h"

#include <catch2/catch.hpp>

#include "call.h"
#include "coupling/errors.h"
#include "small_scene.h"

using namespace bight::coupling;
using Catch::Contains;

namespace {

const std::string two_cases = small_scene + R"(
[cases.smooth]

[cases.rough]
effects.friction = 0.1
rod1d.segments = 120
)";

}  // namespace

TEST_CASE("cases are the scene with what each sets, in their order, and --set overrides both") {
  TemporaryFolder folder;
  const auto file = folder.write("scene.toml", two_cases);
  const auto cases = read_cases(file, {"path.max_step=0.25"}, {"rod"}, "");
  REQUIRE(cases.size() == 2);
  CHECK(cases[0].name == "smooth");
  CHECK(cases[1].name == "rough");
  CHECK(cases[0].scene.friction == 0);
  CHECK(cases[1].scene.friction == 0.1);
  CHECK(cases[1].scene.segments == 120);
  CHECK(cases[0].scene.segments != 120);
  for (const SceneCase& c : cases) {
    CHECK(c.scene.path.max_step == 0.25);
    CHECK(c.scene.text.find("cases") == std::string::npos);
  }
  CHECK(read_cases(file, {"effects.friction=0.2"}, {"rod"}, "")[1].scene.friction == 0.2);
}

TEST_CASE("a scene without cases is one, and one case can be picked") {
  TemporaryFolder folder;
  const auto plain = folder.write("plain.toml", small_scene);
  CHECK(read_cases(plain, {}, {"rod"}, "").at(0).name.empty());
  const auto file = folder.write("scene.toml", two_cases);
  const auto one = read_cases(file, {}, {"rod"}, "rough");
  REQUIRE(one.size() == 1);
  CHECK(one[0].scene.friction == 0.1);
  CHECK_THROWS_WITH(read_cases(file, {}, {"rod"}, "ruff"), Contains("smooth, rough"));
  CHECK_THROWS_WITH(read_cases(plain, {}, {"rod"}, "rough"), Contains("no cases"));
}

TEST_CASE("mistakes in cases are told with line, case and key") {
  TemporaryFolder folder;
  const auto wrong_key = folder.write("a.toml", small_scene + "[cases.a]\nrod1d.segment = 20\n");
  CHECK_THROWS_WITH(read_cases(wrong_key, {}, {}, ""), Contains("a.toml:9") &&
                                                           Contains("cases.a.rod1d.segment") &&
                                                           Contains("nearest is rod1d.segments"));
  const auto wrong_value = folder.write("b.toml", small_scene + "[cases.a]\nrod1d.segments = -1\n");
  CHECK_THROWS_WITH(read_cases(wrong_value, {}, {}, ""),
                    Contains("case a") && Contains("rod1d.segments"));
  const auto no_table = folder.write("c.toml", small_scene + "[cases]\na = 1\n");
  CHECK_THROWS_WITH(read_cases(no_table, {}, {}, ""), Contains("a case is a table"));
  const auto bad_name = folder.write("d.toml", small_scene + "[cases.\"a/b\"]\n");
  CHECK_THROWS_WITH(read_cases(bad_name, {}, {}, ""), Contains("letters, digits"));
}

TEST_CASE("cases run in folders of their own and are laid on each other") {
  TemporaryFolder folder;
  folder.write("scene.toml", two_cases);
  const std::string words =
      "rod scene.toml --quiet --set path.ebar=[30,29] --set rod1d.segments=100";
  const Outcome ran = call(folder, words);
  CHECK(ran.status == 0);
  CHECK(ran.complained.empty());
  const auto results = folder / "results/scene";
  for (const char* name : {"smooth", "rough"}) {
    CHECK(std::filesystem::exists(results / name / "summary.json"));
    CHECK(lines(text_of(results / name / "rod/force.csv")) > 2);
  }
  const std::string table = text_of(results / "compare.csv");
  CHECK_THAT(table, Contains("smooth_rod") && Contains("rough_rod"));
  // All are finished: nothing is run again.
  const Outcome again = call(folder, words);
  CHECK(again.status == 0);
  CHECK_THAT(again.said, Contains("results/scene/smooth") && Contains("results/scene/rough"));
}
