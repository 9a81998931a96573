#include "coupling/convergence.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace bight::coupling;

TEST_CASE("the order of C h^p is found for any three sizes") {
  const double p = GENERATE(0.5, 1.0, 2.0, 4.0);
  const auto h = GENERATE(std::array{0.25, 0.5, 1.0}, std::array{1 / 680., 1 / 300., 1 / 85.});
  const auto f = [&](double size) { return 7 + 3 * std::pow(size, p); };
  const auto order = observed_order(h, f(h[1]) - f(h[0]), f(h[2]) - f(h[1]));
  REQUIRE(order);
  CHECK(*order == Approx(p).epsilon(1e-6));
  // Richardson: what is left in the finest is found from the two finest.
  CHECK(f(h[0]) + (f(h[0]) - f(h[1])) * error_left(h[0], h[1], *order) == Approx(7).epsilon(1e-9));
}

TEST_CASE("differences that do not fall have no order") {
  const std::array h = {0.25, 0.5, 1.0};
  CHECK_FALSE(observed_order(h, 1, 1));
  CHECK_FALSE(observed_order(h, 1, 1.15));  // p = 0.2
  CHECK_FALSE(observed_order(h, 2, 1));
  CHECK_FALSE(observed_order(h, 0, 1));
  CHECK_FALSE(observed_order(h, 1, 0));
  CHECK_FALSE(observed_order(h, 1e-6, 1));  // beyond 8
}

TEST_CASE("the Pareto front has what nothing is both cheaper and better than") {
  const std::vector<Tradeoff> runs = {{4, 0.1}, {1, 0.5}, {2, 0.6}, {8, 0.1}, {3, 0.2}, {1, 0.4}};
  CHECK(pareto_front(runs) == std::vector<size_t>{5, 4, 0});
  CHECK(pareto_front({}).empty());
  CHECK(cheapest(runs, 0.2) == 4u);
  CHECK(cheapest(runs, 0.1) == 0u);
  CHECK_FALSE(cheapest(runs, 0.09));
}
