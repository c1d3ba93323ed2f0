#include "core/tracking/transmission_estimator.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/random.h"
#include "tests/core/tracking/transfer_session.h"

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace test;

TEST(TransmissionEstimator, FindsAPulleyThatIsWrongAndBeatsBothInputs) {
  const Session& session = twoMinutes();
  const Tracked six = tracked(session, session.info.robot, FilterKind::kSixState);
  const Tracked augmented = tracked(session, session.info.robot, FilterKind::kAugmented);
  const Vector3d ukf = augmented.report.errors.ukf().value();
  for (int joint = 0; joint < 3; ++joint) {
    EXPECT_LT(ukf(joint), augmented.report.errors.kinematic().value()(joint)) << joint;
    EXPECT_LT(ukf(joint), augmented.report.errors.camera().value()(joint)) << joint;
  }
  EXPECT_LT(ukf(0), 0.2 * six.report.errors.ukf().value()(0));
  const TransmissionEstimate& found = augmented.last.transmission;
  EXPECT_TRUE(found.includesScale(0));
  EXPECT_NEAR(found.scale(0), 0.063095 / 0.059 - 1.0, 0.003);
  for (int joint = 0; joint < 3; ++joint) EXPECT_FALSE(found.includesOffset(joint)) << joint;
  EXPECT_FALSE(found.includesScale(1));
  EXPECT_FALSE(found.includesScale(2));
}

TEST(TransmissionEstimator, ARobotFileThatIsRightIsLeftAlone) {
  const Session& session = twoMinutes();
  const robot::Description robot = withRadius(session.info.robot, 0.059);
  const Tracked six = tracked(session, robot, FilterKind::kSixState);
  const Tracked augmented = tracked(session, robot, FilterKind::kAugmented);
  EXPECT_EQ(augmented.last.transmission.scale, Vector3d::Zero());
  EXPECT_EQ(augmented.last.transmission.offset, Vector3d::Zero());
  for (int joint = 0; joint < 3; ++joint)
    EXPECT_LT(augmented.report.errors.ukf().value()(joint), 1.05 * six.report.errors.ukf().value()(joint))
        << joint;
}

/// More images of the same second do not reduce the uncertainty about an error that lasts for a second.
TEST(TransmissionEstimator, FastCamerasDoNotOverestimateTheInformationAboutSlowErrors) {
  const auto found = [](double rate) {
    const Session session = transfer(120.0, 33, 0.0, rate);
    const Tracked augmented = tracked(session, session.info.robot, FilterKind::kAugmented);
    for (int joint = 0; joint < 3; ++joint) {
      EXPECT_LT(augmented.report.errors.ukf().value()(joint), augmented.report.errors.camera().value()(joint))
          << rate << " " << joint;
      EXPECT_FALSE(augmented.last.transmission.includesOffset(joint)) << rate << " " << joint;
    }
    return augmented.last.transmission;
  };
  const TransmissionEstimate slow = found(15.0), fast = found(90.0);
  EXPECT_NEAR(fast.scale(0), 0.063095 / 0.059 - 1.0, 3.0 * fast.scale_sigma(0));
  EXPECT_GT(fast.scale_sigma(0), 0.5 * slow.scale_sigma(0));
}

TEST(TransmissionEstimator, FindsAHomingOffset) {
  const Session& session = twoMinutes();
  const robot::Description robot = withRadius(session.info.robot, 0.059);
  const double metres = robot.drives[2].motor_capstan_radius / robot.drives[2].gear_ratio;
  const Session off = withMotorOffset(session, {0.0, 0.0, 3e-3 / metres});
  const Tracked augmented = tracked(off, robot, FilterKind::kAugmented);
  ASSERT_TRUE(augmented.last.transmission.includesOffset(2));
  EXPECT_NEAR(augmented.last.transmission.offset(2), -3e-3, 0.3e-3);
  EXPECT_LT(augmented.report.errors.ukf().value()(2), augmented.report.errors.kinematic().value()(2));
}

