// The likelihood beside the textbook's formula by Eigen, and its derivatives beside differences.
#include "core/learning/gaussian_process/marginal_likelihood.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/textbook_process.h"

namespace capstan::learning {
namespace {

using namespace testing;  // the textbook's process

void expectTextbookLikelihood(const KernelParameters& p, Eigen::Index outputs) {
  const Sample s = sample(70, outputs, 0.2);
  const Eigen::MatrixXd k = noisy(s.x, p);
  const Eigen::MatrixXd root = k.llt().matrixL();
  const double expected = 0.5 * s.y.cwiseProduct(k.llt().solve(s.y)).sum() +
                          static_cast<double>(outputs) *
                              (root.diagonal().array().log().sum() + 35.0 * std::log(2.0 * std::numbers::pi));
  const auto value = MarginalLikelihood(s.x, s.y).negativeLog(p, nullptr);
  ASSERT_TRUE(value.has_value());
  EXPECT_NEAR(*value, expected, 1e-8 * std::abs(expected)) << base::nameOf(p.kernel);
}

TEST(MarginalLikelihood, isThatOfTheTextbook) {
  for (const Kernel kernel : kKernels)
    for (const bool ard : {false, true})
      for (const Eigen::Index outputs : {1, 3})
        expectTextbookLikelihood(someParameters(ard, kernel), outputs);
}

/// Memory used again, by other parameters and after a covariance that has no factor.
TEST(MarginalLikelihood, tellsTheSameWheneverAsked) {
  const Sample s = sample(40, 1, 0.2);
  for (const Kernel kernel : kKernels) {
    const KernelParameters p = someParameters(true, kernel);
    KernelParameters none = p;
    none.ln_length.setConstant(30.0), none.ln_noise = -60.0;  // all points alike
    MarginalLikelihood used(s.x, s.y), fresh(s.x, s.y);
    Eigen::VectorXd gradient, again;
    EXPECT_FALSE(used.negativeLog(none, &again));
    (void)used.negativeLog(someParameters(false, kernel), &again);
    EXPECT_EQ(used.negativeLog(p, &again), fresh.negativeLog(p, &gradient));
    EXPECT_EQ(again, gradient);
  }
}

void expectSlopesOfDifferences(const KernelParameters& p, Eigen::Index outputs) {
  constexpr double kStep = 1e-5;
  const Sample s = sample(60, outputs, 0.2);
  MarginalLikelihood likelihood(s.x, s.y);  // used again and again
  const auto valueAt = [&](const Eigen::VectorXd& at) {
    return *likelihood.negativeLog(KernelParameters::unpacked(at, p.kernel), nullptr);
  };
  Eigen::VectorXd gradient;
  ASSERT_TRUE(likelihood.negativeLog(p, &gradient));
  ASSERT_EQ(gradient.size(), p.packed().size());
  for (Eigen::Index k = 0; k < gradient.size(); ++k) {
    Eigen::VectorXd more = p.packed(), less = p.packed();
    more[k] += kStep, less[k] -= kStep;
    const double slope = (valueAt(more) - valueAt(less)) / (2.0 * kStep);
    EXPECT_NEAR(gradient[k], slope, 1e-5 * std::max(1.0, std::abs(slope)))
        << base::nameOf(p.kernel) << ", parameter " << k;
  }
}

TEST(MarginalLikelihood, gradientIsThatOfDifferences) {
  for (const Kernel kernel : kKernels)
    for (const bool ard : {false, true})
      for (const Eigen::Index outputs : {1, 2})
        expectSlopesOfDifferences(someParameters(ard, kernel), outputs);
}

}  // namespace
}  // namespace capstan::learning
