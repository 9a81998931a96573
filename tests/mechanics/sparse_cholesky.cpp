#include "mechanics/sparse_cholesky.h"

#include <omp.h>

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <random>

using namespace bight;

namespace {

/// Lower triangle of a dense matrix, with explicit zeros left out.
SymmetricMatrix lower(const Eigen::MatrixXd& dense) {
  SymmetricMatrix m;
  m.column_start = {0};
  for (int j = 0; j < dense.cols(); ++j) {
    for (int i = j; i < dense.rows(); ++i)
      if (dense(i, j) != 0 || i == j) m.row.push_back(i), m.value.push_back(dense(i, j));
    m.column_start.push_back(static_cast<int>(m.row.size()));
  }
  return m;
}

/// Banded, with smallest eigenvalue above `floor`.
Eigen::MatrixXd banded(int n, double floor) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = std::max(0, i - 3); j <= i; ++j) m(i, j) = m(j, i) = uniform(generator);
  const double lowest = m.selfadjointView<Eigen::Lower>().eigenvalues()[0];
  return m + (floor - lowest) * Eigen::MatrixXd::Identity(n, n);
}

}  // namespace

TEST_CASE("solves as a dense factorisation does, in any order") {
  const auto ordering = GENERATE(Ordering::natural, Ordering::dissection);
  const Eigen::MatrixXd dense = banded(200, 0.1);
  const Vector b = Vector::LinSpaced(200, -1, 2);
  SparseCholesky cholesky;
  cholesky.analyse(lower(dense), ordering);
  REQUIRE(cholesky.factor(lower(dense)));
  CHECK((dense * cholesky.solve(b) - b).norm() < 1e-11 * b.norm());
  REQUIRE(cholesky.factor(lower(dense), 2.5));
  const Vector x = cholesky.solve(b);
  CHECK((dense * x + 2.5 * x - b).norm() < 1e-11 * b.norm());
  CHECK(cholesky.factor_entries() > 200);
}

TEST_CASE("a matrix that is not positive definite is an answer, and a shift cures it") {
  const auto ordering = GENERATE(Ordering::natural, Ordering::dissection);
  const Eigen::MatrixXd dense = banded(200, -0.05);
  SparseCholesky cholesky;
  cholesky.analyse(lower(dense), ordering);
  CHECK_FALSE(cholesky.factor(lower(dense)));
  CHECK_FALSE(cholesky.factor(lower(dense), 0.049));
  REQUIRE(cholesky.factor(lower(dense), 0.051));
  CHECK(cholesky.solve(Vector::Ones(200)).allFinite());
  CHECK_FALSE(cholesky.factor(lower(dense)));
}

TEST_CASE("a matrix with a NaN is not positive definite") {
  Eigen::MatrixXd dense = banded(50, 0.1);
  dense(20, 20) = std::nan("");
  SparseCholesky cholesky;
  cholesky.analyse(lower(banded(50, 0.1)), Ordering::natural);
  CHECK_FALSE(cholesky.factor(lower(dense)));
}

namespace {

/// Laplacian on a cubic grid of n^3 points with three coupled unknowns each, plus `floor`: large
/// enough for supernodes, with fronts of several tiles.
SymmetricMatrix grid(int n, double floor) {
  const auto point = [n](int i, int j, int k) { return (i * n + j) * n + k; };
  SymmetricMatrix m;
  m.column_start = {0};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        for (int c = 0; c < 3; ++c) {
          const auto put = [&](int other, double diagonal, double coupled) {
            for (int d = 0; d < 3; ++d) {
              m.row.push_back(3 * other + d);
              m.value.push_back(d == c ? diagonal : coupled);
            }
          };
          put(point(i, j, k), 6 + floor + 0.2, 0.1);
          if (k + 1 < n) put(point(i, j, k + 1), -1, 0);
          if (j + 1 < n) put(point(i, j + 1, k), -1, 0);
          if (i + 1 < n) put(point(i + 1, j, k), -1, 0);
          m.column_start.push_back(static_cast<int>(m.row.size()));
        }
  return m;
}

Vector product(const SymmetricMatrix& m, const Vector& x) {
  Vector y = Vector::Zero(x.size());
  for (int j = 0; j < m.size(); ++j)
    for (int at = m.column_start[j]; at < m.column_start[j + 1]; ++at) {
      const int i = m.row[at];
      if (i < j) continue;  // above the diagonal: ignored
      y[i] += m.value[at] * x[j];
      if (i > j) y[j] += m.value[at] * x[i];
    }
  return y;
}

}  // namespace

TEST_CASE("a large matrix is solved to round-off, the same on one thread and on two") {
  const SymmetricMatrix m = grid(14, 0);
  Vector b(m.size());
  for (int i = 0; i < b.size(); ++i) b[i] = std::sin(1.0 + i);
  Vector x[2];
  for (const int k : {0, 1}) {
    omp_set_num_threads(k + 1);
    SparseCholesky cholesky;
    cholesky.analyse(m, Ordering::dissection);
    REQUIRE(cholesky.factor(m, 1.0));
    REQUIRE(cholesky.factor(m));
    x[k] = cholesky.solve(b);
    CHECK((product(m, x[k]) - b).norm() < 1e-12 * b.norm());
  }
  omp_set_num_threads(omp_get_num_procs());
  CHECK((x[0] - x[1]).norm() == 0);
}

TEST_CASE("a large matrix that is not positive definite is an answer, too") {
  // The least eigenvalue of the grid: 6 - 6 cos(pi/(n + 1)) + 0.1 for the couplings.
  const double least = 6 - 6 * std::cos(M_PI / 15) + 0.1;
  const SymmetricMatrix m = grid(14, -least - 1e-3);
  SparseCholesky cholesky;
  cholesky.analyse(m, Ordering::dissection);
  CHECK_FALSE(cholesky.factor(m));
  CHECK_FALSE(cholesky.factor(m, 0.9e-3));
  REQUIRE(cholesky.factor(m, 1.1e-3));
  CHECK_FALSE(cholesky.factor(m));
  SymmetricMatrix broken = grid(14, 0);
  broken.value[broken.column_start[3000]] = std::nan("");  // on the diagonal
  CHECK_FALSE(cholesky.factor(broken));
}
