#include "coupling/validity.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace bight;
using namespace bight::coupling;

namespace {

/// U = u exp(-rate ebar) and T = 1, so that the error is c u rate exp(-rate ebar).
std::vector<StepRow> rows(double rate, double from, double to, double step) {
  std::vector<StepRow> list;
  for (double ebar = from; ebar > to - 1e-9; ebar -= step) {
    StepRow row;
    row.ebar = ebar;
    row.tension = 1;
    row.flattening = std::exp(-rate * ebar);
    list.push_back(row);
  }
  return list;
}

}  // namespace

TEST_CASE("the rod's error is the rate of the energy of flattening over T, calibrated") {
  const auto errors = rod_errors(rows(0.3, 20, 10, 0.5));
  REQUIRE(errors.size() == 21);
  const double c = errors[0].relative / (0.3 * std::exp(-0.3 * 20));
  CHECK(c > 1);
  for (const RodError& at : errors)
    CHECK(at.relative == Approx(c * 0.3 * std::exp(-0.3 * at.ebar)).epsilon(1e-9));
}

TEST_CASE("the ebar down to which a rod is valid lies between its states, and has a range") {
  const auto errors = rod_errors(rows(0.3, 20, 0, 0.5));
  const double c = errors[0].relative / (0.3 * std::exp(-0.3 * 20));
  const auto valid = valid_down_to(errors, 0.05);
  REQUIRE(valid);
  CHECK(valid->reached);
  CHECK(valid->ebar == Approx(std::log(c * 0.3 / 0.05) / 0.3).margin(0.02));
  CHECK(valid->earliest > valid->ebar);
  CHECK(valid->latest < valid->ebar);
}

TEST_CASE("a rod may be valid along the whole path, nowhere, or of unknown error") {
  const auto errors = rod_errors(rows(0.3, 20, 15, 0.5));
  CHECK_FALSE(valid_down_to(errors, 0.5)->reached);
  CHECK(valid_down_to(errors, 0.5)->ebar == 15);
  CHECK_FALSE(valid_down_to(errors, 1e-6));
  CHECK(rod_errors({}).empty());
  CHECK_FALSE(valid_down_to({}, 0.05));
  auto apart = rows(0.3, 20, 15, 0.5);
  for (StepRow& row : apart) row.flattening = 0;
  CHECK(rod_errors(apart).empty());
  CHECK(validity_sentence({}, 0.05).starts_with("no estimate"));
}

TEST_CASE("the estimate ends where it is too large to be one") {
  const auto errors = rod_errors(rows(0.5, 20, -10, 0.5));
  REQUIRE(errors.size() > 3);
  CHECK(errors.back().relative > 0.3);
  CHECK(errors[errors.size() - 2].relative <= 0.3);
}

TEST_CASE("loosening and tightening again do not change the verdict on the first tightening") {
  auto list = rows(0.3, 20, 10, 0.5);
  const auto once = rod_errors(list);
  for (StepRow row : rows(0.3, 20, 10, 0.5)) {
    row.flattening *= 3;
    list.push_back(row);
  }
  CHECK(rod_errors(list).size() == once.size());
}
