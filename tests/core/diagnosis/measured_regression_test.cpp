// Least squares on measured columns, on an encoder that is a sum of them: what is left is its noise.
#include "core/diagnosis/selection/measured_regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/base/random.h"
#include "tests/core/diagnosis/planted_evidence.h"
#include "tests/core/diagnosis/synthetic.h"
#include "tests/support/folders.h"

namespace capstan::diagnosis {
namespace {

constexpr double kNoise = 1e-4;             // [rad]
constexpr double kPerMotor = 1e-3;          // b [rad/rad]
constexpr double kPerLoad = 10.0 * kNoise;  // c [rad/(N·m)], of loads up to 1 N·m
constexpr int kJoint = 2;

/// The elbow's encoder of a RAVEN-II's recording replaced by zero + b q_m + c load + white noise.
Evidence elbow(double zero, std::uint64_t seed) {
  Evidence evidence = Planted(1).evidence.front();
  base::Random random(seed, "elbow");
  evidence.tau_ext.clear();
  for (int j = 0; j < evidence.joints; ++j) {
    const auto load = multisine(random);
    std::vector<double>& column = evidence.tau_ext.emplace_back();
    for (const double t : evidence.t) column.push_back(load(t));
  }
  for (std::size_t k = 0; k < evidence.rows(); ++k)
    evidence.q[kJoint - 1][k] = zero + kPerMotor * evidence.q_m[kJoint - 1][k] +
                                kPerLoad * evidence.tau_ext[kJoint - 1][k] + random.normal(0.0, kNoise);
  return evidence;
}

double meanSquareOf(const std::vector<double>& column) {
  double sum = 0.0;
  for (const double x : column) sum += x * x;
  return sum / static_cast<double>(column.size());
}

TEST(MeasuredRegression, LeavesTheNoiseOfASumOfItsColumns) {
  const std::vector<Evidence> evidence{elbow(0.3, 1)};
  const FitData data(evidence, raven(), 0.0, EncoderZeros::kKnown, 1);
  const MeasuredRegression found = measuredRegression(data, kJoint);
  EXPECT_NEAR(found.mean_square, kNoise * kNoise, 0.15 * kNoise * kNoise)
      << "some 1200 samples: 4 % each sigma";
  ASSERT_GE(found.columns.size(), 4U);
  EXPECT_LT(found.columns.size(), static_cast<std::size_t>(kMostColumns)) << "the constant is one of them";
  EXPECT_EQ(found.columns[0], "q_m2") << "its own motor comes first";
  EXPECT_EQ(found.columns[1], "q_m1");
  EXPECT_EQ(found.columns[2], "q_m3");
  EXPECT_EQ(found.columns[3], "tau_ext2");
}

TEST(MeasuredRegression, LeavesMoreWhereAColumnIsNotMeasured) {
  std::vector<Evidence> evidence{elbow(0.3, 1)};
  const double by_load = kPerLoad * kPerLoad * meanSquareOf(evidence.front().tau_ext[kJoint - 1]);
  evidence.front().tau_ext.clear();
  const FitData data(evidence, raven(), 0.0, EncoderZeros::kKnown, 1);
  const MeasuredRegression found = measuredRegression(data, kJoint);
  EXPECT_GT(found.mean_square, kNoise * kNoise + 0.3 * by_load);
  for (const std::string& column : found.columns) EXPECT_EQ(column.find("tau_ext"), std::string::npos);
}

TEST(MeasuredRegression, HasAConstantForEachRecordingWhoseZeroIsFree) {
  const std::vector<Evidence> evidence{elbow(0.3, 1), elbow(0.34, 2)};
  const FitData each(evidence, raven(), 0.0, EncoderZeros::kOnePerRecording, 1),
      known(evidence, raven(), 0.0, EncoderZeros::kKnown, 1);
  EXPECT_NEAR(measuredRegression(each, kJoint).mean_square, kNoise * kNoise, 0.12 * kNoise * kNoise);
  EXPECT_GT(measuredRegression(known, kJoint).mean_square, 100.0 * kNoise * kNoise) << "zeros 0.04 rad apart";
}

/// Folds are whole recordings then, of which the other folds do not know the zero.
TEST(MeasuredRegression, HasAConstantForEachRecordingThatIsHeldOut) {
  std::vector<Evidence> evidence;
  for (int k = 0; k < kWholeFolds; ++k)
    evidence.push_back(elbow(0.3 + 0.04 * k, static_cast<std::uint64_t>(k + 1)));
  const FitData data(evidence, raven(), 0.0, EncoderZeros::kOnePerRecording, 1);
  const MeasuredRegression found = measuredRegression(data, kJoint);
  EXPECT_NEAR(found.mean_square, kNoise * kNoise, 0.12 * kNoise * kNoise);
}

TEST(MeasuredRegression, RigidDrivesHaveNone) {
  test::DrawOptions options;
  options.robot = robot::readDescription(test::sourceFile("tests/support/planted/data/rigid_axis.yaml"));
  options.rigid = true;
  options.effects = 0;
  options.duration = 8.0;
  const std::vector<Evidence> evidence{evidenceOf(test::record(test::draw(5, options)).table, options.robot)};
  const FitData data(evidence, options.robot, 2.0, EncoderZeros::kKnown, 1);
  const MeasuredRegression found = measuredRegression(data, 1);
  EXPECT_TRUE(std::isnan(found.mean_square));
  EXPECT_TRUE(found.columns.empty());
}

}  // namespace
}  // namespace capstan::diagnosis
