// The page of a result: its data, and the verb from outside. What the page draws is checked in a
// browser by tests/report/page.mjs.
#include "coupling/report.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <regex>

#include "call.h"
#include "coupling/errors.h"
#include "coupling/evenly.h"
#include "coupling/pack.h"
#include "coupling/read_surface.h"
#include "coupling/read_table.h"
#include "coupling/report_data.h"
#include "coupling/write_vtu.h"
#include "small_scene.h"
#include "temporary_folder.h"

using namespace bight;
using namespace bight::coupling;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr size_t plenty = 8'000'000;
const Scales scales{0.0083, 1.25e6};

std::vector<std::uint8_t> bytes_of(const std::string& base64) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  unsigned bits = 0, held = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(letters.find(c));
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> held));
  }
  return bytes;
}

std::vector<double> unpacked(const Json& packed) {
  const std::vector<std::uint8_t> bytes = bytes_of(packed["words"]);
  std::vector<double> values;
  for (size_t i = 0; i + 1 < bytes.size(); i += 2)
    values.push_back(packed["from"].get<double>() +
                     packed["step"].get<double>() * (bytes[i] + 256 * bytes[i + 1]));
  return values;
}

solid3d::Mesh short_mesh() { return solid3d::make_mesh(solid3d::make_section(12), {0, 0.5, 1}); }

// A finished run of both fidelities, as far as a report looks at it: two states of the rod, the
// second of the solid too.
void write_result(const TemporaryFolder& folder) {
  for (const char* name : {"rod/centerline", "rod/contacts", "solid/centerline", "solid/vtu"})
    fs::create_directories(folder / name);
  folder.write("scene.toml",
               small_scene_with("\"8.3 mm\"", "0.0083") + "[effects]\nfriction = 0.1\n");
  folder.write("summary.json", R"({"status": "finished", "title": "A </script> knot"})");
  folder.write("run.log", "head\nrod ebar 20 cutbacks 1 (why)\nrod ebar 19\n");
  const std::string header = "ebar,force_normalised,max_penetration\n";
  folder.write("rod/force.csv", header + "20,0.02,0.001\n19.5,0.021,0.001\n19,0.0225,0.002\n");
  folder.write("solid/force.csv", header + "19.5,0.020,0.003\n19,0.0216,0.003\n");
  const std::string line = "s,x,y,z,kappa\n0,0,0,-1,0\n1,0,0.25,0,0.5\n2,0,0,1,0\n";
  folder.write("rod/centerline/ebar_+020.000.csv", line);
  folder.write("rod/centerline/ebar_+019.000.csv", line);
  folder.write("solid/centerline/ebar_+019.000.csv", line);
  folder.write("rod/contacts/ebar_+019.000.csv", "s_a,s_b,force_normalised\n0.25,1.75,0.01\n");
  Series rod(folder / "rod/rod.pvd"), solid(folder / "solid/solid.pvd");
  rod.add(20, "vtu/ebar_+020.000.vtu");
  rod.add(19, "vtu/ebar_+019.000.vtu");
  solid.add(19, "vtu/ebar_+019.000.vtu");
  const solid3d::Mesh mesh = short_mesh();
  solid3d::SolidState state;
  for (int i = 0; i < mesh.nodes(); ++i) state.nodes.push_back(2 * mesh.reference(i));
  state.contact_pressure.assign(mesh.nodes(), 0.0);
  state.contact_pressure.back() = 0.01;
  state.jacobian.assign(mesh.cells.size(), 0.9);
  write_solid_vtu(folder / "solid/vtu/ebar_+019.000.vtu", mesh, state, scales);
}

Json data_of(const std::string& html) {
  const std::string before = "<script type=\"application/json\" id=\"data\">";
  const size_t begin = html.find(before) + before.size();
  return Json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

}  // namespace

