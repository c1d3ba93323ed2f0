#include "core/math/triangularise.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "core/base/random.h"

namespace capstan::math {
namespace {

constexpr int kRows = 6, kColumns = 19;
using Array = StackedArray<kRows, kColumns>;
using Root = Eigen::Matrix<double, kRows, kRows, Eigen::RowMajor>;

class Triangularise : public testing::TestWithParam<InstructionSet> {
 protected:
  void SetUp() override {
    if (!isAvailable(GetParam())) GTEST_SKIP() << "this processor lacks " << nameOf(GetParam());
  }
  Root run(const Array& a) const {
    alignas(64) Array scratch = a;
    Root root;
    triangulariseKernel(GetParam())(scratch.data(), kRows, Array::ColsAtCompileTime, root.data());
    return root;
  }
};

Array randomArray(base::Random& random) {
  Array a = Array::Zero();
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j < kColumns; ++j) a(i, j) = random.normal();
  return a;
}

/// |R|ᵀ of Householder's factorisation of Aᵀ, diagonal made positive.
Root householder(const Array& a) {
  const Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic> tall = a.transpose().cast<long double>();
  const Eigen::HouseholderQR<Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>> qr(tall);
  Eigen::Matrix<long double, kRows, kRows> upper =
      qr.matrixQR().topRows<kRows>().triangularView<Eigen::Upper>();
  for (int i = 0; i < kRows; ++i)
    if (upper(i, i) < 0.0L) upper.row(i) *= -1.0L;
  return upper.transpose().cast<double>();
}

TEST_P(Triangularise, AgreesWithHouseholder) {
  base::Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const Array a = randomArray(random);
    const Root root = run(a);
    EXPECT_TRUE(root.isLowerTriangular());
    EXPECT_LT((root - householder(a)).norm(), 1e-13 * root.norm());
  }
}

TEST_P(Triangularise, KeepsWhatTheSquareWouldLose) {
  base::Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    Array a = randomArray(random);
    a.row(3) = 1e6 * a.row(1) + 1e-6 * a.row(3);  // condition 1e12: A Aᵀ is singular in double
    a.row(5) *= 1e-9;
    const Root expected = householder(a);
    const Root root = run(a);
    // Backward stable: L Lᵀ = (A + E)(A + E)ᵀ with each row of E a rounding of that row of A.
    const Eigen::Matrix<long double, kRows, kRows> square =
        a.cast<long double>() * a.cast<long double>().transpose();
    const Eigen::Matrix<long double, kRows, kRows> product =
        root.cast<long double>() * root.cast<long double>().transpose();
    for (int i = 0; i < kRows; ++i)
      for (int j = 0; j <= i; ++j)
        EXPECT_LT(std::abs(product(i, j) - square(i, j)), 1e-14L * a.row(i).norm() * a.row(j).norm())
            << i << j;
    EXPECT_NEAR(root(3, 3) / expected(3, 3), 1.0, 1e-3);
  }
}

TEST_P(Triangularise, DependentAndZeroRowsGiveZeroDiagonals) {
  Array a = Array::Zero();
  a(1, 0) = 3.0;
  a(1, 7) = 4.0;
  a.row(2) = 2.0 * a.row(1);
  const Root root = run(a);
  EXPECT_EQ(root(0, 0), 0.0);
  EXPECT_DOUBLE_EQ(root(1, 1), 5.0);
  EXPECT_DOUBLE_EQ(root(2, 1), 10.0);
  EXPECT_NEAR(root(2, 2), 0.0, 1e-15);
  EXPECT_TRUE(root.allFinite());
}

TEST_P(Triangularise, TinyNumbersStayFinite) {
  base::Random random(6);
  for (const double scale : {1e-140, 1e-160, 1e-300, 5e-324})
    EXPECT_TRUE(run(Array(scale * randomArray(random))).allFinite()) << scale;
}

TEST_P(Triangularise, NonFiniteIsNotHidden) {
  base::Random random(7);
  Array a = randomArray(random);
  a(2, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(run(a).allFinite());
  a(2, 3) = 1e200;
  EXPECT_FALSE(run(a).allFinite());
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, Triangularise, testing::ValuesIn(kInstructionSets));

}  // namespace
}  // namespace capstan::math
