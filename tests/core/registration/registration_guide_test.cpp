#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/widgets/registration_feed.h"

namespace capstan::registration {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

class Guide : public testing::Test {
 protected:
  /// The nominal mounting: the truth but for its translation.
  Eigen::Isometry3d nominal() const { return test::cameraBefore(feed.arm.tip(feed.stop)); }
  void arrive() {
    guide.start(nominal());
    feed.run(guide, 1.0);
    ASSERT_TRUE(guide.arrival().arrived);
    ASSERT_TRUE(guide.collect());
  }

  test::RegistrationFeed feed;
  RegistrationGuide guide{feed.robot};
};

TEST_F(Guide, FindsTheTranslationWithinItsOwnBounds) {
  arrive();
  feed.run(guide, 5.0);
  ASSERT_EQ(guide.step(), RegistrationStep::kReview) << guide.reason();
  const auto& proposal = *guide.proposal();
  EXPECT_EQ(proposal.registration.frames, 60);
  const Vector3d error = proposal.registration.base_from_camera.translation() - feed.truth.translation();
  // Camera x, y, z are −z, −x, +y of frame 0: depth noise lies along y. Four standard errors of 60 points.
  EXPECT_LT(std::abs(error.y()), 4.0 * 8e-4 / std::sqrt(60.0));
  EXPECT_LT(std::abs(error.x()), 4.0 * 1e-4 / std::sqrt(60.0));
  EXPECT_NEAR(proposal.half_width.y(), 1.96 * 8e-4 / std::sqrt(60.0), 0.3 * 1.96 * 8e-4 / std::sqrt(60.0));
  EXPECT_GT(proposal.half_width.y(), 4.0 * proposal.half_width.x());
  EXPECT_LT((proposal.shift - Vector3d(0.004, -0.007, 0.003)).norm(), 5e-4)
      << "what the nominal mounting was off by";
  EXPECT_TRUE(proposal.registration.base_from_camera.linear().isApprox(nominal().linear(), 1e-12));
  guide.accept();
  EXPECT_EQ(guide.step(), RegistrationStep::kAccepted);
}

TEST_F(Guide, ArrivalNeedsEveryJointAndRest) {
  feed.q = feed.stop - Vector3d(0.5, 0.0, 0.0);
  guide.start(nominal());
  feed.run(guide, 1.0);
  EXPECT_FALSE(guide.arrival().arrived);
  EXPECT_FALSE(guide.arrival().near[0]);
  EXPECT_TRUE(guide.arrival().near[1]);
  EXPECT_FALSE(guide.collect());
  EXPECT_NEAR(guide.arrival().distance.x(), -0.5, 1e-12);
  feed.drift = Vector3d(0.5, 0.0, 0.0);
  feed.run(guide, 1.0);
  feed.drift.setZero();
  feed.run(guide, 0.3);
  EXPECT_TRUE(guide.arrival().near[0]);
  EXPECT_FALSE(guide.arrival().arrived) << "not yet at rest for half a second";
  feed.run(guide, 0.3);
  EXPECT_TRUE(guide.arrival().arrived);
}

TEST_F(Guide, RefusesAMovingArm) {
  arrive();
  feed.run(guide, 1.0);
  feed.drift = Vector3d(0.0, -0.01, 0.0);
  feed.run(guide, 1.0);
  EXPECT_EQ(guide.step(), RegistrationStep::kRefused);
  EXPECT_EQ(guide.fault(), RegistrationFault::kArmMoved);
  EXPECT_THAT(guide.reason(), HasSubstr(feed.robot.joints[1].name + " moved by 0.10 deg"));
  EXPECT_FALSE(guide.advice().empty());
  feed.drift.setZero();
  feed.run(guide, 1.0);
  EXPECT_TRUE(guide.collect()) << "again, once it rests";
}

TEST_F(Guide, RefusesTooFewDetectionsAndSaysWhichCameraAndWhy) {
  arrive();
  feed.run(guide, 1.0);
  feed.fault = vision::MarkerFault::kTwoCandidates;
  feed.run(guide, 4.0);
  EXPECT_EQ(guide.fault(), RegistrationFault::kTooFewDetections);
  EXPECT_THAT(guide.reason(), HasSubstr("of 60 frames"));
  EXPECT_THAT(guide.reason(), HasSubstr("left: two candidates"));
  EXPECT_THAT(guide.advice(), HasSubstr("marker's colour"));
  EXPECT_FALSE(guide.proposal());
}

/// What both detectors see of the marker at the stop; `exchanged`: the left image as the right one, else one
/// row of one image lies lower by `lower` [px].
tracking::Snapshot detected(test::RegistrationFeed& feed, bool exchanged, double lower) {
  tracking::Snapshot snapshot = feed.next();
  snapshot.tip_in_camera.setConstant(std::numeric_limits<double>::quiet_NaN());
  const auto rig = test::stereoRig();
  const Vector3d tip = feed.truth.inverse() * feed.arm.tip(feed.q);
  std::array pixels = {*rig.left.project(tip), *rig.right.project(rig.right_from_left * tip)};
  if (exchanged) std::swap(pixels[0], pixels[1]);
  pixels[0].y() += lower;
  for (std::size_t side = 0; side < 2; ++side) {
    snapshot.marker[side].fault = vision::MarkerFault::kNone;
    snapshot.marker[side].centroid = pixels[side];
  }
  return snapshot;
}

TEST_F(Guide, NamesExchangedCamerasAsTheCause) {
  RegistrationGuide with_rig(feed.robot, test::stereoRig());
  with_rig.start(nominal());
  feed.run(with_rig, 1.0);
  ASSERT_TRUE(with_rig.collect());
  for (int i = 0; i < 5000; ++i) with_rig.observe(detected(feed, true, 0.0));
  EXPECT_EQ(with_rig.step(), RegistrationStep::kRefused);
  EXPECT_EQ(with_rig.fault(), RegistrationFault::kCamerasExchanged) << with_rig.reason();
  EXPECT_THAT(with_rig.reason(), HasSubstr("60 of 60 frames"));
  EXPECT_THAT(with_rig.advice(), HasSubstr("the left and the right stream are exchanged"));
}

TEST_F(Guide, ViewsThatDisagreeAreNoExchange) {
  RegistrationGuide with_rig(feed.robot, test::stereoRig());
  with_rig.start(nominal());
  feed.run(with_rig, 1.0);
  ASSERT_TRUE(with_rig.collect());
  for (int i = 0; i < 5000; ++i) with_rig.observe(detected(feed, false, 12.0));
  EXPECT_EQ(with_rig.fault(), RegistrationFault::kViewsDisagree) << with_rig.reason();
  EXPECT_THAT(with_rig.advice(), HasSubstr("camera files"));
}

TEST_F(Guide, RefusesTooLargeAScatterWithAxisAndNumbers) {
  feed.noise.z() = 0.012;
  arrive();
  feed.run(guide, 6.0);
  EXPECT_EQ(guide.fault(), RegistrationFault::kScatterTooLarge);
  EXPECT_THAT(guide.reason(), HasSubstr("along camera z; at most 6.00 mm is allowed"));
}

TEST_F(Guide, RejectsOutliersAndNamesTheirAxis) {
  feed.outlier_every = 10;
  arrive();
  feed.run(guide, 6.0);
  ASSERT_EQ(guide.step(), RegistrationStep::kReview) << guide.reason();
  int far = 0;
  for (const auto& point : guide.points()) {
    const bool shifted = point.position.z() - guide.scatter().median.z() > 0.03;
    far += shifted;
    if (!shifted) continue;
    EXPECT_EQ(point.verdict, PointVerdict::kOutlier);
    EXPECT_EQ(point.axis, 2);
    EXPECT_GT(point.excess, 20.0);
  }
  EXPECT_GE(far, 6);
  const Vector3d error =
      guide.proposal()->registration.base_from_camera.translation() - feed.truth.translation();
  EXPECT_LT(error.norm(), 6e-4) << "a mean with the outliers in it would be 5 mm off";
}

TEST_F(Guide, NeedsAKnownRotation) {
  guide.start(std::nullopt);
  EXPECT_EQ(guide.fault(), RegistrationFault::kNoRotation);
  feed.run(guide, 1.0);
  EXPECT_FALSE(guide.collect());
}

TEST_F(Guide, UserMayVouchForAnotherPlace) {
  feed.q = feed.stop - Vector3d(0.6, 0.4, 0.1);
  guide.start(nominal());
  feed.run(guide, 1.0);
  EXPECT_FALSE(guide.canCollect());
  guide.overrideStop(true);
  ASSERT_TRUE(guide.collect());
  feed.run(guide, 5.0);
  ASSERT_EQ(guide.step(), RegistrationStep::kReview);
  const Vector3d error =
      guide.proposal()->registration.base_from_camera.translation() - feed.truth.translation();
  EXPECT_LT(error.norm(), 6e-4) << "the marker's place follows the encoders";
}

TEST_F(Guide, PointsFromBeforeTheRestDoNotCount) {
  guide.start(nominal());
  feed.q = feed.stop - Vector3d(0.02, 0.0, 0.0);
  feed.drift = Vector3d(0.02, 0.0, 0.0);
  feed.run(guide, 1.0);
  feed.drift.setZero();
  feed.run(guide, 0.7);
  const double since = guide.arrival().rest;
  ASSERT_TRUE(guide.collect());
  auto late = feed.next();
  late.camera_updated = true;
  late.tip_in_camera = Vector3d(0, 0, 0.5);
  for (auto& marker : late.marker) marker.fault = vision::MarkerFault::kNone;
  late.t_cam = late.t - since - 0.1;
  guide.observe(late);
  EXPECT_EQ(guide.framesSeen(), 0) << "exposed while the arm still moved";
  late.t_cam = late.t;
  guide.observe(late);
  EXPECT_EQ(guide.framesSeen(), 1);
}

TEST_F(Guide, RejectionKeepsItsReason) {
  arrive();
  feed.run(guide, 5.0);
  guide.reject("overlay does not lie on the arm");
  EXPECT_EQ(guide.step(), RegistrationStep::kRejected);
  EXPECT_EQ(guide.reason(), "overlay does not lie on the arm");
  guide.accept();
  EXPECT_EQ(guide.step(), RegistrationStep::kRejected) << "a rejected result cannot be accepted any more";
}

}  // namespace
}  // namespace capstan::registration
