#include "mechanics/sparse_cholesky.h"

#include <cholmod.h>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>

#include "mechanics/arms.h"
#include "mechanics/multifrontal.h"

namespace bight {

namespace {

int kind(Ordering ordering) {
  switch (ordering) {
    case Ordering::natural:
      return CHOLMOD_NATURAL;
    case Ordering::minimum_degree:
      return CHOLMOD_AMD;
    case Ordering::dissection:
      break;
  }
  return CHOLMOD_METIS;
}

/// CHOLMOD's view of a matrix; it does not write to what it is shown.
cholmod_sparse view(const SymmetricMatrix& matrix) {
  cholmod_sparse a{};
  a.nrow = a.ncol = static_cast<size_t>(matrix.size());
  a.nzmax = matrix.row.size();
  a.p = const_cast<int*>(matrix.column_start.data());
  a.i = const_cast<int*>(matrix.row.data());
  a.x = const_cast<double*>(matrix.value.data());
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = 1;
  a.packed = 1;
  return a;
}

/// First columns of runs of columns with the same rows (the unknowns of a node), and their end.
std::vector<int> blocks_of(const SymmetricMatrix& m) {
  std::vector<int> first;
  for (int j = 0; j < m.size(); ++j) {
    const auto rows = [&](int column) {
      return std::span(m.row).subspan(
          static_cast<size_t>(m.column_start[column]),
          static_cast<size_t>(m.column_start[column + 1] - m.column_start[column]));
    };
    if (j == 0 || !std::ranges::equal(rows(j - 1), rows(j))) first.push_back(j);
  }
  first.push_back(m.size());
  return first;
}

/// The graph of blocks of unknowns: a ninth of the entries, and a node stays together.
Graph graph_of(const SymmetricMatrix& m, const std::vector<int>& first) {
  const int blocks = static_cast<int>(first.size()) - 1;
  std::vector<int> block(static_cast<size_t>(m.size()));
  for (int b = 0; b < blocks; ++b)
    std::fill(block.begin() + first[b], block.begin() + first[b + 1], b);
  std::vector<std::pair<int, int>> edges;
  std::vector<int> degree(static_cast<size_t>(blocks), 0);
  for (int b = 0; b < blocks; ++b) {
    int last = b;
    for (int k = m.column_start[first[b]]; k < m.column_start[first[b] + 1]; ++k) {
      const int row = block[m.row[k]];
      if (row <= last) continue;
      edges.emplace_back(b, last = row);
      ++degree[b], ++degree[row];
    }
  }
  Graph graph;
  for (int b = 0; b < blocks; ++b) graph.begin.push_back(graph.begin.back() + degree[b]);
  graph.neighbour.resize(2 * edges.size());
  std::vector<int> next(graph.begin.begin(), graph.begin.end() - 1);
  for (const auto& [a, b] : edges) graph.neighbour[next[a]++] = b, graph.neighbour[next[b]++] = a;
  return graph;
}

/// Nested dissection of a part of a graph.
std::vector<int> dissection(const Graph& graph, const std::vector<int>& part,
                            cholmod_common& common) {
  std::vector<int> place(static_cast<size_t>(graph.size()), -1);
  for (size_t i = 0; i < part.size(); ++i) place[part[i]] = static_cast<int>(i);
  SymmetricMatrix lower;
  lower.column_start = {0};
  for (const int v : part) {
    for (int k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
      if (const int row = place[graph.neighbour[k]]; row > place[v]) lower.row.push_back(row);
    lower.column_start.push_back(static_cast<int>(lower.row.size()));
  }
  lower.value.assign(lower.row.size(), 1.0);
  std::vector<int> order(part.size());
  cholmod_sparse a = view(lower);
  a.sorted = 0;
  if (!cholmod_metis(&a, nullptr, 0, true, order.data(), &common))
    std::iota(order.begin(), order.end(), 0);
  for (int& v : order) v = part[v];
  return order;
}

/// Arms from their ends, what they hang on by nested dissection.
std::vector<int> swept_order(const SymmetricMatrix& m, cholmod_common& common) {
  const std::vector<int> first = blocks_of(m);
  const Graph graph = graph_of(m, first);
  const Arms arms = find_arms(graph);
  std::vector<int> permutation;
  for (const std::vector<int>& part : {arms.first, dissection(graph, arms.rest, common), arms.last})
    for (const int b : part)
      for (int i = first[b]; i < first[b + 1]; ++i) permutation.push_back(i);
  return permutation;
}

Supernodes supernodes_of(const cholmod_factor& factor) {
  const auto* order = static_cast<const int*>(factor.Perm);
  const auto* first = static_cast<const int*>(factor.super);
  const auto* begin = static_cast<const int*>(factor.pi);
  const auto* row = static_cast<const int*>(factor.s);
  const size_t count = factor.nsuper;
  return {{order, order + factor.n},
          {first, first + count + 1},
          {begin, begin + count + 1},
          {row, row + begin[count]}};
}

}  // namespace

struct SparseCholesky::Package {
  cholmod_common common;
  cholmod_factor* factor = nullptr;
  /// Where supernodes pay: the numerical phase, in the place of CHOLMOD's own.
  std::optional<Multifrontal> multifrontal;
  cholmod_dense* solution = nullptr;
  cholmod_dense *work_y = nullptr, *work_e = nullptr;
  double flops = 0;
  std::size_t entries = 0;

