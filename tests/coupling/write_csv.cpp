#include "coupling/write_csv.h"

#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <csignal>

#include "coupling/errors.h"
#include "coupling/read_table.h"
#include "temporary_folder.h"

using namespace bight;
using namespace bight::coupling;

TEST_CASE("force.csv begins with the agreed columns and holds SI and normalised forces") {
  const TemporaryFolder folder;
  const Scales scales{0.0083, 1.25e6};
  ForceCsv csv(folder / "force.csv", scales);
  StepRow row;
  row.ebar = 19.5;
  row.tension = 0.1 / 3;
  row.energy = 0.2;
  csv.step(row);
  const std::string text = text_of(folder / "force.csv");
  CHECK(
      text.starts_with("ebar,force_normalised,force_N,energy_J,dissipated_J,max_penetration,"
                       "contact_pairs,newton_iterations,wall_s"));
  CHECK(text.ends_with('\n'));
  const Table table = read_table(folder / "force.csv");
  CHECK(table.rows[0][table.column("force_normalised")] ==
        Approx(0.1 / 3 * 16 / M_PI).epsilon(1e-11));
  CHECK(table.rows[0][table.column("force_n")] ==
        Approx(0.1 / 3 * 1.25e6 * 0.0083 * 0.0083).epsilon(1e-11));
  CHECK(table.rows[0].size() == table.names.size());
}

TEST_CASE("a row that does not fit on the disk is absent, not cut") {
  const TemporaryFolder folder;
  LineFile file(folder / "lines", "header");
  file.line("first row");
  rlimit old_limit{};
  getrlimit(RLIMIT_FSIZE, &old_limit);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit full{20, old_limit.rlim_max};  // header and first row take 17 bytes
  setrlimit(RLIMIT_FSIZE, &full);
  CHECK_THROWS_AS(file.line("second row"), FileError);
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  CHECK(text_of(folder / "lines") == "header\nfirst row\n");
}

TEST_CASE("names of states sort and carry three decimals") {
  CHECK(state_name(20) == "ebar_+020.000");
  CHECK(state_name(-9.5) == "ebar_-009.500");
  CHECK(state_name(-1e-9) == "ebar_+000.000");
  CHECK(state_name(225.1234) == "ebar_+225.123");
}

TEST_CASE("a centerline file has s, x, y, z, kappa and what more there is") {
  const TemporaryFolder folder;
  const std::vector<double> s = {0, 1. / 3}, kappa = {0, 0.25}, more = {7, 8};
  write_centerline(folder / "c.csv", s, {Vector3(1, 2, 3), Vector3(4, 5, 6)}, kappa,
                   {{"force", more}, {"absent", {}}});
  const Table table = read_table(folder / "c.csv");
  CHECK(table.names == std::vector<std::string>{"s", "x", "y", "z", "kappa", "force"});
  CHECK(table.rows[1][0] == Approx(1. / 3).epsilon(1e-11));
  CHECK(table.rows[1][5] == 8);
}
