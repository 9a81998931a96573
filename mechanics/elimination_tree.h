#pragma once

#include <atomic>
#include <vector>

namespace bight {

/// Which supernode waits for which others, and how threads walk through them: what does not depend
/// on each other side by side, and near the root, where nothing is left side by side, idle threads
/// help with the work on one supernode. Numbered in a postorder.
class EliminationTree {
 public:
  EliminationTree() = default;
  /// parent: of each supernode, -1 for a root; work: of each, in any unit.
  EliminationTree(const std::vector<int>& parent, const std::vector<double>& work);

  /// Calls f(supernode, shared) for every supernode, for children before their parents. `shared`:
  /// idle threads can help.
  template <class F>
  void upwards(const F& f) const {
    std::vector<std::atomic<int>> waits_for(parts_.size());
    for (size_t p = 0; p < parts_.size(); ++p)
      waits_for[p] = static_cast<int>(parts_[p].below.size());
    // Whoever is the last to finish below a part goes on with it: nobody waits.
    const auto climb = [&](int p) {
      do {
        for (const int s : parts_[p].supernodes) f(s, parts_[p].shared);
        p = parts_[p].above;
      } while (p >= 0 && --waits_for[p] == 0);
    };
#pragma omp parallel
#pragma omp single
    for (const int leaf : leaves_) {
#pragma omp task firstprivate(leaf)
      climb(leaf);
    }
  }

  /// The same, for parents before their children.
  template <class F>
  void downwards(const F& f) const {
#pragma omp parallel
#pragma omp single
    for (const int root : roots_) descend(root, f);
  }

 private:
  /// A subtree for one thread, or supernodes one above the other, each for all threads.
  struct Part {
    std::vector<int> supernodes;  ///< children first
    bool shared = false;
    int above = -1;          ///< the part that waits for this one
    std::vector<int> below;  ///< those that this one waits for
  };

  template <class F>
  void descend(int p, const F& f) const {
    const Part& part = parts_[p];
    for (auto s = part.supernodes.rbegin(); s != part.supernodes.rend(); ++s) f(*s, part.shared);
    for (const int below : part.below) {
#pragma omp task firstprivate(below)
      descend(below, f);
    }
  }

  std::vector<Part> parts_;
  std::vector<int> leaves_, roots_;  ///< by work, most first
};

}  // namespace bight
