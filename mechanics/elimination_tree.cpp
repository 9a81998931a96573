#include "mechanics/elimination_tree.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace bight {

namespace {

/// Share of all work that a subtree may have to be left to one thread.
constexpr double subtree_share = 0.1;

}  // namespace

EliminationTree::EliminationTree(const std::vector<int>& parent, const std::vector<double>& work) {
  const size_t count = parent.size();
  std::vector<double> total = work;  // with all descendants
  for (size_t s = 0; s < count; ++s)
    if (parent[s] >= 0) total[parent[s]] += total[s];
  const double most = subtree_share * std::accumulate(work.begin(), work.end(), 0.0);
  const auto large = [&](int s) { return total[s] > most; };
  std::vector<int> large_children(count, 0);
  for (size_t s = 0; s < count; ++s)
    if (parent[s] >= 0) large_children[parent[s]] += large(static_cast<int>(s));

  // From the root down, a supernode belongs to the part of its parent where both are small, or
  // where it is the parent's only large child.
  std::vector<int> part(count);
  std::vector<double> work_of;
  for (int s = static_cast<int>(count) - 1; s >= 0; --s) {
    const int p = parent[s];
    const bool joins = p >= 0 && (!large(p) || (large(s) && large_children[p] == 1));
    if (joins) {
      part[s] = part[p];
    } else {
      part[s] = static_cast<int>(parts_.size());
      Part& next = parts_.emplace_back();
      next.shared = large(s);
      if (p >= 0) next.above = part[p];
      work_of.push_back(total[s]);
    }
    parts_[part[s]].supernodes.push_back(s);
  }
  for (int p = 0; p < static_cast<int>(parts_.size()); ++p) {
    std::ranges::reverse(parts_[p].supernodes);
    if (parts_[p].above < 0)
      roots_.push_back(p);
    else
      parts_[parts_[p].above].below.push_back(p);
  }
  for (int p = 0; p < static_cast<int>(parts_.size()); ++p)
    if (parts_[p].below.empty()) leaves_.push_back(p);
  const auto by_work = [&](int p) { return work_of[p]; };
  for (std::vector<int>* list : {&leaves_, &roots_})
    std::ranges::stable_sort(*list, std::greater(), by_work);
}

}  // namespace bight