TEST(TransmissionEstimator, CamerasThatWereMovedAreNoTransmissionError) {
  const Session& session = twoMinutes();
  const robot::Description robot = withRadius(session.info.robot, 0.059);
  const Session moved = withMovedCamera(session, {-0.011, -0.005, 0.002});
  // As long as the arm rests, a pulley that is wrong and a camera that was moved look alike.
  constexpr double kHasMoved = 5.0;  // [s]
  const Tracked six = tracked(session, robot, FilterKind::kSixState, kHasMoved);
  const Tracked augmented = tracked(moved, robot, FilterKind::kAugmented, kHasMoved);
  EXPECT_GT(augmented.last.transmission.camera_moved_probability, 0.99);
  EXPECT_EQ(augmented.last.transmission.scale, Vector3d::Zero());
  EXPECT_EQ(augmented.last.transmission.offset, Vector3d::Zero());
  for (int joint = 0; joint < 3; ++joint)
    EXPECT_LT(augmented.report.errors.ukf().value()(joint), 1.05 * six.report.errors.ukf().value()(joint))
        << joint;
}

TEST(TransmissionEstimator, HoldsThroughOcclusionWithGrowingSigma) {
  for (const double occlusion : {40.0, 80.0}) {
    const Session session = transfer(120.0, 32, occlusion);
    const Tracked augmented = tracked(session, session.info.robot, FilterKind::kAugmented);
    for (int joint = 0; joint < 3; ++joint) {
      const double ukf = augmented.report.errors.ukf().value()(joint);
      EXPECT_LT(ukf, augmented.report.errors.kinematic().value()(joint)) << occlusion << " " << joint;
      EXPECT_LT(ukf, augmented.report.errors.camera().value()(joint)) << occlusion << " " << joint;
    }
  }
  Session blind = twoMinutes();
  std::erase_if(blind.samples, [](const Sample& sample) {
    const auto* tip = std::get_if<TipSample>(&sample);
    return tip && tip->t > 60.0;
  });
  TrackingPipeline pipeline = makePipeline(blind.info, TrackingOptions{});
  ListSource source(blind.samples);
  double early = 0.0, late = 0.0;
  Vector3d held = Vector3d::Zero();
  trackAll(source, pipeline, nullptr, 0.0, [&](const Sample&, const Snapshot& s) {
    // The sigma of a scale counts by the travel from the hard stop, where joint 1 is at zero.
    const double by_travel = s.q_link_ukf_sigma(0) / std::abs(s.q_link_kin(0));
    if (std::abs(s.t - 65.0) < 5e-4) early = by_travel, held = s.transmission.scale;
    if (std::abs(s.t - 115.0) < 5e-4) {
      late = by_travel;
      EXPECT_EQ(s.transmission.scale, held);
    }
  });
  EXPECT_GT(early, 0.0);
  EXPECT_GT(late, early);
}

/// The pulley of joint 1 is 7 % off, which motors alone cannot show.
TEST(TransmissionEstimator, BeforeTheFirstCameraObservationSigmaIncludesWhatTheRobotFileMayHaveWrong) {
  Session session = twoMinutes();
  std::erase_if(session.samples, [](const Sample& sample) {
    const auto* tip = std::get_if<TipSample>(&sample);
    return tip && tip->t < 10.0;
  });
  TrackingPipeline pipeline = makePipeline(session.info, TrackingOptions{});
  ListSource source(session.samples);
  double error = 0.0, most_sigmas = 0.0, nees = 0.0, count = 0.0;
  trackAll(source, pipeline, nullptr, 0.0, [&](const Sample&, const Snapshot& s) {
    if (!s.reference_paired) return;
    nees += s.nees / 3.0, ++count;
    if (s.t < 1.0 || s.t > 9.0) return;
    const double off = std::abs(s.q_link_ukf(0) - s.q_link_true(0));
    error = std::max(error, off);
    most_sigmas = std::max(most_sigmas, off / s.q_link_ukf_sigma(0));
  });
  EXPECT_GT(error, 0.03);
  EXPECT_LT(most_sigmas, 4.0);
  ASSERT_GT(count, 1000.0);
  EXPECT_LT(nees / count, 2.0);
  EXPECT_GT(nees / count, 0.05);
}

}  // namespace
}  // namespace capstan::tracking
