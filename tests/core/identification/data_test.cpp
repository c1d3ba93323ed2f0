#include "core/identification/identification_data.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/identification/convergence.h"
#include "core/identification/score_spread.h"
#include "tests/core/identification/matched_recording.h"

namespace capstan::identification {
namespace {

using test::matchedRecording;
using test::softRaven;

TEST(IdentificationData, MeasuresTheNoiseThatIsThere) {
  const auto robot = softRaven();
  auto data = matchedRecording(robot, robot, {.duration = 60.0, .tip_sigma = 3e-4});
  for (auto& seen : data.cameras) seen.tip_covariance *= 4.0;  // stated twice too wide
  data.images = true;
  measureNoise(data);
  EXPECT_NEAR(data.noise_ratio, 0.5, 0.03);
  EXPECT_NEAR(std::sqrt(data.cameras[10].tip_covariance(1, 1)), 3e-4, 2e-5);
}

TEST(IdentificationData, OutliersDoNotCountAsNoise) {
  const auto robot = softRaven();
  auto data = matchedRecording(robot, robot, {.duration = 60.0, .tip_sigma = 3e-4});
  for (std::size_t i = 7; i < data.cameras.size(); i += 40) data.cameras[i].tip(1) += 0.05;
  measureNoise(data);
  EXPECT_NEAR(std::sqrt(data.cameras[10].tip_covariance(1, 1)), 3e-4, 3e-5);
}

TEST(IdentificationData, OneRecordingBehindTheOther) {
  const auto robot = softRaven();
  auto data = matchedRecording(robot, robot, {.duration = 3.0});
  const auto more = matchedRecording(robot, robot, {.duration = 2.0});
  append(data, more);
  EXPECT_EQ(data.motors.size(), 3001U + 2001U);
  EXPECT_DOUBLE_EQ(data.motors.t[3001], 4.0);
  EXPECT_DOUBLE_EQ(data.cameras.back().t, 4.0 + more.cameras.back().t);
  EXPECT_TRUE(std::is_sorted(data.motors.t.begin(), data.motors.t.end()));
}

ParameterFilter::Innovation innovation(double value) {
  ParameterFilter::Innovation made;
  made.value = {value, 0.0, 0.0};
  made.by_unknown.setZero();
  made.by_unknown(0, 0) = 1.0;
  made.noise_covariance.setIdentity();
  made.innovation_covariance.setIdentity();
  made.nis = value * value;
  return made;
}

/// x_k = a x_{k−1} + noise: long blocks have a score variance (1 + a) / (1 − a) times that of white
/// innovations.
TEST(ScoreSpread, CorrelatedInnovationsWidenSigma) {
  for (const double a : {0.0, 0.6}) {
    base::Random random(3, "scores");
    ScoreSpread spread(10.0, 5.0, 1e9);
    double x = 0.0;
    for (int k = 0; k < 300000; ++k) {
      x = a * x + std::sqrt(1.0 - a * a) * random.normal();
      spread.add(0.1 * k, innovation(x), Eigen::Matrix3d::Zero());
    }
    ScoreSpread::Square covariance = ScoreSpread::Square::Identity();
    EXPECT_NEAR(std::pow(spread.factors(covariance)(0), 2), (1.0 + a) / (1.0 - a),
                0.12 * (1.0 + a) / (1.0 - a));
  }
}

/// As at the beginning of a filter, whose parameters are far off as its covariance says.
TEST(ScoreSpread, ExpectedInnovationsOfUnknownParametersDoNotWidenSigma) {
  base::Random random(3, "scores");
  ScoreSpread spread(1.0, 5.0, 1e9);
  for (int k = 0; k < 20000; ++k) {
    const double sigma = k < 1000 ? 100.0 : 1.0;
    ParameterFilter::Innovation made = innovation(sigma * random.normal());
    made.innovation_covariance *= sigma * sigma;
    spread.add(0.1 * k, made, Eigen::Matrix3d::Zero());
  }
  EXPECT_NEAR(spread.factors(ScoreSpread::Square::Identity())(0), 1.0, 0.05);
}

/// An unknown force that moves the tip by d over n observations adds n² d² to the variance n of their scores.
TEST(ScoreSpread, AnUnknownForceWidensSigmaByWhatItWouldDo) {
  constexpr double kStep = 1.0 / 16.0, kShift = 0.3;
  Eigen::Matrix3d by_discrepancy = Eigen::Matrix3d::Zero();
  by_discrepancy(0, 1) = kShift;
  base::Random random(3, "scores");
  ScoreSpread spread(10.0, 1.0, 1e9);
  for (int k = 0; k <= 100000; ++k)  // the last one closes both kinds of block
    spread.add(kStep * k, innovation(random.normal()), by_discrepancy);
  const ScoreSpread::Square covariance = ScoreSpread::Square::Identity();
  EXPECT_NEAR(std::pow(spread.factors(covariance)(0), 2), 1.0 + 16.0 * kShift * kShift, 1e-4);
}

Trace fallingTrace(double rest_value) {
  Trace trace;
  for (double t = 0.0; t <= 100.0; t += 0.5) {
    TracePoint point;
    point.t = t;
    point.log = ParameterSet::Logs::Constant(1, t < 30.0 ? 0.01 * (30.0 - t) : rest_value);
    point.sigma = ParameterSet::Logs::Constant(1, 0.01 / std::sqrt(1.0 + t));
    trace.push_back(point);
  }
  return trace;
}

TEST(Convergence, SettledMeansPreciseAndAtRest) {
  ParameterOptions options;
  options.goal.setConstant(0.0014);  // σ gets there at t = 50 s; the value rests from 30 s on
  const ParameterSet set(softRaven(), "r_l1", options);
  const Convergence found = convergenceOf(fallingTrace(0.0), set, 0);
  ASSERT_TRUE(found.settled);
  EXPECT_NEAR(*found.settled_at, 50.0, 1.0);
  EXPECT_DOUBLE_EQ(found.share, 1.0);
}

TEST(Convergence, ExtrapolatesInformation) {
  ParameterOptions options;
  options.goal.setConstant(0.0005);  // 1 / σ² = 1e4 (1 + t): at t = 399 s
  const ParameterSet set(softRaven(), "r_l1", options);
  const Convergence found = convergenceOf(fallingTrace(0.0), set, 0);
  EXPECT_FALSE(found.settled);
  ASSERT_TRUE(found.time_needed.has_value());
  EXPECT_NEAR(*found.time_needed, 299.0, 3.0);
}

}  // namespace
}  // namespace capstan::identification