  Package() {
    cholmod_start(&common);
    common.print = 0;
    common.nmethods = 1;
    common.postorder = 1;
    common.quick_return_if_not_posdef = 1;
    common.supernodal = CHOLMOD_AUTO;
  }
  ~Package() {
    cholmod_free_dense(&solution, &common);
    cholmod_free_dense(&work_y, &common);
    cholmod_free_dense(&work_e, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
};

SparseCholesky::SparseCholesky() : package_(std::make_unique<Package>()) {}
SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

void SparseCholesky::analyse(const SymmetricMatrix& matrix, Ordering ordering) {
  cholmod_common& common = package_->common;
  common.method[0].ordering = kind(ordering);
  cholmod_free_factor(&package_->factor, &common);
  cholmod_sparse a = view(matrix);
  if (ordering == Ordering::dissection) {
    std::vector<int> permutation = swept_order(matrix, common);
    common.method[0].ordering = CHOLMOD_GIVEN;
    package_->factor = cholmod_analyze_p(&a, permutation.data(), nullptr, 0, &common);
  } else {
    package_->factor = cholmod_analyze(&a, &common);
  }
  if (!package_->factor) throw std::runtime_error("sparse Cholesky: the symbolic analysis failed");
  package_->flops = common.fl;
  package_->entries = static_cast<std::size_t>(common.lnz);
  package_->multifrontal.reset();
  if (package_->factor->is_super)
    package_->multifrontal.emplace(supernodes_of(*package_->factor), matrix);
}

bool SparseCholesky::factor(const SymmetricMatrix& matrix, double shift) {
  assert(package_->factor);
  if (package_->multifrontal) return package_->multifrontal->factor(matrix, shift);
  cholmod_common& common = package_->common;
  cholmod_sparse a = view(matrix);
  double beta[2] = {shift, 0};
  cholmod_factorize_p(&a, beta, nullptr, 0, package_->factor, &common);
  if (common.status == CHOLMOD_OUT_OF_MEMORY)
    throw std::runtime_error("sparse Cholesky: out of memory");
  if (common.status != CHOLMOD_OK || package_->factor->minor < a.nrow) return false;
  if (package_->factor->is_ll) return true;
  // A simplicial LDL' factor exists for an indefinite matrix too: D tells.
  const auto* start = static_cast<const int*>(package_->factor->p);
  const auto* value = static_cast<const double*>(package_->factor->x);
  for (size_t j = 0; j < a.ncol; ++j)
    if (!(value[start[j]] > 0)) return false;
  return true;
}

Vector SparseCholesky::solve(const Vector& right_hand_side) const {
  if (package_->multifrontal) return package_->multifrontal->solve(right_hand_side);
  cholmod_dense b{};
  b.nrow = b.d = static_cast<size_t>(right_hand_side.size());
  b.ncol = 1;
  b.nzmax = b.nrow;
  b.x = const_cast<double*>(right_hand_side.data());
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  cholmod_solve2(CHOLMOD_A, package_->factor, &b, nullptr, &package_->solution, nullptr,
                 &package_->work_y, &package_->work_e, &package_->common);
  return Eigen::Map<const Vector>(static_cast<const double*>(package_->solution->x),
                                  right_hand_side.size());
}

std::size_t SparseCholesky::factor_entries() const { return package_->entries; }
double SparseCholesky::factor_flops() const { return package_->flops; }

}  // namespace bight
