// Log predictive density of held-out residuals: numbers by hand, on two recordings of one encoder.
#include "core/diagnosis/selection/predictive_score.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <vector>

#include "core/base/random.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "tests/support/folders.h"
#include "tests/support/planted/planted_case.h"

namespace capstan::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kSamples = 50.0;  // of a block

/// Two recordings of a rigid axis in blocks of half a second, each with one channel.
struct TwoRecordings {
  std::vector<Evidence> evidence;
  std::unique_ptr<FitData> data;
  std::vector<int> recording;  ///< of each block

  TwoRecordings() {
    test::DrawOptions options;
    options.robot = robot::readDescription(test::sourceFile("tests/support/planted/data/rigid_axis.yaml"));
    options.rigid = true;
    options.effects = 0;
    options.duration = 8.0;
    options.sensors.cameras = false;
    for (const std::uint64_t seed : {5, 6})
      evidence.push_back(evidenceOf(test::record(test::draw(seed, options)).table, options.robot));
    data = std::make_unique<FitData>(evidence, options.robot, 0.5, EncoderZeros::kKnown, 1);
    recording.assign(static_cast<std::size_t>(data->blocks()), 0);
    for (std::size_t i = 0; i < data->block().size(); ++i)
      recording[static_cast<std::size_t>(data->block()[i])] = data->channel()[i];
  }

  Index blocks(int r) const { return std::ranges::count(recording, r); }
  /// Variance below which the sensors explain everything: 0.9 of theirs, the mean of both recordings.
  double sensorFloor() const {
    const double a = data->channels()[0].noise, b = data->channels()[1].noise;
    return kSensorConfidence * 0.5 * (a * a + b * b);
  }

  /// The same mean square in all blocks of a recording.
  BlockSquares squares(double first, double second, double inflation = 1.0) const {
    BlockSquares all{Eigen::MatrixXd::Zero(2, data->blocks()), Eigen::MatrixXd::Zero(2, data->blocks()),
                     VectorXd::Constant(2, inflation)};
    for (Index b = 0; b < data->blocks(); ++b) {
      const int r = recording[static_cast<std::size_t>(b)];
      all.count(r, b) = kSamples;
      all.sum(r, b) = kSamples * (r == 0 ? first : second);
    }
    return all;
  }

  ScoredChannels channels() const {
    return {{data->sensorOf().begin(), data->sensorOf().end()},
            Eigen::Vector2d(data->channels()[0].noise, data->channels()[1].noise),
            noInputNoise(2),
            noInputNoise(2)};
  }

  PredictiveScore score(const VectorXd& input_noise = VectorXd::Zero(2), int draws = 0,
                        std::uint64_t seed = 1) const {
    ScoredChannels channels = this->channels();
    channels.input.rms = input_noise;
    return {channels, data->blocks(), draws, seed};
  }
};

TEST(PredictiveScore, IsTheGaussianLogDensityOfAllRecordingsTogether) {
  const TwoRecordings two;
  ASSERT_EQ(two.data->channels().size(), 2U);
  const double n1 = kSamples * static_cast<double>(two.blocks(0)),
               n2 = kSamples * static_cast<double>(two.blocks(1));
  ASSERT_GT(n1, 0.0);
  ASSERT_GT(n2, 0.0);
  PredictiveScore score = two.score();
  const BlockSquares squares = two.squares(4e-6, 1e-6, 5.0);
  score.learnInflation(squares);
  const double variance = (n1 * 4e-6 + n2 * 1e-6) / (n1 + n2);
  EXPECT_NEAR(score.of(squares), -0.5 * (n1 + n2) / 5.0 * std::log(variance), 1e-9);
}

