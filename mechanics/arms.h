#pragma once

#include <vector>

namespace bight {

/// Undirected graph by compressed lists of neighbours.
struct Graph {
  std::vector<int> begin{0};  ///< of each vertex in `neighbour`, and the end
  std::vector<int> neighbour;
  int size() const { return static_cast<int>(begin.size()) - 1; }
};

/// The long thin parts of a graph that hang on the rest by one end, as the tails of a knotted rod
/// do, and its loop where symmetry cuts it. An arm is best eliminated section by section from its
/// free end: a section of b unknowns costs 7/3 b^3, since all that is left of the arm is the next
/// section. Inside a nested dissection, between two separators, it costs 19/3 b^3.
struct Arms {
  std::vector<int> first;  ///< vertices to be eliminated first, in this order
  std::vector<int> rest;   ///< then these, in an order still to be found
  /// Then these: the inner sections of the longest arm, from the rest outwards. So about half of
  /// the work is done on either side of the section that is eliminated last.
  std::vector<int> last;
};

Arms find_arms(const Graph& graph);

}  // namespace bight
