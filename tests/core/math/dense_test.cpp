// Beside Eigen's own.
#include "core/math/dense.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cstdlib>
#include <limits>

#include "core/math/blas_kernels.h"
#include "core/math/instruction_set.h"

namespace capstan::math {
namespace {

Eigen::MatrixXd positiveDefinite(Eigen::Index n) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(n, n);
  return a * a.transpose() + Eigen::MatrixXd::Identity(n, n);
}

TEST(Dense, usesTheProcessorsInstructions) {
  if (!isAvailable(InstructionSet::kAvx2) || std::getenv("OPENBLAS_CORETYPE")) GTEST_SKIP();
  EXPECT_NE(blasKernels(), "Prescott") << "SSE3, of 2004";
}

TEST(Dense, factorisesAndInverts) {
  for (const Eigen::Index n : {1, 2, 7, 130}) {
    const Eigen::MatrixXd a = positiveDefinite(n);
    Eigen::MatrixXd l = a;
    ASSERT_TRUE(choleskyInPlace(l));
    const Eigen::MatrixXd expected = a.llt().matrixL();
    EXPECT_LT((Eigen::MatrixXd(l.triangularView<Eigen::Lower>()) - expected).norm(), 1e-10 * a.norm());
    invertFromCholesky(l);
    const Eigen::MatrixXd inverse = l.selfadjointView<Eigen::Lower>();
    EXPECT_LT((a * inverse - Eigen::MatrixXd::Identity(n, n)).norm(), 1e-9);
  }
}

TEST(Dense, saysWhatIsNotPositiveDefinite) {
  Eigen::MatrixXd a = positiveDefinite(5);
  a(3, 3) = -1.0;
  EXPECT_FALSE(choleskyInPlace(a));
}

TEST(Dense, solvesAndMultiplies) {
  const Eigen::Index n = 60;
  const Eigen::MatrixXd a = positiveDefinite(n), b = Eigen::MatrixXd::Random(n, 7);
  const Eigen::MatrixXd l = a.llt().matrixL();
  Eigen::MatrixXd x = b;
  solveLower(l, x);
  EXPECT_LT((l * x - b).norm(), 1e-9);
  x = b;
  solveLowerTransposed(l, x);
  EXPECT_LT((l.transpose() * x - b).norm(), 1e-9);
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(n, n);
  addSquare(2.0, b, c);
  EXPECT_LT((Eigen::MatrixXd(c.selfadjointView<Eigen::Lower>()) - 2.0 * b * b.transpose()).norm(), 1e-10);
  Eigen::MatrixXd overwritten = Eigen::MatrixXd::Constant(n, n, std::numeric_limits<double>::quiet_NaN());
  setSquare(2.0, b, overwritten);
  EXPECT_EQ(Eigen::MatrixXd(overwritten.triangularView<Eigen::Lower>()),
            Eigen::MatrixXd(c.triangularView<Eigen::Lower>()));
  const Eigen::MatrixXd lower = a.triangularView<Eigen::Lower>();
  EXPECT_LT((timesSymmetric(lower, b) - a * b).norm(), 1e-9);
  EXPECT_LT((product(a, b) - a * b).norm(), 1e-9);
  EXPECT_LT((product(b, b, true) - b * b.transpose()).norm(), 1e-9);
}

/// A column of a larger matrix has another stride.
TEST(Dense, solvesPartsOfMatrices) {
  const Eigen::MatrixXd l = positiveDefinite(9).llt().matrixL();
  Eigen::MatrixXd whole = Eigen::MatrixXd::Random(20, 4);
  const Eigen::MatrixXd before = whole;
  solveLower(l, whole.middleRows(5, 9));
  EXPECT_LT((l * whole.middleRows(5, 9) - before.middleRows(5, 9)).norm(), 1e-10);
  EXPECT_EQ(whole.topRows(5), before.topRows(5));
  EXPECT_EQ(whole.bottomRows(6), before.bottomRows(6));
}

}  // namespace
}  // namespace capstan::math
