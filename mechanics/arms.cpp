#include "mechanics/arms.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace bight {

namespace {

/// An arm ends where its sections become larger than the usual one by this factor.
constexpr double widest = 1.2;
/// Length of an arm in sections over the square root of a section: shorter bodies are no arms.
constexpr double least_slenderness = 4;
/// Work on the rest over that on as many vertices of an arm, about.
constexpr double work_of_rest = 2.5;

using Levels = std::vector<std::vector<int>>;

/// What is left of a graph while its arms are taken off.
class Remains {
 public:
  explicit Remains(const Graph& graph)
      : graph_(graph), seen_(static_cast<size_t>(graph.size()), 0) {}

  /// The vertices that can be reached from `sources`, by their distance.
  Levels levels(std::vector<int> sources) {
    ++sweep_;
    for (const int v : sources) seen_[v] = sweep_;
    Levels all{std::move(sources)};
    for (;;) {
      std::vector<int> next;
      for (const int v : all.back())
        for (int k = graph_.begin[v]; k < graph_.begin[v + 1]; ++k) {
          const int w = graph_.neighbour[k];
          if (seen_[w] == taken || seen_[w] == sweep_) continue;
          seen_[w] = sweep_;
          next.push_back(w);
        }
      if (next.empty()) return all;
      all.push_back(std::move(next));
    }
  }
  void take(const std::vector<int>& vertices) {
    for (const int v : vertices) seen_[v] = taken;
  }
  bool has(int vertex) const { return seen_[vertex] != taken; }

 private:
  static constexpr int taken = -1;
  const Graph& graph_;
  std::vector<int> seen_;  ///< the last sweep that has met a vertex
  int sweep_ = 0;
};

/// The size that most levels have.
double usual_size(const Levels& levels) {
  std::map<size_t, int> count;
  for (const auto& level : levels) ++count[level.size()];
  const auto most = std::ranges::max_element(count, {}, [](const auto& c) { return c.second; });
  return static_cast<double>(most->first);
}

/// The levels that are an arm with sections of that size: those before the last narrow one. Empty
/// where they are too few.
Levels arm_of(Levels levels, double size) {
  const auto end = std::ranges::find_if(
      levels, [&](const auto& level) { return static_cast<double>(level.size()) > widest * size; });
  // What is eliminated of the last level is coupled with all of the next one: that one stays.
  levels.erase(end == levels.begin() ? end : end - 1, levels.end());
  if (static_cast<double>(levels.size()) < least_slenderness * std::sqrt(size)) levels.clear();
  return levels;
}

void append(std::vector<int>& list, const std::vector<int>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

/// The arms of the part of a graph that one vertex is in, one after another.
std::vector<Levels> arms_of_part(const Graph& graph, Remains& remains, const Levels& sweep) {
  std::vector<Levels> arms;
  // Swept from the middle of a loop, levels are two sections.
  const double size = std::min(usual_size(sweep), usual_size(remains.levels(sweep.back())));
  std::vector<int> from = sweep.front();
  for (;;) {
    // What is farthest is the end of an arm, if there is one.
    Levels arm = arm_of(remains.levels(remains.levels(std::move(from)).back()), size);
    if (arm.empty()) return arms;
    for (const auto& level : arm) remains.take(level);
    from.clear();
    for (const int v : arm.back())
      for (int k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
        if (remains.has(graph.neighbour[k])) from.push_back(graph.neighbour[k]);
    std::ranges::sort(from);
    from.erase(std::ranges::unique(from).begin(), from.end());
    arms.push_back(std::move(arm));
  }
}

int vertices(const Levels& levels) {
  int sum = 0;
  for (const auto& level : levels) sum += static_cast<int>(level.size());
  return sum;
}

}  // namespace

Arms find_arms(const Graph& graph) {
  Remains remains(graph);
  std::vector<Levels> arms;
  std::vector<bool> met(static_cast<size_t>(graph.size()), false);
  for (int v = 0; v < graph.size(); ++v) {
    if (met[v]) continue;
    const Levels sweep = remains.levels({v});
    for (const auto& level : sweep)
      for (const int w : level) met[w] = true;
    for (Levels& arm : arms_of_part(graph, remains, sweep)) arms.push_back(std::move(arm));
  }

  Arms result;
  for (int v = 0; v < graph.size(); ++v)
    if (remains.has(v)) result.rest.push_back(v);
  if (arms.empty()) return result;
  std::ranges::stable_sort(arms, std::greater(), vertices);
  Levels& longest = arms.front();
  double others = work_of_rest * static_cast<double>(result.rest.size());
  for (size_t i = 1; i < arms.size(); ++i) others += vertices(arms[i]);
  double more = 0.5 * (vertices(longest) - others);
  while (more > 0 && longest.size() > 1) {
    more -= static_cast<double>(longest.back().size());
    append(result.last, longest.back());
    longest.pop_back();
  }
  for (const Levels& arm : arms)
    for (const auto& level : arm) append(result.first, level);
  return result;
}

}  // namespace bight
