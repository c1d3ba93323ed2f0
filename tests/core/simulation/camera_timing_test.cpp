#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/robot/arm_kinematics.h"
#include "core/simulation/camera_mounting.h"
#include "core/simulation/stereo_cameras.h"
#include "tests/core/simulation/simulated_robot.h"

namespace capstan::simulation {
namespace {

const ToolPose kTool{{-0.12, -0.05, 0.02}, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()};

StereoCameras camerasOf(const CameraTruth& timing, bool images = false, int buffers = 4) {
  Truth truth;
  truth.cameras = timing;
  StereoCameras cameras(testRig(), nominalBaseFromCamera(raven()), {}, truth, images, buffers, 1);
  cameras.setRegistration(nominalBaseFromCamera(raven()));
  return cameras;
}

/// Ellipse centres, not sphere centres, are seen: pixels grow by 1 / (1 − r²/z²), so depth shrinks by r²/z
/// [m].
constexpr double kEllipseShift = 0.005 * 0.005 / 0.5;

/// What arrives in `seconds`, looked for every millisecond.
std::vector<tracking::TipSample> arrivals(StereoCameras& cameras, double seconds) {
  std::vector<tracking::TipSample> all;
  tracking::Sample sample;
  for (int k = 0; k < static_cast<int>(seconds * 1e3); ++k) {
    const double now = 1e-3 * k;
    while (cameras.nextExposure() <= now) cameras.expose({cameras.nextExposure(), {}, kTool, {}});
    while (cameras.deliver(now, sample)) all.push_back(std::get<tracking::TipSample>(sample));
  }
  return all;
}

TEST(CameraTiming, IdealCamerasStampTheExposureAndArriveAtOnce) {
  StereoCameras cameras = camerasOf({});
  const auto all = arrivals(cameras, 2.0);
  ASSERT_EQ(all.size(), 30U);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_NEAR(all[i].t, (static_cast<double>(i) + 0.5) / 15.0, 1e-12);
    EXPECT_EQ(all[i].t_arrival, all[i].t);
    EXPECT_LT((all[i].position - kTool.tip).norm(), kEllipseShift);
  }
}

TEST(CameraTiming, LatencyAndJittersHaveTheirSizes) {
  CameraTruth timing;
  timing.latency = 0.05;
  timing.latency_jitter = 0.004;
  timing.clock_jitter = 0.001;
  timing.stamp_delay = 0.01;
  StereoCameras cameras = camerasOf(timing);
  const auto all = arrivals(cameras, 200.0);
  double late = 0.0, late2 = 0.0, off = 0.0, off2 = 0.0, last = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double exposed = (static_cast<double>(i) + 0.5) / 15.0;
    const double latency = all[i].t_arrival - exposed, error = all[i].t - exposed;
    late += latency;
    late2 += latency * latency;
    off += error;
    off2 += error * error;
    EXPECT_GE(all[i].t_arrival, last);
    EXPECT_GE(all[i].t_arrival, all[i].t);
    last = all[i].t_arrival;
  }
  const auto n = static_cast<double>(all.size());
  EXPECT_GT(n, 2990.0);
  EXPECT_NEAR(late / n, 0.05, 4.0 * 0.004 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(late2 / n - late / n * late / n), 0.004, 0.0003);
  EXPECT_NEAR(off / n, 0.01, 4.0 * 0.001 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(off2 / n - off / n * off / n), 0.001, 0.0001);
}

