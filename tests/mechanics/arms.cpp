#include "mechanics/arms.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <numeric>
#include <set>

#include "mechanics/sparse_cholesky.h"

using namespace bight;

namespace {

/// A rod of `layers` sections of side x side vertices, coupled with all neighbours (27-point
/// stencil), and `touches`: pairs of sections of which one face touches the other.
struct Bar {
  int side, layers;
  std::vector<std::pair<int, int>> touches = {};

  int section() const { return side * side; }
  int size() const { return section() * layers; }
  int layer(int vertex) const { return vertex / section(); }

  std::vector<std::set<int>> neighbours() const {
    std::vector<std::set<int>> all(static_cast<size_t>(size()));
    const auto couple = [&](int a, int b) {
      if (a != b) all[a].insert(b), all[b].insert(a);
    };
    for (int v = 0; v < size(); ++v)
      for (int k = layer(v); k <= std::min(layer(v) + 1, layers - 1); ++k)
        for (int p = 0; p < section(); ++p) {
          const int q = v % section();
          if (std::abs(p / side - q / side) <= 1 && std::abs(p % side - q % side) <= 1)
            couple(v, k * section() + p);
        }
    for (const auto& [k, l] : touches)
      for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) couple(k * section() + i, l * section() + side * j);
    return all;
  }
  Graph graph() const {
    Graph graph;
    for (const auto& list : neighbours()) {
      graph.neighbour.insert(graph.neighbour.end(), list.begin(), list.end());
      graph.begin.push_back(static_cast<int>(graph.neighbour.size()));
    }
    return graph;
  }
  /// Three unknowns a vertex.
  SymmetricMatrix matrix() const {
    SymmetricMatrix m;
    m.column_start = {0};
    const auto near = neighbours();
    for (int v = 0; v < size(); ++v)
      for (int c = 0; c < 3; ++c) {
        for (int d = 0; d < 3; ++d) m.row.push_back(3 * v + d), m.value.push_back(c == d ? 100 : 0);
        for (const int w : near[v])
          for (int d = 0; d < 3; ++d)
            if (w > v) m.row.push_back(3 * w + d), m.value.push_back(-1);
        m.column_start.push_back(static_cast<int>(m.row.size()));
      }
    return m;
  }
};

/// A rod that touches itself around its layers 60 and 100.
Bar knot() {
  Bar bar{4, 160};
  for (int k = 0; k < 12; ++k) bar.touches.emplace_back(55 + k, 106 - k);
  return bar;
}

std::vector<int> order(const Arms& arms) {
  std::vector<int> all = arms.first;
  all.insert(all.end(), arms.rest.begin(), arms.rest.end());
  all.insert(all.end(), arms.last.begin(), arms.last.end());
  return all;
}

}  // namespace

TEST_CASE("arms and what they hang on are all of the graph, each vertex once") {
  for (const Bar& bar : {Bar{4, 160}, knot(), Bar{3, 3}, Bar{1, 1}, Bar{1, 50}}) {
    std::vector<int> all = order(find_arms(bar.graph()));
    std::ranges::sort(all);
    std::vector<int> expected(static_cast<size_t>(bar.size()));
    std::iota(expected.begin(), expected.end(), 0);
    CHECK(all == expected);
  }
  CHECK(order(find_arms(Graph{})).empty());
}

TEST_CASE("both tails of a knot are arms, its loop and its contact are not") {
  const Bar bar = knot();
  const Arms arms = find_arms(bar.graph());
  std::set<int> layers;
  for (const auto* list : {&arms.first, &arms.last})
    for (const int v : *list) layers.insert(bar.layer(v));
  for (int k = 0; k < 50; ++k) CHECK(layers.contains(k));
  for (int k = 55; k <= 106; ++k) CHECK_FALSE(layers.contains(k));
  for (int k = 110; k < 160; ++k) CHECK(layers.contains(k));
}

TEST_CASE("of a straight rod both halves are eliminated towards the middle") {
  const Bar bar{4, 160};
  const Arms arms = find_arms(bar.graph());
  REQUIRE(arms.first.size() > 1);
  REQUIRE(arms.last.size() > 1);
  CHECK(std::abs(bar.layer(arms.first.back()) - bar.layer(arms.last.back())) == 1);
  CHECK(arms.first.size() == Approx(arms.last.size()).margin(8 * bar.section()));
}

TEST_CASE("two rods that do not touch have four arms") {
  Graph graph = Bar{3, 60}.graph();
  const int edges = static_cast<int>(graph.neighbour.size()), vertices = graph.size();
  for (int k = 0; k < edges; ++k) graph.neighbour.push_back(graph.neighbour[k] + vertices);
  for (int v = 1; v <= vertices; ++v) graph.begin.push_back(graph.begin[v] + edges);
  CHECK(find_arms(graph).rest.size() == 2 * 9);
}

TEST_CASE("a cube has no arms, nor has a bar three times as long as wide") {
  for (const Bar& body : {Bar{8, 8}, Bar{4, 12}}) {
    const Arms arms = find_arms(body.graph());
    CHECK(arms.first.empty());
    CHECK(arms.last.empty());
    CHECK(static_cast<int>(arms.rest.size()) == body.size());
  }
}

TEST_CASE("a rod is factored with the work of its sections, from either end") {
  // Each of the 3 b^2 columns has the rest of its section below it, and its part of the next one.
  const Bar bar{6, 120};
  SparseCholesky cholesky;
  cholesky.analyse(bar.matrix(), Ordering::dissection);
  const double columns = 3.0 * bar.section();
  CHECK(cholesky.factor_flops() < 120 * columns * (1.3 * columns) * (1.3 * columns));
  REQUIRE(cholesky.factor(bar.matrix()));
  const Vector b = Vector::LinSpaced(3 * bar.size(), -1, 2);
  const Vector x = cholesky.solve(b);
  CHECK((bar.matrix().times(x) - b).norm() < 1e-12 * b.norm());
}
