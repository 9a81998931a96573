#include "mechanics/sparse_cholesky.h"

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