/// What a joint leaves of its worst recording counts more than what it leaves of its best: variances of their
/// own would pay any price for a recording that is fitted perfectly.
TEST(PredictiveScore, HalvingTheWorstRecordingGainsMoreThanMakingTheBestPerfect) {
  const TwoRecordings two;
  const double n1 = kSamples * static_cast<double>(two.blocks(0)),
               n2 = kSamples * static_cast<double>(two.blocks(1)), bad = 1e-4, good = 1e-6;
  PredictiveScore score = two.score();
  const BlockSquares before = two.squares(bad, good), halved = two.squares(0.5 * bad, good),
                     perfect = two.squares(bad, 1e-30);
  score.learnInflation(before);
  const double gain_halved = score.of(halved) - score.of(before),
               gain_perfect = score.of(perfect) - score.of(before);
  EXPECT_NEAR(gain_halved, 0.5 * (n1 + n2) * std::log((n1 * bad + n2 * good) / (0.5 * n1 * bad + n2 * good)),
              1e-6);
  EXPECT_NEAR(gain_perfect, 0.5 * (n1 + n2) * std::log((n1 * bad + n2 * good) / (n1 * bad)), 1e-6);
  EXPECT_GT(gain_halved, 20.0 * gain_perfect);
}

TEST(PredictiveScore, NothingIsGainedBelowWhatTheSensorsLeave) {
  const TwoRecordings two;
  const double n = kSamples * static_cast<double>(two.data->blocks()), floor = two.sensorFloor();
  ASSERT_GT(floor, 0.0);
  PredictiveScore score = two.score();
  const BlockSquares below = two.squares(0.5 * floor, 0.5 * floor), zero = two.squares(0.0, 0.0);
  score.learnInflation(below);
  EXPECT_EQ(score.of(below), score.of(zero));
  EXPECT_NEAR(score.of(zero), -0.5 * n * std::log(floor), 1e-6);
  EXPECT_LT(score.of(two.squares(1.1 * floor, 1.1 * floor)), score.of(zero));
  // Noise of the inputs adds to it, the mean of both recordings.
  const double input = 10.0 * std::sqrt(floor);
  PredictiveScore shaken = two.score(Eigen::Vector2d(input, 3.0 * input));
  shaken.learnInflation(below);
  EXPECT_NEAR(shaken.of(zero), -0.5 * n * std::log(floor + 5.0 * input * input), 1e-6);
}

TEST(PredictiveScore, NoModelCanGainMoreThanIsLeftAboveTheNoise) {
  const TwoRecordings two;
  const double noise = two.sensorFloor() / kSensorConfidence;
  PredictiveScore score = two.score();
  const BlockSquares least = two.squares(noise, noise), twice = two.squares(2.0 * noise, 2.0 * noise);
  score.learnInflation(least);
  EXPECT_NEAR(score.room(least), 0.0, 1e-9);
  EXPECT_EQ(score.room(two.squares(0.5 * noise, 0.5 * noise)), 0.0);
  EXPECT_NEAR(score.room(twice), score.of(least) - score.of(twice), 1e-9);
  EXPECT_EQ(score.mostGain(twice, 0.99), score.room(twice));
  EXPECT_NEAR(score.mostGain(twice, 0.1), -0.5 * kBeyondTest * twice.count.sum() * std::log(0.9), 1e-9);
}

/// The inflation of the model that fits best counts for all of them, of recordings the largest.
TEST(PredictiveScore, InflationIsSharedByAllModels) {
  const TwoRecordings two;
  PredictiveScore score = two.score();
  BlockSquares smooth = two.squares(3e-6, 3e-6, 8.0), white = two.squares(2e-6, 2e-6, 2.0);
  score.learnInflation(smooth);
  const double alone = score.of(smooth);
  white.inflation[1] = 4.0;
  score.learnInflation(white);
  EXPECT_NEAR(score.of(smooth), 2.0 * alone, 1e-9) << "8 became 4";
  for (const double inflation : {1.0, 16.0}) score.learnInflation(two.squares(3e-6, 3e-6, inflation));
  EXPECT_NEAR(score.of(smooth), 2.0 * alone, 1e-9) << "a model that fits worse teaches nothing";
  smooth.inflation.setConstant(100.0);
  EXPECT_NEAR(score.of(smooth), 2.0 * alone, 1e-9) << "a model's own does not count";
}

