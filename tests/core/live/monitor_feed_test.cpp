// What stereo monitors get from a session: the simulated robot, tracked and occluded.
#include "core/live/monitor_feed.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <thread>

#include "core/live/feed/feed_clock.h"
#include "core/live/feed/feed_reader.h"
#include "core/live/recent_estimates.h"
#include "core/robot/arm_kinematics.h"
#include "core/simulation/simulation_request.h"
#include "core/tracking/make_pipeline.h"
#include "tests/core/live/feed_child.h"

namespace capstan::live {
namespace {

using testing::feedNamed;

/// A simulated session step by step, and what a monitor reads of it.
class Watched {
 public:
  explicit Watched(MonitorFeed& feed)
      : source_(simulation::optionsOf({})),
        pipeline_(tracking::makePipeline(source_.info())),
        reader_(feed.name()),
        listener_(feed.begin(source_.info())) {
    listener_.begin(pipeline_);
  }

  /// Runs to session time `end` [s]. Counts the pairs of images that were read.
  void runTo(double end) {
    tracking::Sample sample;
    while (time_ < end && source_.next(sample)) {
      const bool images = std::holds_alternative<tracking::StereoFrame>(sample);
      if (images) std::this_thread::sleep_for(std::chrono::milliseconds(11));  // the feed's least period
      const tracking::Snapshot& snapshot = pipeline_.step(sample);
      time_ = snapshot.t;
      if (const auto* joints = std::get_if<tracking::JointSample>(&sample)) truth_ = joints->position;
      listener_.take(sample, snapshot);
      if (!images || !reader_.read(frame, feedNow())) continue;
      ++pairs;
      newest = std::get<tracking::StereoFrame>(sample);
    }
  }
  double markerRadius() const { return pipeline_.robot().marker_radius; }  // [m]
  void block(bool blocked) { source_.block(blocked, blocked); }

  /// Distance from the drawn tip to where the true joints project, at most by a frame's motion apart [px].
  double tipError(std::size_t side) const {
    const robot::ArmKinematics arm(pipeline_.robot());
    const Eigen::Isometry3d left_from_base = pipeline_.registration()->inverse();
    const auto& rig = *pipeline_.rig();
    const auto pixel = side == 0 ? rig.left.project(left_from_base * arm.tip(truth_))
                                 : rig.right.project(rig.right_from_left * left_from_base * arm.tip(truth_));
    const auto& tip = frame.state.eyes[side].tip;
    return (*pixel - Eigen::Vector2d(tip[0], tip[1])).norm();
  }

  FeedFrame frame;
  tracking::StereoFrame newest;
  int pairs = 0;

 private:
  simulation::SimulatedSource source_;
  tracking::TrackingPipeline pipeline_;
  FeedReader reader_;
  Listener listener_;
  Eigen::Vector3d truth_ = Eigen::Vector3d::Zero();
  double time_ = 0.0;
};

TEST(MonitorFeed, ShowsTheImagesWithTheArmWhereTheMarkerIs) {
  MonitorFeed feed(feedNamed("tracked"));
  Watched watched(feed);
  watched.runTo(3.0);
  EXPECT_NEAR(watched.pairs, 45, 3) << "15 pairs a second";
  const FeedState& state = watched.frame.state;
  EXPECT_EQ(state.session, 1U);
  EXPECT_EQ(state.tracking, FeedTracking::kTracking);
  EXPECT_EQ(state.uncertain_for, 0.0);
  EXPECT_EQ(textOf(state.joints[2]), "insertion");
  EXPECT_EQ(state.t_cam, watched.newest.t);
  EXPECT_EQ(cv::norm(watched.frame.images[0], watched.newest.left, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(watched.frame.images[1], watched.newest.right, cv::NORM_INF), 0.0);
  for (std::size_t side = 0; side < 2; ++side) {
    const FeedEye& eye = state.eyes[side];
    ASSERT_TRUE(eye.marker_found && eye.tip_found);
    EXPECT_GT(eye.shaft_points, 5);
    EXPECT_LT(std::hypot(eye.circle[0] - eye.tip[0], eye.circle[1] - eye.tip[1]), 6.0)
        << "the estimate lies on what was detected in the image";
    EXPECT_NEAR(eye.circle[2], eye.tip[2], 1.5);
  }
}

TEST(MonitorFeed, ShowsTheArmWithItsUncertaintyWhileTheMarkerIsHidden) {
  MonitorFeed feed(feedNamed("occluded"));
  Watched watched(feed);
  watched.runTo(3.0);
  watched.block(true);
  watched.runTo(5.0);
  const FeedState& state = watched.frame.state;
  EXPECT_EQ(state.tracking, FeedTracking::kOccluded);
  EXPECT_NEAR(state.uncertain_for, 2.0, 0.2);
  EXPECT_EQ(textOf(state.words), "both lost");
  for (std::size_t side = 0; side < 2; ++side) {
    const FeedEye& eye = state.eyes[side];
    EXPECT_FALSE(eye.marker_found);
    ASSERT_TRUE(eye.tip_found);
    const double pixels_per_metre = eye.tip[2] / watched.markerRadius();
    EXPECT_GT(eye.ellipse[0], 0.0);
    EXPECT_LE(eye.ellipse[0], 1.1 * 2.0 * pixels_per_metre *
                                  Eigen::Map<const Eigen::Vector3d>(state.tip_sigma.data()).norm());
    EXPECT_LT(watched.tipError(side), 6.0);
  }
  watched.block(false);
  watched.runTo(5.5);
  EXPECT_EQ(watched.frame.state.tracking, FeedTracking::kTracking);
}

TEST(MonitorFeed, ASessionThatWasLeftPublishesNothingMore) {
  MonitorFeed feed(feedNamed("left"));
  Watched former(feed);
  former.runTo(0.5);
  EXPECT_GT(former.pairs, 0);
  Watched next(feed);
  next.runTo(0.5);
  EXPECT_EQ(next.frame.state.session, 2U);
  const int before = former.pairs;
  former.runTo(1.0);
  EXPECT_EQ(former.pairs, before + 1) << "the last pair of the other session, read late";
  EXPECT_EQ(former.frame.state.session, 2U);
}

TEST(MonitorFeed, TakesTheNextNameWhereASessionRuns) {
  const auto first = makeMonitorFeed(), second = makeMonitorFeed();
  EXPECT_NE(first->name(), second->name());
  EXPECT_EQ(second->name().rfind(kFeedName, 0), 0U) << second->name();
}

TEST(RecentEstimates, AreThoseOfTheTimeOfExposure) {
  RecentEstimates recent;
  EXPECT_EQ(recent.at(1.0), nullptr);
  EXPECT_EQ(recent.newest(), nullptr);
  tracking::Snapshot snapshot{};
  snapshot.q_link_ukf = snapshot.tip_ukf = Eigen::Vector3d::Zero();
  snapshot.tip_ukf_covariance = Eigen::Matrix3d::Zero();
  for (int i = 1; i <= 1000; ++i) {
    snapshot.t = 1e-3 * i;
    recent.add(snapshot);
  }
  EXPECT_EQ(recent.newest()->t, 1e-3 * 1000);
  EXPECT_EQ(recent.at(1e-3 * 950)->t, 1e-3 * 950);
  EXPECT_EQ(recent.at(0.9504)->t, 1e-3 * 950) << "the newest before it";
  EXPECT_EQ(recent.at(2.0)->t, 1e-3 * 1000);
  EXPECT_EQ(recent.at(0.1)->t, 1e-3 * 489) << "older ones are gone: the oldest";
}

}  // namespace
}  // namespace capstan::live
