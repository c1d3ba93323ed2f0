// The process beside the textbook's formulas by Eigen.
#include "tests/support/exact_process.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "core/learning/gaussian_process/marginal_likelihood.h"
#include "core/learning/gaussian_process/process_fit.h"
#include "tests/support/textbook_process.h"

namespace capstan::learning {
namespace {

using namespace testing;  // the textbook's process

void expectTextbookPredictions(const KernelParameters& p) {
  const Sample s = sample(80, 2, 0.1), at = sample(15, 2, 0.0, 2);
  const ExactProcess process(s.x, s.y, p);
  EXPECT_EQ(process.jitter(), 0.0);
  const Prediction commanded = process.predict(at.x);
  const Eigen::MatrixXd cross = kernels(at.x, s.x, p);
  const auto factor = noisy(s.x, p).llt();
  EXPECT_LT((commanded.mean - cross * factor.solve(s.y)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((commanded.mean - process.mean(at.x)).cwiseAbs().maxCoeff(), 1e-12);
  const Eigen::VectorXd variance = kernels(at.x, at.x, p).diagonal() -
                                   (cross * factor.solve(Eigen::MatrixXd(cross.transpose()))).diagonal();
  EXPECT_LT((commanded.variance - variance).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ExactProcess, predictsAsTheTextbook) {
  for (const Kernel kernel : kKernels) expectTextbookPredictions(someParameters(true, kernel));
}

TEST(ExactProcess, knowsNothingFarAway) {
  const Sample s = sample(50, 1, 0.1);
  const ExactProcess process(s.x, s.y, someParameters(true));
  const Prediction commanded = process.predict(Eigen::MatrixXd::Constant(1, 3, 60.0));
  EXPECT_NEAR(commanded.mean(0, 0), 0.0, 1e-12);
  EXPECT_NEAR(commanded.variance[0], process.parameters().signalVariance(), 1e-12);
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