/// Residuals that look white, and consist of noise that is not.
TEST(PredictiveScore, InflationIsAtLeastThatOfTheNoiseInTheResidual) {
  const TwoRecordings two;
  ScoredChannels channels = two.channels();
  const double sensor = 1e-3, input = 2e-3, torque = 4e-3;
  channels.noise.setConstant(sensor);
  channels.input = {Eigen::Vector2d::Constant(input), Eigen::Vector2d::Constant(30.0)};
  channels.torque = {Eigen::Vector2d::Constant(torque), Eigen::Vector2d::Constant(90.0)};
  const auto inflation = [&](double variance) {
    PredictiveScore score(channels, two.data->blocks(), 0, 1);
    const BlockSquares left = two.squares(variance, variance);
    score.learnInflation(left);
    return -0.5 * left.count.sum() * std::log(variance) / score.of(left);
  };
  const double s = sensor * sensor, i = input * input, known = s + i;
  EXPECT_NEAR(inflation(known), (s * s + 2.0 * s * i + 30.0 * i * i) / (known * known), 1e-6);
  EXPECT_GT(inflation(1.5 * known), inflation(known)) << "torques between the rows";
  const double most = inflation(known + torque * torque);
  EXPECT_GT(most, 30.0);
  EXPECT_LT(most, 90.0);
  EXPECT_NEAR(inflation(100.0 * known), most, 1e-6) << "no more than torques can cause";
}

TEST(PredictiveScore, AModelThatDivergedIsTheWorstAndTeachesNothing) {
  const TwoRecordings two;
  PredictiveScore score = two.score();
  const BlockSquares sound = two.squares(1e-6, 1e-6, 8.0);
  score.learnInflation(sound);
  const double before = score.of(sound);
  BlockSquares diverged = two.squares(1e-6, 1e-6, 1.0);
  diverged.sum(0, 0) = std::numeric_limits<double>::quiet_NaN();
  score.learnInflation(diverged);
  EXPECT_EQ(score.of(sound), before);
  EXPECT_EQ(score.of(diverged), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(score.of({}), -std::numeric_limits<double>::infinity());
}

/// To first order, the score of a block bootstrap has mean L + N v / 4 and variance N² v / 4, where v is the
/// variance of the blocks' mean squares over the square of their mean and over their number.
TEST(PredictiveScore, DrawsScatterAboutTheScoreAsBlocksDo) {
  constexpr int kMany = 4000;
  const TwoRecordings two;
  PredictiveScore score = two.score(VectorXd::Zero(2), kMany, 3);
  BlockSquares squares = two.squares(1e-6, 1e-6);
  base::Random random(4, "blocks");
  VectorXd of_block(two.data->blocks());
  for (Index b = 0; b < of_block.size(); ++b) {
    const int r = two.recording[static_cast<std::size_t>(b)];
    squares.sum(r, b) *= random.uniform(0.6, 1.4);
    of_block[b] = squares.sum(r, b);
  }
  score.learnInflation(squares);
  const double mean = of_block.mean(), blocks = static_cast<double>(of_block.size());
  const double v = (of_block.array() - mean).square().mean() / (mean * mean) / blocks;
  const double n = kSamples * blocks, sigma = 0.5 * n * std::sqrt(v);
  const VectorXd draws = score.ofDraws(squares);
  ASSERT_EQ(draws.size(), kMany);
  const double of_draws = draws.mean();
  EXPECT_NEAR(of_draws, score.of(squares) + 0.25 * n * v, 4.0 * sigma / std::sqrt(double{kMany}));
  EXPECT_NEAR(std::sqrt((draws.array() - of_draws).square().mean()), sigma, 0.1 * sigma);
}

TEST(PredictiveScore, SameSeedSameDrawsForAllModels) {
  const TwoRecordings two;
  BlockSquares squares = two.squares(1e-6, 2e-6);
  squares.sum.col(0) *= 3.0;
  const auto draws = [&](std::uint64_t seed) {
    PredictiveScore score = two.score(VectorXd::Zero(2), 20, seed);
    score.learnInflation(squares);
    return score.ofDraws(squares);
  };
  EXPECT_EQ(draws(1), draws(1));
  EXPECT_NE(draws(1), draws(2));
  // Twice the squares in every block: less by ½ N ln 2 in every draw.
  PredictiveScore score = two.score(VectorXd::Zero(2), 20, 1);
  score.learnInflation(squares);
  BlockSquares twice = squares;
  twice.sum *= 2.0;
  const double n = kSamples * static_cast<double>(two.data->blocks());
  const VectorXd lost = score.ofDraws(squares) - score.ofDraws(twice);
  EXPECT_LT((lost.array() - 0.5 * n * std::log(2.0)).abs().maxCoeff(), 1e-6);
}

}  // namespace
}  // namespace capstan::diagnosis
