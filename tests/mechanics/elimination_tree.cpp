#include "mechanics/elimination_tree.h"

#include <omp.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <random>

using namespace bight;

namespace {

/// A tree in postorder: every node waits for up to three that have no parent yet.
std::vector<int> postordered(int count, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<int> parent(static_cast<size_t>(count), -1), open;
  for (int s = 0; s < count; ++s) {
    for (int children = static_cast<int>(generator() % 4); children > 0 && !open.empty();
         --children) {
      parent[open.back()] = s;
      open.pop_back();
    }
    open.push_back(s);
  }
  return parent;
}

}  // namespace

TEST_CASE("every supernode is met once, children before parents and parents before children") {
  const unsigned seed = GENERATE(range(0u, 20u));
  const int count = static_cast<int>(seed) * 13;
  const std::vector<int> parent = postordered(count, seed);
  std::mt19937 generator(seed);
  std::vector<double> work(parent.size());
  for (double& w : work) w = std::pow(10.0, static_cast<double>(generator() % 5));
  const EliminationTree tree(parent, work);
  for (const int threads : {1, 2, 4}) {
    omp_set_num_threads(threads);
    for (const bool up : {true, false}) {
      std::vector<std::atomic<int>> met(parent.size());
      std::atomic<int> number{0};
      const auto meet = [&](int s, bool) { met[s] = ++number; };
      up ? tree.upwards(meet) : tree.downwards(meet);
      CHECK(number == count);
      bool ordered = true;
      for (size_t s = 0; s < parent.size(); ++s) {
        ordered = ordered && met[s] > 0;
        if (parent[s] >= 0) ordered = ordered && (met[s] < met[parent[s]]) == up;
      }
      CHECK(ordered);
    }
  }
  omp_set_num_threads(omp_get_num_procs());
}

TEST_CASE("only supernodes with much below them are shared") {
  // Two chains of 50 that meet in one: the upper parts of both hold more than a tenth of the work.
  std::vector<int> parent;
  for (int s = 0; s < 100; ++s) parent.push_back(s == 49 || s == 99 ? 100 : s + 1);
  parent.push_back(-1);
  const EliminationTree tree(parent, std::vector<double>(101, 1.0));
  std::vector<int> shared(101, 0);
  tree.upwards([&](int s, bool is) { shared[s] = is; });
  for (int s = 0; s < 100; ++s) CHECK(shared[s] == (s % 50 >= 10));
  CHECK(shared[100] == 1);
}
