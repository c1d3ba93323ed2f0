// The sparse process beside the exact one.
#include "core/learning/gaussian_process/sparse_process.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "tests/support/exact_process.h"

namespace capstan::learning {
namespace {

struct Sample {
  Eigen::MatrixXd x, y;
};

Sample sample(Eigen::Index n, std::uint64_t seed) {
  base::Random random(seed, "sparse process test");
  Sample s{Eigen::MatrixXd(n, 2), Eigen::MatrixXd(n, 2)};
  for (Eigen::Index r = 0; r < n; ++r) {
    s.x.row(r) << random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0);
    s.y.row(r) << std::sin(s.x(r, 0)) + random.normal(0.0, 0.1),
        s.x(r, 0) * std::cos(s.x(r, 1)) + random.normal(0.0, 0.1);
  }
  return s;
}

KernelParameters parameters() { return {0.5, std::log(0.1), Eigen::Vector2d(0.2, 0.3)}; }

TEST(SparseProcess, withAllPointsIsTheExactOne) {
  const Sample s = sample(150, 1), at = sample(40, 2);
  SparseProcess sparse(s.x, 2, parameters());
  sparse.add(s.x, s.y);
  const ExactProcess exact(s.x, s.y, parameters());
  const Prediction commanded = sparse.predict(at.x), expected = exact.predict(at.x);
  EXPECT_LT((commanded.mean - expected.mean).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LT((commanded.variance - expected.variance).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_LT((commanded.mean - sparse.mean(at.x)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(SparseProcess, withFewPointsIsNearTheExactOne) {
  const Sample s = sample(2500, 3), at = sample(200, 4);
  const auto chosen = drawnPoints(s.x.rows(), 150, 5);
  SparseProcess sparse(s.x(chosen, Eigen::all), 2, parameters());
  sparse.add(s.x, s.y);
  const ExactProcess exact(s.x, s.y, parameters());
  const Eigen::MatrixXd apart = sparse.mean(at.x) - exact.mean(at.x);
  EXPECT_LT(std::sqrt(apart.squaredNorm() / static_cast<double>(apart.size())), 0.01);
}

/// Of twice the noise each, and of the same outputs.
TEST(SparseProcess, twoDoubtedPointsAreAsGoodAsOne) {
  const Sample s = sample(100, 1), at = sample(40, 2);
  SparseProcess down_weighted(s.x, 2, parameters()), once = down_weighted;
  const Eigen::VectorXd besides = Eigen::VectorXd::Constant(30, parameters().noiseVariance());
  once.add(s.x, s.y);
  down_weighted.add(s.x.bottomRows(70), s.y.bottomRows(70));
  for (int k = 0; k < 2; ++k) down_weighted.add(s.x.topRows(30), s.y.topRows(30), besides);
  EXPECT_LT((down_weighted.mean(at.x) - once.mean(at.x)).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((down_weighted.predict(at.x).variance - once.predict(at.x).variance).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(SparseProcess, learnsInPartsWhatItLearnsAtOnce) {
  const Sample s = sample(400, 6), at = sample(30, 7);
  const auto chosen = drawnPoints(s.x.rows(), 60, 8);
  SparseProcess once(s.x(chosen, Eigen::all), 2, parameters());
  SparseProcess parts = once;
  once.add(s.x, s.y);
  for (Eigen::Index k = 0; k < 400; k += 130) {
    const Eigen::Index n = std::min<Eigen::Index>(130, 400 - k);
    parts.add(s.x.middleRows(k, n), s.y.middleRows(k, n));
  }
  EXPECT_LT((once.mean(at.x) - parts.mean(at.x)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(SparseProcess, knowsNothingBeforeItLearns) {
  const Sample s = sample(30, 9);
  const SparseProcess sparse(s.x, 2, parameters());
  const Prediction commanded = sparse.predict(s.x);
  EXPECT_EQ(commanded.mean.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_NEAR(commanded.variance.minCoeff(), parameters().signalVariance(), 1e-6);
}

TEST(DrawnPoints, areDistinctAndTheSameForASeed) {
  const auto drawn = drawnPoints(100, 40, 3);
  ASSERT_EQ(drawn.size(), 40U);
  EXPECT_TRUE(std::is_sorted(drawn.begin(), drawn.end()));
  EXPECT_EQ(std::adjacent_find(drawn.begin(), drawn.end()), drawn.end());
  EXPECT_GE(drawn.front(), 0);
  EXPECT_LT(drawn.back(), 100);
  EXPECT_EQ(drawn, drawnPoints(100, 40, 3));
  EXPECT_NE(drawn, drawnPoints(100, 40, 4));
  EXPECT_EQ(drawnPoints(5, 9, 1).size(), 5U);
}

}  // namespace
}  // namespace capstan::learning
