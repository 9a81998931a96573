#include "mechanics/multifrontal.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <numeric>

#include "mechanics/for_each.h"
#include "mechanics/symmetric_matrix.h"

// BLAS and LAPACK, column-major, lower triangles.
extern "C" {
void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);
void dtrsm_(const char* side, const char* uplo, const char* trans, const char* diag, const int* m,
            const int* n, const double* alpha, const double* a, const int* lda, double* b,
            const int* ldb);
void dgemm_(const char* transa, const char* transb, const int* m, const int* n, const int* k,
            const double* alpha, const double* a, const int* lda, const double* b, const int* ldb,
            const double* beta, double* c, const int* ldc);
}

namespace bight {

namespace {

/// Columns that a panel eliminates at a time; tiles of products and of solves with a panel.
constexpr int block = 32, tile = 96, tall_tile = 256;
/// Tiles of a front are shared by the threads from this many flops on.
constexpr double parallel_flops = 4e6;

constexpr double one = 1, minus_one = -1;

double front_flops(double rows, double columns) {
  const double below = rows - columns;
  return columns * columns * columns / 3 + below * columns * columns + below * below * columns;
}

inline void add(const double* from, double* to, int count) {
  for (int i = 0; i < count; ++i) to[i] += from[i];
}

/// c <- beta c - a b^T with k columns in a and b.
void subtract_product(int m, int n, int k, const double* a, const double* b, int ld, double beta,
                      double* c, int ldc) {
  dgemm_("N", "T", &m, &n, &k, &minus_one, a, &ld, b, &ld, &beta, c, &ldc);
}

/// Lower triangle of C = -A A^T, by column tiles: `a` has n rows and k columns. The upper triangles
/// of the tiles on the diagonal are overwritten: a general product is faster than a symmetric one,
/// and nobody reads them.
void subtract_square(int n, int k, const double* a, int lda, double* c, int ldc, bool parallel) {
  for_each((n + tile - 1) / tile, parallel, [&](int t) {
    const int first = t * tile;
    subtract_product(n - first, std::min(tile, n - first), k, a + first, a + first, lda, 0.0,
                     c + first + static_cast<std::int64_t>(first) * ldc, ldc);
  });
}

/// Cholesky factor of the first `columns` columns of a panel of `rows` rows.
bool factor_panel(double* panel, int rows, int columns, bool parallel) {
  for (int first = 0; first < columns; first += block) {
    const int width = std::min(block, columns - first), below = rows - first - width;
    double* diagonal = panel + first + static_cast<std::int64_t>(first) * rows;
    int info = 0;
    dpotrf_("L", &width, diagonal, &rows, &info);
    // LAPACK lets a NaN pass.
    for (int i = 0; i < width && info == 0; ++i)
      if (!(diagonal[i + static_cast<std::int64_t>(i) * rows] > 0)) info = 1;
    if (info != 0) return false;
    if (below == 0) continue;
    const int heights = (below + tall_tile - 1) / tall_tile;
    for_each(heights, parallel, [&](int t) {
      const int height = std::min(tall_tile, below - t * tall_tile);
      dtrsm_("R", "L", "T", "N", &height, &width, &one, diagonal, &rows,
             diagonal + width + t * tall_tile, &rows);
    });
    // The panel's later columns.
    const int rest = columns - first - width;
    for_each((rest + tile - 1) / tile, parallel, [&](int t) {
      const int at = t * tile;
      const double* a = diagonal + width + at;
      subtract_product(below - at, std::min(tile, rest - at), width, a, a, rows, 1.0,
                       diagonal + (width + at) * (static_cast<std::int64_t>(rows) + 1), rows);
    });
  }
  return true;
}

}  // namespace

/// Buffers of update matrices, used again and again: the first touch of fresh memory costs more
/// than the arithmetic of a small front.
struct Multifrontal::Pool {
  std::mutex mutex;
  std::multimap<std::int64_t, Buffer> free;

