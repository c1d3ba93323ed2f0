#include "core/estimation/sparse_regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/random.h"
#include "tests/support/counting_new.h"

namespace capstan::estimation {
namespace {

using Regression = SparseRegression<4, 2>;
using Row = Eigen::Matrix<double, 1, 4>;
using Scalar = Eigen::Matrix<double, 1, 1>;

Regression::Prior prior() {
  Regression::Prior p;
  p.sigma << 2.0, 0.5;
  p.inclusion_probability << 0.1, 0.2;
  p.usual_sigma << 1.0, 0.3;
  p.unusual_sigma << 10.0, 6.0;
  p.unusual_probability = 0.05;
  return p;
}

struct Data {
  std::vector<Row> h;
  std::vector<double> z, sigma;
};

Data draw(std::uint64_t seed, const Eigen::Vector4d& x, int count) {
  base::Random random(seed, "rows");
  Data data;
  for (int i = 0; i < count; ++i) {
    Row row;
    for (int k = 0; k < 4; ++k) row(k) = random.normal(0.0, 1.0);
    const double sigma = 0.5 + 0.1 * (i % 5);
    data.h.push_back(row);
    data.z.push_back(row * x + random.normal(0.0, sigma));
    data.sigma.push_back(sigma);
  }
  return data;
}

Information<4> informationOf(const Data& data, const Eigen::Vector4d& sigma) {
  Information<4> information;
  for (std::size_t i = 0; i < data.h.size(); ++i)
    EXPECT_TRUE(
        information.add<1>(data.h[i], Scalar(data.z[i]), Scalar(data.sigma[i] * data.sigma[i]), sigma));
  return information;
}

Regression regressed(const Data& data) {
  Regression regression(prior());
  regression.select(informationOf(data, regression.sigma()));
  return regression;
}

/// log N(z; 0, H P Hᵀ + R), formed in the space of the data: another way to the same evidence.
double logEvidence(const Data& data, const Eigen::Vector4d& prior_variance) {
  const auto n = static_cast<Eigen::Index>(data.h.size());
  Eigen::MatrixXd h(n, 4), covariance = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd z(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    h.row(i) = data.h[k];
    z(i) = data.z[k];
    covariance(i, i) = data.sigma[k] * data.sigma[k];
  }
  covariance += h * prior_variance.asDiagonal() * h.transpose();
  const Eigen::LLT<Eigen::MatrixXd> root(covariance);
  return -0.5 * z.dot(root.solve(z)) - root.matrixLLT().diagonal().array().log().sum();
}

TEST(SparseRegression, WeighsSubmodelsAsTheirEvidenceInTheSpaceOfTheData) {
  const Data data = draw(3, {0.9, 0.15, -0.7, 1.2}, 25);
  const Regression regression = regressed(data);
  const Regression::Prior p = prior();
  double total = 0.0, unusual = 0.0;
  Eigen::Vector2d included = Eigen::Vector2d::Zero();
  for (int regime = 0; regime < 2; ++regime)
    for (int submodel = 0; submodel < 4; ++submodel) {
      Eigen::Vector4d variance = Eigen::Vector4d::Zero();
      double odds = regime ? p.unusual_probability : 1.0 - p.unusual_probability;
      for (int i = 0; i < 2; ++i) {
        const bool in = (submodel >> i) & 1;
        odds *= in ? p.inclusion_probability(i) : 1.0 - p.inclusion_probability(i);
        if (in) variance(i) = p.sigma(i) * p.sigma(i);
        variance(2 + i) = std::pow(regime ? p.unusual_sigma(i) : p.usual_sigma(i), 2);
      }
      const double weight = odds * std::exp(logEvidence(data, variance));
      total += weight;
      if (regime) unusual += weight;
      for (int i = 0; i < 2; ++i)
        if ((submodel >> i) & 1) included(i) += weight;
    }
  EXPECT_NEAR(regression.unusualProbability(), unusual / total, 1e-9);
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(regression.inclusionProbability()(i), included(i) / total, 1e-9) << i;
}

TEST(SparseRegression, AnAbsentCoefficientIsExactlyZeroAndAPresentOneIsFound) {
  const Regression regression = regressed(draw(5, {1.5, 0.0, 0.2, -0.1}, 400));
  ASSERT_TRUE(regression.included(0));
  ASSERT_FALSE(regression.included(1));
  EXPECT_EQ(regression.mean()(1), 0.0);
  EXPECT_EQ(regression.covariance()(1, 1), 0.0);
  EXPECT_NEAR(regression.mean()(0), 1.5, 4.0 * std::sqrt(regression.covariance()(0, 0)));
  EXPECT_LT(std::sqrt(regression.covariance()(0, 0)), 0.06);
}

TEST(SparseRegression, StatedSigmasHoldOverManyDraws) {
  int inside = 0, count = 0;
  base::Random random(11, "truths");
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Eigen::Vector4d x(random.normal(0.0, 2.0), 0.0, random.normal(0.0, 1.0), random.normal(0.0, 0.3));
    const Regression regression = regressed(draw(100 + seed, x, 60));
    if (!regression.included(0)) continue;
    ++count;
    inside += std::abs(regression.mean()(0) - x(0)) < 1.96 * std::sqrt(regression.covariance()(0, 0));
  }
  ASSERT_GT(count, 200);
  EXPECT_NEAR(inside / static_cast<double>(count), 0.95, 0.04);
}

TEST(SparseRegression, ACoefficientEntersWhenItIsCertainAndLeavesWhenItIsDoubtful) {
  Regression::Prior strict = prior();
  strict.enters(0) = 0.95;
  Regression regression(strict);
  bool was_likely = false, was_in_doubt = false;
  const Data data = draw(21, {0.35, 0.0, 0.2, -0.1}, 400);
  for (std::size_t count = 1; count <= data.h.size(); ++count) {
    Data some = data;
    some.h.resize(count);
    some.z.resize(count);
    some.sigma.resize(count);
    const bool before = regression.included(0);
    regression.select(informationOf(some, regression.sigma()));
    const double p = regression.inclusionProbability()(0);
    const bool expected = p > 0.95 || (before && p > 0.5);
    ASSERT_EQ(regression.included(0), expected) << count << " " << p;
    was_likely |= p > 0.5 && p < 0.95 && !before;
    was_in_doubt |= before;
  }
  EXPECT_TRUE(was_likely);
  EXPECT_TRUE(was_in_doubt);
}

TEST(SparseRegression, AnEstimateOutsideItsRangeIsAbsent) {
  const Data data = draw(5, {1.5, 0.0, 0.2, -0.1}, 400);
  Regression::Prior bounded = prior();
  bounded.highest(0) = 1.0;
  Regression regression(bounded);
  regression.select(informationOf(data, regression.sigma()));
  EXPECT_FALSE(regression.included(0));
  EXPECT_EQ(regression.mean()(0), 0.0);
  bounded.highest(0) = 2.0;
  Regression wider(bounded);
  wider.select(informationOf(data, wider.sigma()));
  EXPECT_TRUE(wider.included(0));
}

TEST(SparseRegression, WhatAgesIsKnownLess) {
  const Regression regression = regressed(draw(5, {1.5, 0.0, 0.2, -0.1}, 50));
  double before = regression.covariance()(0, 0);
  for (const double factor : {0.5, 0.1, 0.01}) {
    const double aged = regression.covarianceDiscounted(factor)(0, 0);
    EXPECT_GT(aged, before) << factor;
    before = aged;
  }
}

TEST(SparseRegression, WithoutObservationsThePriorIsLeft) {
  Regression regression = regressed(draw(5, {1.5, 0.0, 0.2, -0.1}, 50));
  regression.select({});
  EXPECT_NEAR(regression.inclusionProbability()(0), 0.1, 1e-12);
  EXPECT_EQ(regression.mean(), Eigen::Vector4d::Zero());
}

TEST(SparseRegression, DoesNotAllocate) {
  Regression regression(prior());
  Information<4> information;
  const std::size_t before = test::allocations();
  for (int i = 0; i < 100; ++i) {
    information.add<1>(Row(1, 2, 3, 4), Scalar(1.0), Scalar(1.0), regression.sigma());
    information.scale(0.99);
    regression.select(information);
  }
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace capstan::estimation
