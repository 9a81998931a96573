// Triangular solves with the factor of mechanics/multifrontal.cpp: up the tree, each supernode
// takes over what its children leave to it, then down again. Subtrees side by side, large panels by
// tiles.

#include <algorithm>

#include "mechanics/for_each.h"
#include "mechanics/multifrontal.h"

// BLAS, column-major.
extern "C" {
void dtrsv_(const char* uplo, const char* trans, const char* diag, const int* n, const double* a,
            const int* lda, double* x, const int* incx);
void dgemv_(const char* trans, const int* m, const int* n, const double* alpha, const double* a,
            const int* lda, const double* x, const int* incx, const double* beta, double* y,
            const int* incy);
}

namespace bight {

namespace {

constexpr int row_tile = 512, column_tile = 96;
constexpr double one = 1, minus_one = -1;
constexpr int unit_stride = 1;

}  // namespace

/// y <- L^-1 y for the columns of a supernode, from the `part` of its children: what their columns
/// take from the rows below.
void Multifrontal::substitute_forward(int s, Vector& y, double* part, bool parallel) const {
  const int height = rows(s), width = columns(s), below = height - width;
  const double* panel = L_.get() + panel_[s];
  double* own = y.data() + nodes_.first_column[s];
  double* rest = part + part_begin(s);
  std::fill(rest, rest + below, 0.0);
  for (const int child : children_[s]) {
    const double* from = part + part_begin(child);
    for (std::int64_t r = run_begin_[child]; r < run_begin_[child + 1]; ++r)
      for (int k = 0; k < runs_[r].length; ++k) {
        const int to = runs_[r].to + k;
        if (to < width)
          own[to] -= from[runs_[r].from + k];
        else
          rest[to - width] += from[runs_[r].from + k];
      }
  }
  dtrsv_("L", "N", "N", &width, panel, &height, own, &unit_stride);
  for_each((below + row_tile - 1) / row_tile, parallel, [&](int t) {
    const int first = t * row_tile, count = std::min(row_tile, below - first);
    dgemv_("N", &count, &width, &one, panel + width + first, &height, own, &unit_stride, &one,
           rest + first, &unit_stride);
  });
}

/// y <- L^-T y for the columns of a supernode.
void Multifrontal::substitute_backward(int s, Vector& y, double* part, bool parallel) const {
  const int height = rows(s), width = columns(s), below = height - width;
  const double* panel = L_.get() + panel_[s];
  double* own = y.data() + nodes_.first_column[s];
  double* rest = part + part_begin(s);
  const int* row = nodes_.row.data() + nodes_.begin[s] + width;
  for (int i = 0; i < below; ++i) rest[i] = y[row[i]];
  if (below > 0)
    for_each((width + column_tile - 1) / column_tile, parallel, [&](int t) {
      const int first = t * column_tile, count = std::min(column_tile, width - first);
      dgemv_("T", &below, &count, &minus_one, panel + width + std::int64_t{height} * first, &height,
             rest, &unit_stride, &one, own + first, &unit_stride);
    });
  dtrsv_("L", "T", "N", &width, panel, &height, own, &unit_stride);
}

Vector Multifrontal::solve(const Vector& right_hand_side) const {
  const int n = static_cast<int>(nodes_.permutation.size());
  Vector y(n);
  for (int i = 0; i < n; ++i) y[i] = right_hand_side[nodes_.permutation[i]];
  const Buffer part(new double[static_cast<size_t>(part_begin(supernodes()))]);
  tree_.upwards([&](int s, bool shared) { substitute_forward(s, y, part.get(), shared); });
  tree_.downwards([&](int s, bool shared) { substitute_backward(s, y, part.get(), shared); });
  Vector x(n);
  for (int i = 0; i < n; ++i) x[nodes_.permutation[i]] = y[i];
  return x;
}

}  // namespace bight
