#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/tracking/transmission_estimator.h"
#include "tests/core/tracking/transfer_session.h"

namespace capstan::tracking {
namespace {

using Eigen::Vector3d;
using namespace test;

constexpr double kHalfTime = 60.0;  // [s]

/// Everything but pulley 1 is as the robot file says; so is that one.
robot::Description rightRobot() { return withRadius(twoMinutes().info.robot, 0.059); }

Session shiftedAtHalfTime(double metres) {
  Session session = twoMinutes();
  for (Sample& sample : session.samples)
    if (auto* tip = std::get_if<TipSample>(&sample); tip && tip->t >= kHalfTime)
      tip->position += metres * Vector3d(-0.9, -0.4, 0.17);
  return session;
}

Session slippedAtHalfTime(int motor, double radians) {
  Session session = twoMinutes();
  for (Sample& sample : session.samples)
    if (auto* turned = std::get_if<MotorSample>(&sample); turned && turned->t >= kHalfTime)
      turned->position(motor) += radians;
  return session;
}

void expectAsGoodAs(const Tracked& one, const Tracked& other, double factor, const std::string& what) {
  for (int joint = 0; joint < 3; ++joint)
    EXPECT_LT(one.report.errors.ukf().value()(joint), factor * other.report.errors.ukf().value()(joint))
        << what << ", joint " << joint + 1;
}

TEST(TransmissionChanges, CamerasThatAreKnockedMoveNoJoint) {
  const Tracked undisturbed = tracked(twoMinutes(), rightRobot(), FilterKind::kSixState);
  for (const double millimetres : {3.0, 12.0}) {
    const Tracked knocked =
        tracked(shiftedAtHalfTime(1e-3 * millimetres), rightRobot(), FilterKind::kAugmented);
    expectAsGoodAs(knocked, undisturbed, 1.25, std::to_string(millimetres) + " mm");
    EXPECT_EQ(knocked.last.transmission.scale, Vector3d::Zero());
  }
}

TEST(TransmissionChanges, AnEncoderThatSlipsIsFound) {
  const robot::Description robot = rightRobot();
  const Session slipped = slippedAtHalfTime(2, 2.0);
  const double metres = 2.0 * robot.drives[2].motor_capstan_radius / robot.drives[2].gear_ratio;
  const Tracked six = tracked(slipped, robot, FilterKind::kSixState, 90.0);
  const Tracked augmented = tracked(slipped, robot, FilterKind::kAugmented, 90.0);
  ASSERT_TRUE(augmented.last.transmission.includesOffset(2));
  EXPECT_NEAR(augmented.last.transmission.offset(2), -metres, 0.3 * metres);
  EXPECT_LT(augmented.report.errors.ukf().value()(2), 0.4 * six.report.errors.ukf().value()(2));
}

TEST(TransmissionChanges, AStiffnessThatIsWrongIsNoPulleyError) {
  for (std::size_t joint = 0; joint < 3; ++joint)
    for (const double factor : {0.1, 0.3, 3.0}) {
      robot::Description robot = rightRobot();
      robot.drives[joint].cable_stiffness *= factor;
      const Tracked six = tracked(twoMinutes(), robot, FilterKind::kSixState);
      const Tracked augmented = tracked(twoMinutes(), robot, FilterKind::kAugmented);
      const std::string what = "cable " + std::to_string(joint + 1) + " x" + std::to_string(factor);
      expectAsGoodAs(augmented, six, 1.1, what);
      EXPECT_EQ(augmented.last.transmission.scale, Vector3d::Zero()) << what;
    }
}

TEST(TransmissionChanges, AnOutageForgetsNothing) {
  Session session = twoMinutes();
  for (Sample& sample : session.samples)
    if (auto* tip = std::get_if<TipSample>(&sample); tip && tip->t > 40.0 && tip->t < 100.0)
      tip->position.setConstant(std::nan(""));
  TrackingPipeline pipeline = makePipeline(session.info, TrackingOptions{});
  ListSource source(session.samples);
  double before = 0.0, after = 0.0;
  trackAll(source, pipeline, nullptr, 0.0, [&](const Sample&, const Snapshot& s) {
    if (s.t < 40.0) before = s.transmission.scale(0);
    if (s.t < 101.0) after = s.transmission.scale(0);
  });
  EXPECT_NEAR(before, 0.063095 / 0.059 - 1.0, 0.004);
  EXPECT_NEAR(after, before, 0.002);
}

TEST(TransmissionChanges, StampsThatAreLateAreTakenBack) {
  constexpr double kLate = 0.06;  // [s]
  Session session = twoMinutes();
  for (Sample& sample : session.samples)
    if (auto* tip = std::get_if<TipSample>(&sample)) tip->t += kLate;
  const Tracked in_time = tracked(twoMinutes(), rightRobot(), FilterKind::kSixState, 20.0);
  const Tracked late = tracked(session, rightRobot(), FilterKind::kAugmented, 20.0);
  EXPECT_NEAR(late.last.transmission.camera_delay, kLate, 4e-3);
  expectAsGoodAs(late, in_time, 1.25, "late");
}

TEST(TransmissionChanges, AfterTheClockIsSetBackLearningGoesOn) {
  const Session& session = twoMinutes();
  TrackingPipeline pipeline = makePipeline(session.info, TrackingOptions{});
  Vector3d first = Vector3d::Zero();
  double sigma = 0.0;
  for (const bool again : {false, true}) {
    ListSource source(session.samples);
    trackAll(source, pipeline, nullptr, 0.0, [&](const Sample&, const Snapshot& s) {
      if (again && s.t > 1.0 && s.t < 1.1 && s.motor_updated) {
        EXPECT_NEAR(s.transmission.scale(0), first(0), 1e-3) << "what was learned stays";
      }
    });
    const TransmissionEstimate& found = pipeline.snapshot().transmission;
    if (again) {
      EXPECT_LT(found.scale_sigma(0), sigma) << "and more is learned";
    }
    first = found.scale;
    sigma = found.scale_sigma(0);
  }
}

TEST(TransmissionChanges, ANewRegistrationKeepsWhatMotorsTaught) {
  const Session& session = twoMinutes();
  TrackingPipeline pipeline = makePipeline(session.info, TrackingOptions{});
  Eigen::Isometry3d registered = Eigen::Isometry3d::Identity();
  pipeline.setRegistration(registered);
  ListSource source(session.samples);
  bool anew = false;
  Vector3d before = Vector3d::Zero(), jump = Vector3d::Zero();
  trackAll(source, pipeline, nullptr, 0.0, [&](const Sample&, const Snapshot& s) {
    if (anew && jump.isZero() && s.motor_updated) jump = s.q_link_ukf - before;
    before = s.q_link_ukf;
    if (anew || s.t < kHalfTime || !s.motor_updated) return;
    anew = true;
    registered.translation().x() = 1e-3;
    pipeline.setRegistration(registered);
    EXPECT_NEAR(pipeline.snapshot().transmission.scale(0), 0.063095 / 0.059 - 1.0, 0.004);
  });
  ASSERT_TRUE(anew);
  EXPECT_LT(jump.cwiseAbs().maxCoeff(), 5e-3);
  EXPECT_TRUE(pipeline.snapshot().transmission.includesScale(0));
}

/// A joint whose encoder failed is seen by the camera alone: by one whose error is known.
TEST(TransmissionChanges, WithAFailedMotorTheCamerasErrorIsStillTakenOut) {
  const auto error = [](const Session& session) {
    tracking::SourceInfo info = session.info;
    info.robot = rightRobot();
    TrackingPipeline pipeline = makePipeline(info, TrackingOptions{});
    ListSource source(session.samples);
    TrackReport report;
    bool failed = false;
    trackAll(source, pipeline, nullptr, 0.0, [&](const Sample&, const Snapshot& s) {
      if (s.t >= kHalfTime + 5.0) report.add(s);
      if (s.t >= kHalfTime && !failed) pipeline.setMotorFailed(1, failed = true);
    });
    return report.errors.ukf().value()(1);
  };
  const double right = error(twoMinutes());
  EXPECT_LT(error(withMovedCamera(twoMinutes(), {-0.011, -0.005, 0.002})), right + 0.3 * EIGEN_PI / 180.0);
}

}  // namespace
}  // namespace capstan::tracking
