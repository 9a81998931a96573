#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "mechanics/elimination_tree.h"
#include "mechanics/symmetric_matrix.h"

namespace bight {

/// Pattern of a Cholesky factor by supernodes: runs of columns that share their rows. Numbered in
/// a postorder of the elimination tree, so that the descendants of a supernode are those just
/// before it.
struct Supernodes {
  std::vector<int> permutation;     ///< permutation[i]: which unknown is eliminated i-th
  std::vector<int> first_column;    ///< of each supernode, and the number of columns
  std::vector<std::int64_t> begin;  ///< of the rows of each supernode in `row`, and their end
  std::vector<int> row;             ///< ascending; a supernode's own columns come first
};

/// Numerical Cholesky factorisation by the multifrontal method (Duff and Reid 1983; Liu 1992): each
/// supernode assembles a dense front of its entries and its children's updates, eliminates its
/// columns with dense kernels and hands the rest up as its own update. Independent subtrees are
/// factored side by side, the large fronts near the root by tiles. Tiles and sums do not depend on
/// the number of threads, so neither do the numbers.
///
/// CHOLMOD's own numerical phase updates a supernode by every descendant in turn: many small
/// products, 5 to 12 GFlop/s on a swept rod, one thread.
class Multifrontal {
 public:
  /// `pattern`: of the matrices to be factored.
  Multifrontal(Supernodes supernodes, const SymmetricMatrix& pattern);

  /// Factors matrix + shift * identity; false when that is not positive definite.
  bool factor(const SymmetricMatrix& matrix, double shift);

  /// Solves with the last successful factor.
  Vector solve(const Vector& right_hand_side) const;

 private:
  using Buffer = std::unique_ptr<double[]>;
  struct Pool;

  int supernodes() const { return static_cast<int>(nodes_.first_column.size()) - 1; }
  int columns(int s) const { return nodes_.first_column[s + 1] - nodes_.first_column[s]; }
  int rows(int s) const { return static_cast<int>(nodes_.begin[s + 1] - nodes_.begin[s]); }
  /// Where the rows below a supernode's columns begin, counted over all before it.
  std::int64_t part_begin(int s) const { return nodes_.begin[s] - nodes_.first_column[s]; }
  void plan_entries(const SymmetricMatrix& pattern);
  void plan_tree();
  void substitute_forward(int s, Vector& y, double* part, bool parallel) const;
  void substitute_backward(int s, Vector& y, double* part, bool parallel) const;
  void add_update(int child, int first, int last, double* to, int ld, int offset, bool parallel);
  bool eliminate(int s, const SymmetricMatrix& matrix, double shift, bool parallel);

  Supernodes nodes_;
  std::vector<int> parent_, owner_;  ///< parent supernode; supernode of a column
  std::vector<std::vector<int>> children_;
  struct Run {
    int from, to, length;  ///< rows of a child's update, adjacent in the parent's rows too
  };
  std::vector<Run> runs_;
  std::vector<std::int64_t> run_begin_;    ///< by supernode
  std::vector<std::int64_t> panel_;        ///< where each supernode's columns of L begin
  std::vector<std::int64_t> entry_begin_;  ///< by supernode
  std::vector<std::int64_t> entry_;        ///< entries of the matrix, by supernode
  std::vector<std::int64_t> entry_place_;  ///< their places in the panel
  EliminationTree tree_;
  Buffer L_;
  std::vector<Buffer> update_;  ///< of each supernode, until its parent takes it
  std::shared_ptr<Pool> pool_;
};

}  // namespace bight