  Buffer take(std::int64_t size) {
    const std::lock_guard lock(mutex);
    const auto found = free.lower_bound(size);
    if (found == free.end() || found->first > 2 * size + 1024)
      return Buffer(new double[static_cast<size_t>(size)]);
    Buffer buffer = std::move(found->second);
    free.erase(found);
    return buffer;
  }
  void give_back(std::int64_t size, Buffer buffer) {
    const std::lock_guard lock(mutex);
    free.emplace(size, std::move(buffer));
  }
};

Multifrontal::Multifrontal(Supernodes supernodes, const SymmetricMatrix& pattern)
    : nodes_(std::move(supernodes)), pool_(std::make_shared<Pool>()) {
  const int count = this->supernodes();
  owner_.resize(nodes_.permutation.size());
  panel_.assign(1, 0);
  for (int s = 0; s < count; ++s) {
    std::fill(owner_.begin() + nodes_.first_column[s], owner_.begin() + nodes_.first_column[s + 1],
              s);
    panel_.push_back(panel_.back() + static_cast<std::int64_t>(rows(s)) * columns(s));
  }
  L_.reset(new double[static_cast<size_t>(panel_.back())]);
  update_.resize(static_cast<size_t>(count));
  plan_tree();
  plan_entries(pattern);
}

void Multifrontal::plan_tree() {
  const int count = supernodes();
  parent_.assign(count, -1);
  children_.resize(count);
  std::vector<double> flops(count);
  for (int s = 0; s < count; ++s) {
    flops[s] = front_flops(rows(s), columns(s));
    run_begin_.push_back(static_cast<std::int64_t>(runs_.size()));
    if (rows(s) == columns(s)) continue;
    const int* mine = nodes_.row.data() + nodes_.begin[s];
    const int p = owner_[mine[columns(s)]];
    parent_[s] = p;
    children_[p].push_back(s);
    // Both lists of rows ascend, and the parent's holds all of the child's but its columns.
    const int* theirs = nodes_.row.data() + nodes_.begin[p];
    int at = 0;
    const size_t first_run = runs_.size();
    for (int i = columns(s); i < rows(s); ++i) {
      while (theirs[at] != mine[i]) ++at;
      const int from = i - columns(s);
      if (runs_.size() > first_run && runs_.back().to + runs_.back().length == at)
        ++runs_.back().length;
      else
        runs_.push_back({from, at, 1});
    }
  }
  run_begin_.push_back(static_cast<std::int64_t>(runs_.size()));
  tree_ = EliminationTree(parent_, flops);
}

void Multifrontal::plan_entries(const SymmetricMatrix& pattern) {
  const int n = pattern.size();
  std::vector<int> position(static_cast<size_t>(n));
  for (int i = 0; i < n; ++i) position[nodes_.permutation[i]] = i;
  const auto each_entry = [&](auto&& f) {
    for (int j = 0; j < n; ++j)
      for (std::int64_t k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k) {
        const int i = pattern.row[static_cast<size_t>(k)];
        if (i < j) continue;
        const auto [column, row] = std::minmax(position[i], position[j]);
        f(k, column, row);
      }
  };
  entry_begin_.assign(static_cast<size_t>(supernodes()) + 1, 0);
  each_entry([&](std::int64_t, int column, int) { ++entry_begin_[owner_[column] + 1]; });
  std::partial_sum(entry_begin_.begin(), entry_begin_.end(), entry_begin_.begin());
  const size_t entries = static_cast<size_t>(entry_begin_.back());
  entry_.resize(entries);
  entry_place_.resize(entries);
  std::vector<int> row_of(entries), column_of(entries);
  std::vector<std::int64_t> next(entry_begin_.begin(), entry_begin_.end() - 1);
  each_entry([&](std::int64_t k, int column, int row) {
    const auto at = static_cast<size_t>(next[owner_[column]]++);
    entry_[at] = k;
    row_of[at] = row;
    column_of[at] = column;
  });
  std::vector<int> local(static_cast<size_t>(n));
  for (int s = 0; s < supernodes(); ++s) {
    for (int i = 0; i < rows(s); ++i)
      local[nodes_.row[static_cast<size_t>(nodes_.begin[s] + i)]] = i;
    for (auto at = static_cast<size_t>(entry_begin_[s]);
         at < static_cast<size_t>(entry_begin_[s + 1]); ++at)
      entry_place_[at] = local[row_of[at]] + static_cast<std::int64_t>(rows(s)) *
                                                 (column_of[at] - nodes_.first_column[s]);
  }
}

bool Multifrontal::eliminate(int s, const SymmetricMatrix& matrix, double shift, bool parallel) {
  const int height = rows(s), width = columns(s), below = height - width;
  parallel = parallel && front_flops(height, width) > parallel_flops;
  double* panel = L_.get() + panel_[s];
  std::fill(panel, L_.get() + panel_[s + 1], 0.0);
  for (std::int64_t e = entry_begin_[s]; e < entry_begin_[s + 1]; ++e)
    panel[entry_place_[static_cast<size_t>(e)]] += matrix.value[static_cast<size_t>(entry_[e])];
  if (shift != 0)
    for (int j = 0; j < width; ++j) panel[j + static_cast<std::int64_t>(j) * height] += shift;

  // Of a child's update, the columns that are eliminated here come before, the others after the
  // product that overwrites this front's own update.
  for (const int child : children_[s]) add_update(child, 0, width, panel, height, 0, parallel);
  if (!factor_panel(panel, height, width, parallel)) return false;
  if (below > 0) {
    update_[s] = pool_->take(static_cast<std::int64_t>(below) * below);
    subtract_square(below, width, panel + width, height, update_[s].get(), below, parallel);
  }
  for (const int child : children_[s]) {
    const std::int64_t m = rows(child) - columns(child);
    if (below > 0) add_update(child, width, height, update_[s].get(), below, width, parallel);
    pool_->give_back(m * m, std::move(update_[child]));
  }
  return true;
}

/// Adds the columns [first, last) of the parent's front from a child's update to `to`, whose first
/// row and column are those with number `offset` of the front.
void Multifrontal::add_update(int child, int first, int last, double* to, int ld, int offset,
                              bool parallel) {
  const int m = rows(child) - columns(child);
  const Run* runs = runs_.data() + run_begin_[child];
  const int count = static_cast<int>(run_begin_[child + 1] - run_begin_[child]);
  const double* from = update_[child].get();
  for_each(count, parallel, [&](int r) {
    for (int k = std::max(0, first - runs[r].to); k < std::min(runs[r].length, last - runs[r].to);
         ++k) {
      const int column = runs[r].to + k;
      const double* source = from + static_cast<std::int64_t>(runs[r].from + k) * m;
      double* target = to + static_cast<std::int64_t>(column - offset) * ld - offset;
      add(source + runs[r].from + k, target + column, runs[r].length - k);
      for (int q = r + 1; q < count; ++q)
        add(source + runs[q].from, target + runs[q].to, runs[q].length);
    }
  });
}

bool Multifrontal::factor(const SymmetricMatrix& matrix, double shift) {
  std::atomic<bool> positive{true};
  // Inside a parallel region BLAS stays on its caller's thread.
  tree_.upwards([&](int s, bool shared) {
    if (positive && !eliminate(s, matrix, shift, shared)) positive = false;
  });
  if (!positive)
    for (int s = 0; s < supernodes(); ++s) update_[s].reset();
  return positive;
}

}  // namespace bight