TEST_CASE("base64 is that of RFC 4648") {
  const auto [text, coded] = GENERATE(table<std::string, std::string>(
      {{"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}}));
  CHECK(base64({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}) == coded);
}

TEST_CASE("packed numbers come back within half a step, the ends exactly") {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(-3 + 8 * std::sin(0.1 * i));
  const Json packed = pack(values);
  const std::vector<double> back = unpacked(packed);
  REQUIRE(back.size() == values.size());
  const double half_step = 0.5 * 16 / 65535;
  for (size_t i = 0; i < values.size(); ++i)
    CHECK(std::abs(back[i] - values[i]) <= half_step * 1.001);
  CHECK(unpacked(pack(std::vector<double>{7, 7})) == std::vector<double>{7, 7});
  CHECK(unpacked(pack(std::vector<double>{})).empty());
}

TEST_CASE("thinning keeps both ends") {
  CHECK(evenly(3, 5) == std::vector<size_t>{0, 1, 2});
  CHECK(evenly(7, 3) == std::vector<size_t>{0, 3, 6});
  CHECK(evenly(7, 1) == std::vector<size_t>{0});
  CHECK(evenly(7, 0).empty());
}

TEST_CASE("the surface of a mesh is closed, outside, and has the fields of its points and cells") {
  const TemporaryFolder folder;
  const solid3d::Mesh mesh = short_mesh();
  solid3d::SolidState state;
  for (int i = 0; i < mesh.nodes(); ++i) state.nodes.push_back(mesh.reference(i));
  state.gap.resize(mesh.nodes());
  for (int i = 0; i < mesh.nodes(); ++i) state.gap[i] = mesh.reference(i).z();
  for (size_t c = 0; c < mesh.cells.size(); ++c)
    state.jacobian.push_back(mesh.reference(mesh.cells[c][0]).z() < 0.25 ? 1.0 : 3.0);
  write_solid_vtu(folder / "state.vtu", mesh, state, scales);
  const Surface surface = read_surface(folder / "state.vtu");

  // A closed surface of quads around one body: edges = 2 quads, Euler's points - edges + quads = 2.
  CHECK(surface.points.size() == surface.quads.size() + 2);
  Vector3 area = Vector3::Zero();
  double volume = 0;
  for (const auto& quad : surface.quads) {
    const Vector3 &a = surface.points[quad[0]], &b = surface.points[quad[1]],
                  &c = surface.points[quad[2]], &d = surface.points[quad[3]];
    const Vector3 normal = 0.5 * (c - a).cross(d - b);
    area += normal;
    volume += normal.dot(0.25 * (a + b + c + d)) / 3;
  }
  CHECK(area.norm() < 1e-15);
  // pi/4 D^3 less what 12 sides cut off, more than the scaled second moment gives back.
  CHECK(std::abs(volume) == Approx(M_PI / 4 * std::pow(0.0083, 3)).epsilon(0.05));
  for (size_t i = 0; i < surface.points.size(); ++i) {
    const double z = surface.points[i].z() / 0.0083;
    CHECK(surface.fields.at("gap")[i] == Approx(surface.points[i].z()).margin(1e-15));
    CHECK(surface.fields.at("J")[i] == Approx(z < 0.25 ? 1 : z > 0.75 ? 3 : 2));
  }
  CHECK(surface.fields.count("reference") == 0);
}

TEST_CASE("the data of a page are those of the files") {
  const TemporaryFolder folder;
  write_result(folder);
  folder.write("measured.csv", "ebar;force_normalised\n19,8;0,02\n19,2;0,022\n");
  const Json data = report_data(folder.path(), {folder / "measured.csv"}, plenty);

  const Table force = read_table(folder / "rod/force.csv");
  CHECK(data["force"]["rod"]["rows"] == 3);
  for (size_t k = 0; k < force.names.size(); ++k)
    for (size_t i = 0; i < 3; ++i)
      CHECK(data["force"]["rod"][force.names[k]][i] == force.rows[i][k]);
  CHECK(data["force"]["solid"]["force_normalised"] == Json({0.020, 0.0216}));
  CHECK(data["scene"]["rod"]["diameter"] == 0.0083);
  CHECK(data["scene_text"] == text_of(folder / "scene.toml"));
  CHECK(data["summary"]["status"] == "finished");
  CHECK(data["notes"] == Json({"rod ebar 20 cutbacks 1 (why)"}));
  CHECK(data["measured"][0]["ebar"] == Json({19.8, 19.2}));

  CHECK(data["comparison"]["names"] == Json({"rod", "solid", "measured"}));
  const Json& last = data["comparison"]["rows"].back();
  CHECK(last["ebar"] == 19.0);
  CHECK(last["difference"][1].get<double>() == Approx(0.0216 / 0.0225 - 1));
  CHECK(last["difference"][2].is_null());
  // pi^2/(2 19^2) + 0.492 mu (pi/19)^1.5
  CHECK(last["law"].get<double>() == Approx(0.0136698 + 0.0033077).epsilon(1e-4));
  CHECK(data["law"].front()["ebar"] == 20.0);
  CHECK(data["law"].back()["ebar"] == 19.0);

  const Json& states = data["states"];
  REQUIRE(states["list"].size() == 2);
  CHECK(states["recorded"] == 2);
  CHECK(states["list"][0]["name"] == "ebar_+020.000");
  CHECK_FALSE(states["list"][0].contains("solid"));
  const Json& tight = states["list"][1];
  CHECK(tight["ebar"] == 19.0);
  CHECK(unpacked(tight["rod"]["kappa"])[1] == Approx(0.5));
  CHECK_FALSE(states["list"][0].contains("contacts"));
  CHECK(unpacked(tight["contacts"]["s_b"]) == std::vector<double>{1.75});
  const auto line_z = unpacked(tight["solid"]["z"]);
  REQUIRE(line_z.size() == 3);
  CHECK(line_z.front() == -1);
  CHECK(line_z[1] == Approx(0).margin(2e-5));
  const Surface surface = read_surface(folder / "solid/vtu/ebar_+019.000.vtu");
  const auto x = unpacked(tight["surface"]["x"]), z = unpacked(tight["surface"]["z"]);
  REQUIRE(x.size() == surface.points.size());
  for (size_t i = 0; i < x.size(); ++i) {
    CHECK(x[i] == Approx(surface.points[i].x() / 0.0083).margin(2e-5));
    CHECK(z[i] == Approx(surface.points[i].z() / 0.0083).margin(2e-5));
  }
  const auto pressure = unpacked(tight["surface"]["contact_pressure"]);
  CHECK(*std::ranges::max_element(pressure) == Approx(1.25e4));
  CHECK(unpacked(tight["surface"]["J"])[0] == Approx(0.9));
  CHECK(bytes_of(states["quads"]["words"]).size() == 16 * surface.quads.size());
}

TEST_CASE("states are thinned to the room there is, to none if need be") {
  const TemporaryFolder folder;
  write_result(folder);
  const size_t whole = report_data(folder.path(), {}, plenty).dump().size();
  for (const size_t bytes : {plenty, whole, whole - 100, whole / 2, size_t{0}}) {
    const Json data = report_data(folder.path(), {}, bytes);
    CAPTURE(bytes, whole);
    CHECK(data["states"]["recorded"] == 2);
    CHECK((data.dump().size() <= bytes || data["states"]["list"].empty()));
    CHECK((data["states"]["list"].size() == 2) == (bytes >= whole));
  }
}

TEST_CASE("states with another mesh are no states of the same run") {
  const TemporaryFolder folder;
  write_result(folder);
  const solid3d::Mesh mesh = solid3d::make_mesh(solid3d::make_section(12), {0, 1});
  solid3d::SolidState state;
  for (int i = 0; i < mesh.nodes(); ++i) state.nodes.push_back(mesh.reference(i));
  write_solid_vtu(folder / "solid/vtu/ebar_+020.000.vtu", mesh, state, scales);
  fs::copy(folder / "rod/centerline/ebar_+020.000.csv",
           folder / "solid/centerline/ebar_+020.000.csv");
  Series solid(folder / "solid/solid.pvd");
  solid.add(20, "vtu/ebar_+020.000.vtu");
  solid.add(19, "vtu/ebar_+019.000.vtu");
  CHECK_THROWS_WITH(report_data(folder.path(), {}, plenty),
                    Catch::Matchers::Contains("ebar_+019.000.vtu: another mesh"));
}

TEST_CASE("a run that is not finished has a page without its summary") {
  const TemporaryFolder folder;
  write_result(folder);
  for (const char* file : {"summary.json", "run.log", "solid/solid.pvd"}) fs::remove(folder / file);
  const Json data = report_data(folder.path(), {}, plenty);
  CHECK(data["summary"].is_null());
  CHECK(data["states"]["list"].size() == 2);
  CHECK(data["force"]["solid"]["rows"] == 2);
  folder.write("solid/force.csv",
               "ebar,force_normalised,max_penetration\n");  // seeded, no step yet
  CHECK_FALSE(report_data(folder.path(), {}, plenty)["force"].contains("solid"));
}

TEST_CASE("the page of a run is one file that loads nothing") {
  const TemporaryFolder folder;
  folder.write("quick.toml", "fidelities = [\"rod\"]\n" + small_scene_with("[30, 20]", "[30, 29]") +
                                 "record = [30, 29]\n[rod1d]\nsegments = 120\n");
  folder.write("page.js", "console.log('the page');\n");
  REQUIRE(call(folder, "run quick.toml --quiet").status == 0);
  const Outcome outcome = call(folder, "report results/quick --script page.js");
  CAPTURE(outcome.complained);
  REQUIRE(outcome.status == 0);
  CHECK(outcome.said.starts_with("results/quick/report.html: "));
  const std::string html = text_of(folder / "results/quick/report.html");
  CHECK(html.find("console.log('the page');") != html.npos);
  CHECK(html.find("default-src 'none'") != html.npos);
  CHECK_FALSE(std::regex_search(html, std::regex("(src|href)\\s*=|url\\(|https?:|import\\s*\\(")));
  CHECK(html.size() < largest_report);
  const Json data = data_of(html);
  const Table force = read_table(folder / "results/quick/rod/force.csv");
  CHECK(data["force"]["rod"]["rows"] == force.rows.size());
  CHECK(data["summary"]["rod"]["effects"].size() == 3);
  REQUIRE(data["states"]["list"].size() == 2);
  const Table line = read_table(folder / "results/quick/rod/centerline/ebar_+029.000.csv");
  const auto kappa = unpacked(data["states"]["list"][1]["rod"]["kappa"]);
  REQUIRE(kappa.size() == line.rows.size());
  for (size_t i = 0; i < kappa.size(); ++i)
    CHECK(kappa[i] == Approx(line.rows[i][line.column("kappa")]).margin(1e-5));

  const Outcome elsewhere = call(folder, "report results/quick --script page.js --out mine.html");
  CHECK(elsewhere.said.starts_with("mine.html: "));
  CHECK(text_of(folder / "mine.html") == html);
  // A report is not in the way of its run.
  CHECK(call(folder, "run quick.toml").said.find("finished result") != std::string::npos);
  CHECK(call(folder, "run quick.toml --set path.max_step=1 --force --quiet").status == 0);
  CHECK_FALSE(fs::exists(folder / "results/quick/report.html"));
}

TEST_CASE("text of a result cannot end the page's data") {
  const TemporaryFolder folder;
  write_result(folder);
  folder.write("page.js", "0");
  REQUIRE(call(folder, "report . --script page.js").status == 0);
  const std::string html = text_of(folder / "report.html");
  CHECK(data_of(html)["summary"]["title"] == "A </script> knot");
}

TEST_CASE("a study has a page") {
  const TemporaryFolder folder;
  folder.write("study.csv", "run,fidelity\n\"a,b\",rod\n");
  folder.write("study.json", R"({"cases": [{"sentences": ["one"]}]})");
  const Json data = report_data(folder.path(), {}, plenty);
  CHECK(data["study"]["csv"] == "run,fidelity\n\"a,b\",rod\n");
  CHECK(data["study"]["json"]["cases"][0]["sentences"][0] == "one");
  CHECK_FALSE(data.contains("states"));
}

TEST_CASE("a report that cannot be made says why and writes nothing") {
  const TemporaryFolder folder;
  write_result(folder);
  fs::create_directory(folder / "empty");
  fs::create_directories(folder / "broken/rod");
  folder.write("broken/rod/force.csv", "ebar,force_normalised\n20,many\n");
  folder.write("page.js", "0");
  folder.write("big.js", std::string(largest_report - 100, ' '));
  struct Trial {
    std::string words, file, text;
    int status;
    std::string what;
  };
  const Trial trial = GENERATE(
      Trial{"nowhere", "", "", 2, "nowhere: there is no such folder"},
      Trial{"page.js", "", "", 2, "there is no such folder"},
      Trial{"empty", "", "", 2, "no result"},
      Trial{"broken", "", "", 2, "broken/rod/force.csv:2: not all are numbers"},
      Trial{". --measured nothing.csv", "", "", 2, "nothing.csv: there is no such file"},
      Trial{". --script nothing.js", "", "", 3,
            "nothing.js: there is no such file; ./bight report"},
      Trial{". --script big.js", "", "", 3, "8.0 MB, and 8 MB is the limit"},
      Trial{". --out /proc/report.html", "", "", 3, "cannot be written"},
      Trial{".", "solid/vtu/ebar_+019.000.vtu", "<VTKFile>", 3, "cannot be read as a mesh"},
      Trial{".", "summary.json", "{\"status\": ", 3, "summary.json: cannot be read as JSON"},
      Trial{".", "scene.toml", "[rod]\nlength = \n", 3, "scene.toml:2: cannot be read as TOML"},
      Trial{".", "scene.toml", "[rod]\n", 3, "scene.toml: no rod.diameter"});
  if (!trial.file.empty()) folder.write(trial.file, trial.text);
  const std::string script =
      trial.words.find("--script") == std::string::npos ? " --script page.js" : "";
  const Outcome outcome = call(folder, "report " + trial.words + script);
  CAPTURE(trial.words, trial.file, outcome.complained);
  CHECK(outcome.status == trial.status);
  CHECK(outcome.complained.find(trial.what) != std::string::npos);
  CHECK(lines(outcome.complained) == 1);
  CHECK(outcome.said.empty());
  CHECK_FALSE(fs::exists(folder / "report.html"));
}
