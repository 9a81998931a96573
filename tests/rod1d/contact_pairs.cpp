#include "rod1d/contact_pairs.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <set>

using namespace bight;
using namespace bight::rod1d;

TEST_CASE("the tree finds every pair within reach, and none that is far") {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  const int nodes = 400;
  Vector x = Vector::Zero(3 * nodes);
  std::vector<double> arc{0};
  for (int i = 1; i < nodes; ++i) {
    Vector3 step(normal(generator), normal(generator), normal(generator));
    step *= 0.3 / step.norm();
    x.segment<3>(3 * i) = x.segment<3>(3 * i - 3) + step;
    arc.push_back(arc.back() + 0.3);
  }
  const double reach = 0.7, exclusion = 1.5;
  std::set<std::pair<int, int>> found, allowed;
  for (const ContactWindow& w : contact_windows(x, arc, reach, exclusion))
    for (int j = w.first; j <= w.last; ++j) found.insert({w.segment, j});
  for (int i = 0; i + 1 < nodes; ++i)
    for (int j = i + 1; j + 1 < nodes; ++j) {
      const auto on = [&](int k, double u) -> Vector3 {
        return (1 - u) * x.segment<3>(3 * k) + u * x.segment<3>(3 * k + 3);
      };
      if (arc[j + 1] - arc[i] < exclusion || (on(i, 0.5) - on(j, 0.5)).norm() >= reach + 0.3)
        continue;
      allowed.insert({i, j}), allowed.insert({j, i});
      double smallest = reach;
      for (int k = 0; k <= 4; ++k)
        for (int l = 0; l <= 4; ++l)
          smallest = std::min(smallest, (on(i, 0.25 * k) - on(j, 0.25 * l)).norm());
      if (smallest < reach) CHECK(found.count({i, j}) + found.count({j, i}) == 2);
    }
  CHECK(found.size() > 100);
  CHECK(std::includes(allowed.begin(), allowed.end(), found.begin(), found.end()));
}
