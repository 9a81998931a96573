#include "coupling/study_cases.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace bight::coupling;

namespace {

// A made-up model: T = 2 + mu + 30/N^2 + 0.01 h at three ebar, in N/100 s, twice that for half h.
struct MadeUp {
  std::vector<Dimension> grid;
  std::vector<GridPoint> points = product(grid);
  std::vector<StudyRow> rows;

  explicit MadeUp(const std::vector<std::string>& lines) : grid(read_grid(lines)) {
    for (size_t i = 0; i < points.size(); ++i) {
      const auto value = [&](size_t d) { return std::stod(grid[d].values[points[i].at[d]]); };
      const double mu = value(0), N = value(1), h = value(2);
      StudyRow row{i, "rod", "finished", "", "", {}};
      for (const double ebar : {20., 10., 5.}) {
        const double force = 2 + mu + 30 / (N * N) + 0.01 * h;
        row.states[{ebar, 1}] = {ebar, force, 10 * force};
      }
      row.wall_s = N / 100 / h;
      rows.push_back(row);
    }
  }
};

const std::vector<std::string> lines = {"effects.friction=0,1", "rod1d.segments=10,20,40",
                                        "path.max_step=1,0.5,0.25"};

}  // namespace

TEST_CASE("each problem is measured against its own finest run") {
  MadeUp made(lines);
  const auto cases = study_cases(made.grid, made.points, made.rows, "");
  REQUIRE(cases.size() == 2);
  CHECK(cases[1].problem == std::vector<std::string>{"effects.friction=1"});
  for (const StudyCase& of : cases) {
    CHECK(of.rows.size() == 9);
    REQUIRE(of.reference);
    CHECK(made.points[made.rows[*of.reference].point].at[1] == 2);
    CHECK(made.points[made.rows[*of.reference].point].at[2] == 2);
    CHECK(made.rows[*of.reference].error->force_largest == 0);
  }
  const double reference = 2 + 30 / 1600. + 0.0025, coarse = 2 + 30 / 100. + 0.01;
  CHECK(made.rows[0].error->force_largest == Approx((coarse - reference) / reference));
  CHECK(made.rows[0].error->energy_mean == Approx((coarse - reference) / reference));
  CHECK(made.rows[0].error->states == 3);
}

TEST_CASE("orders are those of the model, and bound what is left in the reference") {
  MadeUp made(lines);
  const auto cases = study_cases(made.grid, made.points, made.rows, "");
  REQUIRE(cases[0].orders.size() == 2);
  CHECK(cases[0].orders[0].values == std::vector<std::string>{"40", "20", "10"});
  CHECK(*cases[0].orders[0].force_largest == Approx(2));
  CHECK(*cases[0].orders[0].force_mean == Approx(2));
  CHECK(*cases[0].orders[0].energy == Approx(2));
  CHECK(*cases[0].orders[1].force_mean == Approx(1));
  const double left = (30 / 1600. + 0.0025) / (2 + 30 / 1600. + 0.0025);
  CHECK(cases[0].uncertainty() == Approx(1.25 * left));
}

TEST_CASE("an extrapolated reference is where the model converges to") {
  MadeUp made(lines);
  const auto cases = study_cases(made.grid, made.points, made.rows, "rod1d.segments");
  REQUIRE(cases[0].extrapolated);
  const double limit = 2 + 0.0025;
  CHECK(made.rows[*cases[0].reference].error->force_largest == Approx(30 / 1600. / limit));
  CHECK(made.rows[0].error->force_largest == Approx((30 / 100. + 0.0075) / limit));
  CHECK(cases[0].uncertainties[0].force == Approx(0.25 * 30 / 1600. / limit));
  CHECK(cases[0].front.back() == *cases[0].reference);
}

TEST_CASE("the front is made of what finished, without the reference") {
  MadeUp made(lines);
  made.rows[3].status = "gave up";  // N = 20, h = 1
  const auto cases = study_cases(made.grid, made.points, made.rows, "");
  // N = 10; N = 40, h = 1; h = 0.5. Others cost more for less, or gave up.
  CHECK(cases[0].front == std::vector<size_t>{0, 1, 6, 7});
  CHECK(made.rows[7].on_front);
  CHECK_FALSE(made.rows[8].on_front);
}

TEST_CASE("a finest run that gave up is not the reference") {
  MadeUp made(lines);
  made.rows[8].status = "gave up";
  made.rows[8].states.erase({5, 1});
  const auto cases = study_cases(made.grid, made.points, made.rows, "");
  CHECK((*cases[0].reference == 5 || *cases[0].reference == 7));
  CHECK(made.rows[8].error->states == 2);
  for (StudyRow& row : made.rows) row.status = "failed";
  CHECK_FALSE(study_cases(made.grid, made.points, made.rows, "")[0].reference);
}

TEST_CASE("keys of the solid do not make another rod") {
  MadeUp made({"effects.friction=0", "rod1d.segments=10,20", "solid3d.axial_ratio=1,2"});
  const auto cases = study_cases(made.grid, made.points, made.rows, "");
  REQUIRE(cases.size() == 1);
  CHECK(cases[0].rows == std::vector<size_t>{0, 2});
  CHECK(resolution_settings(made.grid, made.points[0], "rod") ==
        std::vector<std::string>{"rod1d.segments=10"});
  CHECK(resolution_settings(made.grid, made.points[0], "solid").size() == 2);
}

TEST_CASE("the rod's reference is held against the solid's of the same problem") {
  MadeUp made(lines);
  const size_t rods = made.rows.size();
  for (size_t i = 0; i < rods; ++i) {
    StudyRow solid = made.rows[i];
    solid.fidelity = "solid";
    for (auto& [when, state] : solid.states) state.force *= 1 - 1 / state.ebar;
    solid.states.erase({20, 1});
    made.rows.push_back(solid);
  }
  const auto cases = study_cases(made.grid, made.points, made.rows, "");
  REQUIRE(cases.size() == 4);
  for (const StudyCase& of : cases) {
    if (of.fidelity == "solid") {
      CHECK(of.from_solid.empty());
      continue;
    }
    REQUIRE(of.from_solid.size() == 2);
    CHECK(of.from_solid[0].ebar == 10);
    CHECK(of.from_solid[1].ebar == 5);
    CHECK(of.from_solid[0].force == Approx(1 / 0.9 - 1));
    CHECK(of.from_solid[1].force == Approx(1 / 0.8 - 1));
  }
}

TEST_CASE("orders are taken from values a factor of two apart") {
  MadeUp made({"effects.friction=0", "rod1d.segments=10,14,20,28,40", "path.max_step=1"});
  const auto cases = study_cases(made.grid, made.points, made.rows, "");
  REQUIRE(cases[0].orders.size() == 1);
  CHECK(cases[0].orders[0].values == std::vector<std::string>{"40", "20", "10"});
  CHECK(*cases[0].orders[0].force_largest == Approx(2));
}