TEST(CameraTiming, PixelNoiseIsLargestInDepth) {
  CameraTruth timing;
  timing.rate = 100.0;
  timing.pixel_sigma = 0.3;
  StereoCameras cameras = camerasOf(timing);
  const auto all = arrivals(cameras, 20.0);
  Eigen::Vector3d square = Eigen::Vector3d::Zero();
  for (const auto& sample : all) square += (sample.position - kTool.tip).cwiseAbs2();
  const Eigen::Vector3d sigma = (square / static_cast<double>(all.size())).cwiseSqrt();
  // depth is frame 0's y: z² / (f b) times the disparity's noise, sqrt(2) · 0.3 px at 0.5 m
  EXPECT_NEAR(sigma.y(), 0.505 * 0.505 / (650.0 * 0.048) * std::sqrt(2.0) * 0.3, 3e-4);
  EXPECT_LT(sigma.x(), 0.3 * sigma.y());
  EXPECT_LT(sigma.z(), 0.3 * sigma.y());
}

TEST(CameraTiming, ABlockedCameraGivesNoPoint) {
  StereoCameras cameras = camerasOf({});
  tracking::Sample sample;
  cameras.expose({cameras.nextExposure(), {}, kTool, {false, true}});
  ASSERT_TRUE(cameras.deliver(1.0, sample));
  EXPECT_TRUE(std::isnan(std::get<tracking::TipSample>(sample).position.x()));
}

/// The search knows the drawing only: a rig mounted 6 degrees off, whose marker lies outside the region that
/// the drawing gives, registers by the whole picture, and one that cannot see the marker does not register.
TEST(CameraTiming, RegistrationSearchesWhereTheDrawingSays) {
  const Eigen::Isometry3d nominal = nominalBaseFromCamera(raven());
  const ToolPose stop{robot::ArmKinematics(raven()).tip(robot::homingOf(raven())), Eigen::Vector3d::Zero(),
                      Eigen::Vector3d::UnitX()};
  for (const double degrees : {0.0, 6.0, 60.0}) {
    Eigen::Isometry3d mounted = nominal;
    mounted.rotate(Eigen::AngleAxisd(base::toRadians(degrees), Eigen::Vector3d::UnitY()));
    StereoCameras cameras(testRig(), mounted, {}, Truth{}, true, 4, 1);
    if (degrees > 45.0) {
      EXPECT_THROW((void)cameras.registerAtRest(stop, nominal, stop.tip, 5), base::InputError);
      continue;
    }
    const Eigen::Isometry3d found = cameras.registerAtRest(stop, nominal, stop.tip, 5);
    EXPECT_EQ(found.linear(), nominal.linear());
    const Eigen::Vector3d seen = mounted.inverse() * stop.tip;
    EXPECT_LT((found * seen - stop.tip).norm(), 2e-3) << degrees;
  }
}

TEST(CameraTiming, PicturesThatAreHeldAreNotDrawnOver) {
  StereoCameras cameras = camerasOf({}, true, 2);
  std::vector<tracking::StereoFrame> held;
  std::vector<cv::Mat> copies;
  tracking::Sample sample;
  for (int i = 0; i < 5; ++i) {
    ToolPose tool = kTool;
    tool.tip.z() += 0.01 * i;
    cameras.expose({cameras.nextExposure(), {}, tool, {}});
    ASSERT_TRUE(cameras.deliver(10.0, sample));
    held.push_back(std::get<tracking::StereoFrame>(sample));
    copies.push_back(held.back().left.clone());
  }
  for (std::size_t i = 0; i < held.size(); ++i)
    EXPECT_EQ(cv::norm(held[i].left, copies[i], cv::NORM_INF), 0.0);
}

TEST(CameraTiming, PicturesThatAreGivenBackAreUsedAgain) {
  StereoCameras cameras = camerasOf({}, true, 2);
  std::vector<const void*> places;
  for (int i = 0; i < 6; ++i) {
    tracking::Sample sample;
    cameras.expose({cameras.nextExposure(), {}, kTool, {}});
    ASSERT_TRUE(cameras.deliver(10.0, sample));
    places.push_back(std::get<tracking::StereoFrame>(sample).left.data);
  }
  for (std::size_t i = 2; i < places.size(); ++i) EXPECT_EQ(places[i], places[i - 2]);
}

}  // namespace
}  // namespace capstan::simulation
