// Cameras whose clock is tens of milliseconds late: the delay acts to more than first order.
#include "core/identification/delay_passes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/identification/matched_recording.h"

namespace capstan::identification {
namespace {

using test::matchedRecording;
using test::softRaven;

constexpr double kLate = 0.08;  // [s]
constexpr CameraPoseOptions kLooseClock = {.delay_sigma = 0.05};
constexpr ModelDiscrepancy kNoDoubt = {.friction_share = 0.0};

/// Of the filter's own model, with stamps late by `delay`.
IdentificationData lateRecording(double delay) {
  const auto robot = softRaven();
  return withExposuresEarlier(matchedRecording(robot, robot, {.duration = 15.0}), -delay);
}

TEST(DelayPasses, ExposuresMoveAndKinematicsWithThem) {
  const auto data = lateRecording(0.0);
  const auto earlier = withExposuresEarlier(data, kLate);
  // The first two pictures, 33 and 66 ms after the first motor sample, were taken before it.
  ASSERT_EQ(earlier.cameras.size(), data.cameras.size() - 2);
  const robot::Transmission transmission(data.robot);
  const robot::ArmKinematics arm(data.robot);
  for (std::size_t i = 0; i < earlier.cameras.size(); ++i) {
    const CameraObservation &now = earlier.cameras[i], &before = data.cameras[i + 2];
    EXPECT_DOUBLE_EQ(now.t, before.t - kLate);
    EXPECT_EQ(now.tip, before.tip);
    const auto at = static_cast<std::size_t>(std::lround(now.t * 1e3));
    EXPECT_LT((now.tip_kin - arm.tip(transmission.jointFromMotor(data.motors.position[at]))).norm(), 1e-9);
  }
}

TEST(DelayPasses, NothingIsObservedInAGapOfTheMotors) {
  auto data = lateRecording(0.0);
  const auto more = data;
  append(data, more);
  const double end = more.motors.t.back();
  for (const CameraObservation& seen : withExposuresEarlier(data, 0.5).cameras)
    EXPECT_TRUE(seen.t <= end || seen.t >= end + 1.0) << seen.t;
}

/// What first order omits of 80 ms stays in the residuals, and bends the estimates of a filter that
/// takes its own errors for noise.
TEST(DelayPasses, BatchFindsALargeDelay) {
  const auto data = lateRecording(kLate);
  const ParameterSet set(data.robot, "r_l");
  const BatchOptions options{.camera = kLooseClock, .discrepancy = kNoDoubt};
  const BatchReport once = identifyBatch(data, set, options),
                    twice = identifyBatchInPasses(data, set, options);
  EXPECT_LT(std::abs(twice.camera.delay - kLate), 4.0 * twice.camera_sigma.delay);
  EXPECT_GT(once.residual_after, 1.5);
  EXPECT_NEAR(twice.residual_after, 1.0, 0.05) << "nothing but noise";
  EXPECT_EQ(twice.residual_before, once.residual_before);
  EXPECT_GT(twice.iterations, once.iterations);
}

TEST(DelayPasses, DualFilterFindsALargeDelay) {
  const auto data = lateRecording(kLate);
  const ParameterSet set(data.robot, "r_l");
  const DualUkfOptions options{.camera = kLooseClock, .discrepancy = kNoDoubt};
  const DualUkfReport once = identifyDualUkf(data, set, options),
                      twice = identifyDualUkfInPasses(data, set, options);
  EXPECT_LT(std::abs(twice.camera.delay - kLate), 4.0 * twice.camera_sigma.delay);
  EXPECT_LT(std::abs(twice.camera.delay - kLate), 0.3 * std::abs(once.camera.delay - kLate));
  EXPECT_LT(twice.nis, once.nis);
}

/// The prior about zero counts once, for the whole delay: of σ after with σ_prior before, a Gaussian estimate
/// loses the share (σ / σ_prior)² of what it would be without.
TEST(DelayPasses, ThePriorStaysThatOfTheWholeDelay) {
  const auto data = lateRecording(kLate);
  const ParameterSet set(data.robot, "r_l");
  const auto with = [&](double prior) {
    return identifyDualUkfInPasses(data, set, {.camera = {.delay_sigma = prior}, .discrepancy = kNoDoubt});
  };
  const DualUkfReport free = with(0.05), held = with(0.0015);
  const double lost = kLate * std::pow(held.delay_noise / 0.0015, 2);
  EXPECT_GT(lost, 3.0 * free.camera_sigma.delay) << "else nothing is tested";
  EXPECT_NEAR(held.camera.delay, free.camera.delay - lost, 0.2 * lost);
}

/// However much the σ that is stated counts: the prior pulls by what the estimate went by.
TEST(DelayPasses, DoubtInTheModelDoesNotPullTheDelay) {
  const auto data = lateRecording(0.03);
  const ParameterSet set(data.robot, "r_l");
  const auto with = [&](const ModelDiscrepancy& discrepancy) {
    return identifyDualUkfInPasses(data, set, {.discrepancy = discrepancy});
  };
  const DualUkfReport sure = with(kNoDoubt), low_confidence = with({});
  EXPECT_GT(low_confidence.camera_sigma.delay, 2.0 * sure.camera_sigma.delay) << "else nothing is tested";
  EXPECT_DOUBLE_EQ(low_confidence.camera.delay, sure.camera.delay);
  EXPECT_NEAR(low_confidence.camera.delay, 0.03, 4.0 * sure.camera_sigma.delay + 1e-4);
}

TEST(DelayPasses, ASmallDelayTakesOnePass) {
  const auto data = lateRecording(0.003);
  const ParameterSet set(data.robot, "r_l");
  const DualUkfOptions options{.camera = kLooseClock, .discrepancy = kNoDoubt};
  const DualUkfReport once = identifyDualUkf(data, set, options),
                      passes = identifyDualUkfInPasses(data, set, options);
  EXPECT_EQ(once.camera.delay, passes.camera.delay);
}

}  // namespace
}  // namespace capstan::identification
