#include "mechanics/symmetric_matrix.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

using namespace bight;

TEST_CASE("a symmetric matrix multiplies from its lower triangle, whatever is above it") {
  const Eigen::Matrix3d dense{{4, -1, 2}, {-1, 5, 0}, {2, 0, 6}};
  // The entry (0, 1) is there and wrong: it is to be ignored.
  const SymmetricMatrix m{{0, 3, 5, 6}, {0, 1, 2, 0, 1, 2}, {4, -1, 2, 77, 5, 6}};
  const Vector u = Eigen::Vector3d(1, -2, 0.5);
  CHECK((m.times(u) - dense * u).norm() < 1e-15);
  for (int j = 0; j < 3; ++j) CHECK(m.value[m.diagonal(j)] == dense(j, j));
}
