#include "core/math/cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "core/base/random.h"

namespace capstan::math {
namespace {

using Matrix = Eigen::Matrix<double, 5, 5>;
using Vector = Eigen::Matrix<double, 5, 1>;

Vector randomVector(base::Random& random, double scale) {
  return Vector::NullaryExpr([&] { return random.normal(0.0, scale); });
}

Matrix randomLower(base::Random& random, double scale) {
  Matrix l = Matrix::Zero();
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j <= i; ++j) l(i, j) = random.normal(0.0, scale);
  l.diagonal() = l.diagonal().cwiseAbs() + Vector::Constant(0.1 * scale);
  return l;
}

bool isLowerFactor(const Matrix& l) { return l.isLowerTriangular() && (l.diagonal().array() >= 0.0).all(); }

class CholeskyLaws : public testing::TestWithParam<double> {};

TEST_P(CholeskyLaws, UpdateIsTheFactorOfTheSum) {
  base::Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    Matrix l = randomLower(random, GetParam());
    const Vector x = randomVector(random, GetParam());
    const Matrix sum = l * l.transpose() + x * x.transpose();
    rankOneUpdate(l, x);
    EXPECT_TRUE(isLowerFactor(l));
    EXPECT_LT((l * l.transpose() - sum).norm(), 1e-14 * sum.norm());
    EXPECT_LT((l - Matrix(sum.llt().matrixL())).norm(), 1e-9 * l.norm());
  }
}

TEST_P(CholeskyLaws, DowndateUndoesUpdate) {
  base::Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Matrix before = randomLower(random, GetParam());
    const Vector x = randomVector(random, GetParam());
    Matrix l = before;
    rankOneUpdate(l, x);
    ASSERT_TRUE(rankOneDowndate(l, x));
    EXPECT_TRUE(isLowerFactor(l));
    EXPECT_LT((l - before).norm(), 1e-8 * before.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Scales, CholeskyLaws, testing::Values(1e-9, 1.0, 1e9));

TEST(Cholesky, UpdateOfZeroByZeroIsZero) {
  Matrix l = Matrix::Zero();
  rankOneUpdate(l, Vector(Vector::Zero()));
  EXPECT_EQ(l, Matrix::Zero());
  rankOneUpdate(l, Vector(Vector::Unit(2)));
  EXPECT_EQ(l * l.transpose(), Vector::Unit(2) * Vector::Unit(2).transpose());
}

TEST(Cholesky, DowndateRefusesAndLeavesTheFactor) {
  base::Random random(3);
  const Matrix before = randomLower(random, 1.0);
  for (const double factor : {1.0, 1.0 + 1e-12, 2.0, 1e200, std::numeric_limits<double>::quiet_NaN()}) {
    Matrix l = before;
    EXPECT_FALSE(rankOneDowndate(l, Vector(factor * before.col(0)))) << factor;
    EXPECT_EQ(l, before);
  }
  Matrix singular = before;
  singular(0, 0) = 0.0;
  EXPECT_FALSE(rankOneDowndate(singular, Vector(Vector::Ones())));
}

}  // namespace
}  // namespace capstan::math
