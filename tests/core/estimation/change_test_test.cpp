#include "core/estimation/change_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "core/estimation/information.h"
#include "tests/support/counting_new.h"

namespace capstan::estimation {
namespace {

using Vector = Eigen::Vector3d;
using Row = Eigen::RowVector3d;
using Scalar = Eigen::Matrix<double, 1, 1>;
using Changes = ChangeTest<3, 2, 8>;

constexpr double kSigma = 0.5;

/// Of a change of coefficient 0 alone, and of coefficients 1 and 2.
const Changes::Kinds kKinds = {Vector(1.0, 0.0, 0.0), Vector(0.0, 1.0, 1.0)};

Information<3> segment(base::Random& random, const Vector& x, int count) {
  Information<3> information;
  for (int i = 0; i < count; ++i) {
    const Row row(random.normal(), random.normal(), random.normal());
    information.add<1>(row, Scalar(row * x + random.normal(0.0, kSigma)), Scalar(kSigma * kSigma),
                       Vector::Ones());
  }
  return information;
}

Vector estimateOf(const Information<3>& information) {
  const Eigen::Matrix3d posterior = information.matrix + Eigen::Matrix3d::Identity();
  return posterior.llt().solve(information.score);
}

TEST(Information, RefusesNumbersThatAreNotFinite) {
  Information<3> information;
  const Vector sigma = Vector::Ones();
  EXPECT_FALSE(information.add<1>(Row(std::nan(""), 0, 0), Scalar(1.0), Scalar(1.0), sigma));
  EXPECT_FALSE(information.add<1>(Row(1, 0, 0), Scalar(std::nan("")), Scalar(1.0), sigma));
  EXPECT_FALSE(information.add<1>(Row(1, 0, 0), Scalar(1.0), Scalar(-1.0), sigma));
  EXPECT_EQ(information.count, 0);
  EXPECT_EQ(information.score, Vector::Zero());
}

/// By the covariance: of x + w it is that of x and that of w.
TEST(Information, ReleasedIsOfTheChangedCoefficients) {
  base::Random random(3, "released");
  const Information<3> before = segment(random, {0.3, -0.7, 0.2}, 40);
  const Vector variance(0.5, 0.0, 2.0);
  const Information<3> after = before.released(variance);
  const Eigen::Matrix3d expected = before.matrix.inverse() + Eigen::Matrix3d(variance.asDiagonal());
  EXPECT_LT((after.matrix.inverse() - expected).norm(), 1e-9 * expected.norm());
  const Vector mean = before.matrix.inverse() * before.score;
  EXPECT_LT((after.matrix.inverse() * after.score - mean).norm(), 1e-9);
}

TEST(ChangeTest, FindsNoChangeWhereThereIsNone) {
  int changes = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    base::Random random(seed, "steady");
    Changes test(Vector::Ones(), kKinds, 9.0, 5.0);
    for (int i = 0; i < 50; ++i) changes += test.close(segment(random, {0.3, -0.7, 0.2}, 15), 1.0) != -1;
  }
  EXPECT_EQ(changes, 0);
}

TEST(ChangeTest, NamesTheKindAndKeepsWhatDidNotChange) {
  for (int kind = 0; kind < 2; ++kind) {
    base::Random random(7, "step");
    Changes test(Vector::Ones(), kKinds, 9.0, 5.0);
    const Vector before(0.3, -0.7, 0.2);
    const Vector after = before + (kind == 0 ? Vector(1.0, 0.0, 0.0) : Vector(0.0, 0.6, -0.8));
    for (int i = 0; i < 30; ++i) EXPECT_EQ(test.close(segment(random, before, 15), 1.0), Changes::kNoChange);
    int found = Changes::kNoChange, when = 0;
    for (; when < 10 && found < 0; ++when) found = test.close(segment(random, after, 15), 1.0);
    EXPECT_EQ(found, kind);
    EXPECT_LE(when, 3);
    for (int i = 0; i < 5; ++i) test.close(segment(random, after, 15), 1.0);
    const Vector estimate = estimateOf(test.known());
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(estimate(i), after(i), 0.2) << kind << " " << i;
    EXPECT_GT(test.known().count, 30 * 15) << "what was known before still counts";
  }
}

/// Both kinds explain the change alike as long as the rows are those of one direction.
TEST(ChangeTest, AChangeOfAKindThatNobodyCanTellIsInQuestionAndLeavesWhatWasKnown) {
  base::Random random(9, "alike");
  Changes test(Vector::Ones(), kKinds, 9.0, 5.0);
  for (int i = 0; i < 20; ++i) test.close(segment(random, {0.3, -0.7, 0.2}, 15), 1.0);
  const Vector known = estimateOf(test.known());
  int verdict = 0;
  for (int i = 0; i < 6; ++i) {
    Information<3> one;
    for (int k = 0; k < 15; ++k) {
      const Row row(1.0, 1.0, 0.0);
      const double z = row * Vector(1.3, -0.7, 0.2) + random.normal(0.0, kSigma);
      one.add<1>(row, Scalar(z), Scalar(kSigma * kSigma), Vector::Ones());
    }
    verdict = test.close(one, 1.0);
  }
  EXPECT_EQ(verdict, Changes::kInQuestion);
  EXPECT_TRUE(test.inQuestion());
  EXPECT_LT((estimateOf(test.known()) - known).norm(), 0.05);
  for (int i = 0; i < 6 && verdict < 0; ++i) verdict = test.close(segment(random, {1.3, -0.7, 0.2}, 15), 1.0);
  EXPECT_EQ(verdict, 0) << "rows of all directions tell";
}

TEST(ChangeTest, DoesNotAllocate) {
  base::Random random(5, "none");
  Changes test(Vector::Ones(), kKinds, 9.0, 5.0);
  const std::size_t before = test::allocations();
  for (int i = 0; i < 40; ++i) {
    test.forget(0.99);
    test.close(segment(random, i < 20 ? Vector(0.3, 0.0, 0.0) : Vector(3.0, 0.0, 0.0), 15), 1.0);
  }
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace capstan::estimation
