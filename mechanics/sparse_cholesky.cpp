#include "mechanics/sparse_cholesky.h"

#include <cholmod.h>
#include <omp.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>

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

/// Runs f with every OpenMP loop inside it on one thread. CHOLMOD asks for four threads per
/// supernode, whatever the machine has, and OpenBLAS follows; on two cores their barriers cost 1.5
/// to 20 times the factorisation itself. Without active levels every region is serial.
template <class F>
void on_one_thread(F&& f) {
  const int threads = omp_get_max_threads(), levels = omp_get_max_active_levels();
  omp_set_num_threads(1);
  omp_set_max_active_levels(0);
  f();
  omp_set_max_active_levels(levels);
  omp_set_num_threads(threads);
}

}  // namespace

struct SparseCholesky::Package {
  cholmod_common common;
  cholmod_factor* factor = nullptr;
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
  package_->factor = cholmod_analyze(&a, &common);
  if (!package_->factor) throw std::runtime_error("sparse Cholesky: the symbolic analysis failed");
  package_->flops = common.fl;
  package_->entries = static_cast<std::size_t>(common.lnz);
}

bool SparseCholesky::factor(const SymmetricMatrix& matrix, double shift) {
  assert(package_->factor);
  cholmod_common& common = package_->common;
  cholmod_sparse a = view(matrix);
  double beta[2] = {shift, 0};
  on_one_thread([&] { cholmod_factorize_p(&a, beta, nullptr, 0, package_->factor, &common); });
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
  cholmod_dense b{};
  b.nrow = b.d = static_cast<size_t>(right_hand_side.size());
  b.ncol = 1;
  b.nzmax = b.nrow;
  b.x = const_cast<double*>(right_hand_side.data());
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  on_one_thread([&] {
    cholmod_solve2(CHOLMOD_A, package_->factor, &b, nullptr, &package_->solution, nullptr,
                   &package_->work_y, &package_->work_e, &package_->common);
  });
  return Eigen::Map<const Vector>(static_cast<const double*>(package_->solution->x),
                                  right_hand_side.size());
}

std::size_t SparseCholesky::factor_entries() const { return package_->entries; }
double SparseCholesky::factor_flops() const { return package_->flops; }
std::size_t SparseCholesky::peak_bytes() const { return package_->common.memory_usage; }

}  // namespace bight
