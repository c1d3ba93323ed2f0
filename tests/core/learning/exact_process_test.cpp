// The process beside the textbook's formulas by Eigen, and its derivatives beside differences.
#include "core/learning/exact_process.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "core/learning/marginal_likelihood.h"
#include "core/learning/process_fit.h"

namespace capstan::learning {
namespace {

struct Sample {
  Eigen::MatrixXd x, y;
};

/// Points in three dimensions, the third of no use, and smooth outputs under noise.
Sample sample(Eigen::Index n, Eigen::Index outputs, double noise, std::uint64_t seed = 1) {
  base::Random random(seed, "process test");
  Sample s{Eigen::MatrixXd(n, 3), Eigen::MatrixXd(n, outputs)};
  for (Eigen::Index r = 0; r < n; ++r) {
    for (Eigen::Index c = 0; c < 3; ++c) s.x(r, c) = random.uniform(-2.0, 2.0);
    for (Eigen::Index c = 0; c < outputs; ++c)
      s.y(r, c) = std::sin(1.3 * s.x(r, 0) + static_cast<double>(c)) * std::cos(0.7 * s.x(r, 1)) +
                  random.normal(0.0, noise);
  }
  return s;
}

constexpr std::array kKernels = {Kernel::kRbf, Kernel::kMatern};

KernelParameters someParameters(bool ard, Kernel kernel = Kernel::kRbf) {
  KernelParameters p{0.2, -1.4, {}, kernel};
  if (ard)
    p.ln_length = Eigen::Vector3d(-0.1, 0.4, 1.1);
  else
    p.ln_length = Eigen::VectorXd::Constant(1, 0.3);
  return p;
}

/// (5.1) and (4.17), element by element.
double kernel(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const KernelParameters& p) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    const double length = std::exp(p.ln_length[p.ln_length.size() == 1 ? 0 : i]);
    sum += std::pow((a[i] - b[i]) / length, 2);
  }
  const double variance = std::exp(2.0 * p.ln_signal), r = std::sqrt(sum);
  if (p.kernel == Kernel::kRbf) return variance * std::exp(-0.5 * r * r);
  return variance * (1.0 + std::sqrt(3.0) * r) * std::exp(-std::sqrt(3.0) * r);
}

Eigen::MatrixXd kernels(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const KernelParameters& p) {
  Eigen::MatrixXd k(a.rows(), b.rows());
  for (Eigen::Index r = 0; r < k.rows(); ++r)
    for (Eigen::Index c = 0; c < k.cols(); ++c) k(r, c) = kernel(a.row(r), b.row(c), p);
  return k;
}

Eigen::MatrixXd noisy(const Eigen::MatrixXd& x, const KernelParameters& p) {
  return kernels(x, x, p) + p.noiseVariance() * Eigen::MatrixXd::Identity(x.rows(), x.rows());
}

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

TEST(ExactProcess, likelihoodIsThatOfTheTextbook) {
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

TEST(ExactProcess, gradientIsThatOfDifferences) {
  for (const Kernel kernel : kKernels)
    for (const bool ard : {false, true})
      for (const Eigen::Index outputs : {1, 2})
        expectSlopesOfDifferences(someParameters(ard, kernel), outputs);
}

void expectTextbookPredictions(const KernelParameters& p) {
  const Sample s = sample(80, 2, 0.1), at = sample(15, 2, 0.0, 2);
  const ExactProcess process(s.x, s.y, p);
  EXPECT_EQ(process.jitter(), 0.0);
  const Prediction told = process.predict(at.x);
  const Eigen::MatrixXd cross = kernels(at.x, s.x, p);
  const auto factor = noisy(s.x, p).llt();
  EXPECT_LT((told.mean - cross * factor.solve(s.y)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((told.mean - process.mean(at.x)).cwiseAbs().maxCoeff(), 1e-12);
  const Eigen::VectorXd variance = kernels(at.x, at.x, p).diagonal() -
                                   (cross * factor.solve(Eigen::MatrixXd(cross.transpose()))).diagonal();
  EXPECT_LT((told.variance - variance).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ExactProcess, predictsAsTheTextbook) {
  for (const Kernel kernel : kKernels) expectTextbookPredictions(someParameters(true, kernel));
}

TEST(ExactProcess, knowsNothingFarAway) {
  const Sample s = sample(50, 1, 0.1);
  const ExactProcess process(s.x, s.y, someParameters(true));
  const Prediction told = process.predict(Eigen::MatrixXd::Constant(1, 3, 60.0));
  EXPECT_NEAR(told.mean(0, 0), 0.0, 1e-12);
  EXPECT_NEAR(told.variance[0], process.parameters().signalVariance(), 1e-12);
}

TEST(ExactProcess, standsRepeatsWithoutNoise) {
  Sample s = sample(40, 1, 0.0);
  s.x.bottomRows(20) = s.x.topRows(20);
  s.y.bottomRows(20) = s.y.topRows(20);
  KernelParameters p = someParameters(true);
  p.ln_noise = -30.0;
  const ExactProcess process(s.x, s.y, p);
  EXPECT_LT(process.jitter(), 1e-8);
  EXPECT_LT((process.mean(s.x) - s.y).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(ProcessFit, findsTheNoiseAndWhatIsOfNoUse) {
  const Sample s = sample(300, 1, 0.1);
  const ProcessFitOptions options;
  const ProcessFitReport report = fitProcess(s.x, s.y, startOf(s.x, s.y, options), options);
  EXPECT_TRUE(report.converged);
  EXPECT_NEAR(std::exp(report.parameters.ln_noise), 0.1, 0.015);
  EXPECT_GT(report.parameters.ln_length[2], report.parameters.ln_length[0] + 1.5) << "the third says nothing";
  Eigen::VectorXd gradient;
  ASSERT_TRUE(MarginalLikelihood(s.x, s.y).negativeLog(report.parameters, &gradient));
  EXPECT_LT(gradient.head(4).cwiseAbs().maxCoeff(), 0.1);
}

TEST(ProcessFit, standsAConstantFeatureAndOutput) {
  Sample s = sample(60, 1, 0.1);
  s.x.col(2).setConstant(3.0);
  const ProcessFitOptions options;
  EXPECT_TRUE(fitProcess(s.x, s.y, startOf(s.x, s.y, options), options).parameters.packed().allFinite());
  s.y.setZero();
  EXPECT_TRUE(fitProcess(s.x, s.y, startOf(s.x, s.y, options), options).parameters.packed().allFinite());
}

TEST(ProcessFit, cancelledItKeepsWhatItHas) {
  const Sample s = sample(60, 1, 0.1);
  const ProcessFitOptions options;
  base::Progress progress;
  progress.cancel();
  const KernelParameters start = startOf(s.x, s.y, options);
  EXPECT_EQ(fitProcess(s.x, s.y, start, options, &progress).parameters.packed(), start.packed());
}

}  // namespace
}  // namespace capstan::learning
