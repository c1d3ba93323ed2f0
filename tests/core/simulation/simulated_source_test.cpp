#include "core/simulation/simulated_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/base/error.h"
#include "core/robot/arm_dynamics.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/transmission.h"
#include "core/simulation/camera_mounting.h"
#include "core/vision/marker_detector.h"
#include "tests/core/simulation/simulated_robot.h"

namespace capstan::simulation {
namespace {

SimulatedOptions cameraOptions(double duration, bool images) {
  SimulatedOptions options;
  options.robot = raven();
  options.trajectory.duration = duration;
  options.rig = testRig();
  options.images = images;
  options.registration_frames = 10;
  return options;
}

class Hash {
 public:
  void add(const void* data, std::size_t bytes) {
    const auto* at = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < bytes; ++i) value_ = (value_ ^ at[i]) * 0x100000001b3ULL;
  }
  void add(double value) { add(&value, sizeof value); }
  void add(const Eigen::Vector3d& value) { add(value.data(), sizeof(double) * 3); }
  void add(const cv::Mat& image) { add(image.data, image.total() * image.elemSize()); }
  void add(const tracking::MotorSample& s) { add(s.t), add(s.position), add(s.velocity), add(s.torque); }
  void add(const tracking::JointSample& s) { add(s.t), add(s.position); }
  void add(const tracking::TipSample& s) { add(s.t), add(s.t_arrival), add(s.position); }
  void add(const tracking::StereoFrame& s) { add(s.t), add(s.t_arrival), add(s.left), add(s.right); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

std::uint64_t hashOf(const SimulatedOptions& options) {
  SimulatedSource source(options);
  Hash hash;
  tracking::Sample sample;
  while (source.next(sample)) std::visit([&](const auto& s) { hash.add(s); }, sample);
  return hash.value();
}

double arrivalOf(const tracking::Sample& sample) {
  if (const auto* frame = std::get_if<tracking::StereoFrame>(&sample)) return frame->t_arrival;
  if (const auto* tip = std::get_if<tracking::TipSample>(&sample)) return tip->t_arrival;
  if (const auto* motor = std::get_if<tracking::MotorSample>(&sample)) return motor->t;
  return std::get<tracking::JointSample>(sample).t;
}

TEST(SimulatedSource, SameSeedSameBytesOfSamplesAndPictures) {
  const SimulatedOptions options = cameraOptions(1.5, true);
  SimulatedOptions other = options;
  other.seed = 2;
  EXPECT_EQ(hashOf(options), hashOf(options));
  EXPECT_NE(hashOf(options), hashOf(other));
}

TEST(SimulatedSource, YieldsEverySampleInOrderOfArrival) {
  SimulatedSource source(cameraOptions(10.0, false));
  tracking::Sample sample;
  int motors = 0, joints = 0, tips = 0;
  double last = -1.0;
  while (source.next(sample)) {
    const double arrival = arrivalOf(sample);
    ASSERT_GE(arrival, last - 1e-3);  // frames that arrive between two ticks are seen at the second
    last = std::max(last, arrival);
    if (const auto* motor = std::get_if<tracking::MotorSample>(&sample)) {
      ASSERT_NEAR(motor->t, 1e-3 * motors, 1e-9);
      ++motors;
    } else if (std::holds_alternative<tracking::JointSample>(sample)) {
      ++joints;
      ASSERT_EQ(joints, motors);
    } else {
      const auto& tip = std::get<tracking::TipSample>(sample);
      EXPECT_GT(tip.t_arrival, tip.t);
      EXPECT_LT((tip.position - source.frameTruth().tip).norm(), 0.03);
      ++tips;
    }
  }
  EXPECT_NEAR(motors, 10250, 2);  // a quarter second goes into getting up to pace
  EXPECT_NEAR(tips, 153, 2);
}

TEST(SimulatedSource, DecimatesTheReference) {
  SimulatedOptions options = quietOptions(1.0);
  for (const auto& [decimation, expected] : {std::pair{0, 0}, std::pair{10, 126}}) {
    options.joint_decimation = decimation;
    SimulatedSource source(options);
    EXPECT_EQ(source.info().reference, decimation > 0);
    tracking::Sample sample;
    int joints = 0;
    while (source.next(sample)) joints += std::holds_alternative<tracking::JointSample>(sample) ? 1 : 0;
    EXPECT_NEAR(joints, expected, 1);
  }
}

TEST(SimulatedSource, SaysWhatItKnows) {
  SimulatedOptions options = cameraOptions(5.0, true);
  options.registered = false;
  const SimulatedSource source(options);
  const tracking::SourceInfo& info = source.info();
  EXPECT_EQ(info.robot.name, options.robot.name);
  EXPECT_TRUE(info.rig);
  EXPECT_FALSE(info.base_from_camera);
  EXPECT_EQ(formatTruth(parseTruth(info.truth, "info")), formatTruth(options.truth));
  EXPECT_NE(info.marker.find("hue_low"), std::string::npos);
  EXPECT_EQ(info.duration, 5.0);
  EXPECT_TRUE(info.live);
}

TEST(SimulatedSource, WithoutACameraThereAreNoFrames) {
  SimulatedSource source(quietOptions(0.5));
  tracking::Sample sample;
  while (source.next(sample)) {
    EXPECT_FALSE(std::holds_alternative<tracking::StereoFrame>(sample));
    EXPECT_FALSE(std::holds_alternative<tracking::TipSample>(sample));
  }
  EXPECT_FALSE(source.info().rig);
}

TEST(SimulatedSource, RegistersAtTheHardStopThroughPictures) {
  SimulatedOptions options = cameraOptions(0.5, true);
  options.truth.cameras.rotation_error.setZero();
  options.registration_frames = 30;
  const SimulatedSource source(options);
  ASSERT_TRUE(source.info().base_from_camera);
  const Eigen::Isometry3d found = *source.info().base_from_camera, real = source.trueBaseFromCamera();
  EXPECT_LT((found.linear() - real.linear()).norm(), 1e-12);
  const robot::ArmKinematics kinematics(options.robot);
  const Eigen::Vector3d stop = kinematics.tip(robot::Transmission(options.robot).homing());
  const Eigen::Vector3d ray = (stop - real.translation()).normalized(),
                        error = found.translation() - real.translation();
  EXPECT_LT((error - error.dot(ray) * ray).norm(), 5e-4);  // across the line of observation to the marker
  EXPECT_LT(std::abs(error.dot(ray)), 4e-3);               // along it
}

TEST(SimulatedSource, AMountingErrorStaysInTheRegistration) {
  const SimulatedOptions options = cameraOptions(0.5, false);
  const SimulatedSource source(options);
  const Eigen::Matrix3d left =
      source.trueBaseFromCamera().linear().transpose() * source.info().base_from_camera->linear();
  EXPECT_NEAR(Eigen::AngleAxisd(left).angle(), options.truth.cameras.rotation_error.norm(), 1e-9);
  EXPECT_LT((source.info().base_from_camera->linear() - nominalBaseFromCamera(options.robot).linear()).norm(),
            1e-12);
}

TEST(SimulatedSource, PicturesShowTheToolWhereItIs) {
  SimulatedSource source(cameraOptions(4.0, true));
  vision::MarkerDetector detector({}, 640, 480);
  tracking::Sample sample;
  double square = 0.0;
  int found = 0, frames = 0;
  while (source.next(sample)) {
    const auto* frame = std::get_if<tracking::StereoFrame>(&sample);
    if (frame == nullptr) continue;
    ++frames;
    for (const auto& [image, side] :
         {std::pair{frame->left, std::size_t{0}}, std::pair{frame->right, std::size_t{1}}}) {
      const vision::MarkerDetection seen = detector.detect(image);
      if (!seen.found()) continue;
      ++found;
      square += (seen.centroid - source.frameTruth().marker[side].ellipse_centre).squaredNorm();
    }
  }
  EXPECT_GT(frames, 55);
  EXPECT_GT(found, 1.9 * frames);
  EXPECT_LT(std::sqrt(square / found), 0.25);
}

TEST(SimulatedSource, ABlockedCameraShowsNoMarkerUntilItIsFreed) {
  SimulatedSource source(cameraOptions(3.0, true));
  vision::MarkerDetector detector({}, 640, 480);
  tracking::Sample sample;
  int left_seen = 0, right_seen = 0, later = 0;
  source.block(true, false);
  while (source.next(sample)) {
    const auto* frame = std::get_if<tracking::StereoFrame>(&sample);
    if (frame == nullptr) continue;
    if (frame->t > 1.0) source.block(false, false);
    if (frame->t < 1.0) left_seen += detector.detect(frame->left).found() ? 1 : 0;
    if (frame->t < 1.0) right_seen += detector.detect(frame->right).found() ? 1 : 0;
    if (frame->t > 1.2) later += detector.detect(frame->left).found() ? 1 : 0;
  }
  EXPECT_EQ(left_seen, 0);
  EXPECT_GT(right_seen, 12);
  EXPECT_GT(later, 25);
}

TEST(SimulatedSource, DrivesToTheHardStopOnCommandAndResumes) {
  SimulatedOptions options = quietOptions(5.0);
  SimulatedSource source(options);
  const robot::Transmission transmission(options.robot);
  tracking::Sample sample;
  Eigen::Vector3d joints = Eigen::Vector3d::Zero();
  const auto run = [&](double until) {
    bool more = true;
    double t = 0.0;
    while (t < until && (more = source.next(sample))) {
      t = arrivalOf(sample);
      if (const auto* joint = std::get_if<tracking::JointSample>(&sample)) joints = joint->position;
    }
    return more;
  };
  run(1.0);
  EXPECT_FALSE(source.arrivedAtHardStop());
  source.driveToHardStop();
  EXPECT_TRUE(run(9.0));
  EXPECT_TRUE(source.arrivedAtHardStop());
  const Eigen::Vector3d stop = transmission.homing(), none = Eigen::Vector3d::Zero();
  const Eigen::Vector3d weight = robot::ArmDynamics(options.robot).inverse<double>(stop, none, none);
  for (int i = 0; i < 3; ++i) {  // at rest a joint is off by what its cable gives under weight and stiction
    const robot::Drive& drive = options.robot.drives[static_cast<std::size_t>(i)];
    const double give =
        (std::abs(weight[i]) + options.robot.joints[static_cast<std::size_t>(i)].friction.coulomb) /
        (2.0 * drive.cable_stiffness * drive.cable_exponent * std::pow(drive.link_radius, 2));
    const double deadband = 1.5 * drive.motor_friction.coulomb / options.truth.controller.stiffness *
                            drive.motor_capstan_radius / drive.gear_ratio / drive.link_radius;
    EXPECT_LT(std::abs(joints[i] - stop[i]), 1.1 * (give + deadband)) << "joint " << i + 1;
  }
  source.resume();
  EXPECT_TRUE(run(9.5));
  EXPECT_FALSE(source.arrivedAtHardStop());
  EXPECT_FALSE(run(40.0));  // and on to the end of the path
  EXPECT_LT(arrivalOf(sample), 25.0);
}

TEST(SimulatedSource, HoldsWhereItIs) {
  SimulatedSource source(quietOptions(5.0));
  tracking::Sample sample;
  Eigen::Vector3d held = Eigen::Vector3d::Zero(), now = held;
  source.hold();
  for (int i = 0; i < 4000; ++i) {
    ASSERT_TRUE(source.next(sample));
    const auto* joint = std::get_if<tracking::JointSample>(&sample);
    if (joint == nullptr) continue;
    now = joint->position;
    if (i < 1000) held = now;
  }
  EXPECT_LT((now - held).norm(), 1e-4);
}

TEST(SimulatedSource, BadOptionsAreRefused) {
  SimulatedOptions options = quietOptions(1.0);
  options.trajectory.kind = TrajectoryKind::kHold;
  options.trajectory.hold.position = {0.5, 1.5, 0.9};
  EXPECT_THROW(SimulatedSource{options}, base::InputError);
  options = cameraOptions(1.0, true);
  options.truth.images.unevenness = 0.0;
  options.truth.images.marker_hue = 150.0;  // nothing of the marker's colour to register with
  EXPECT_THROW(SimulatedSource{options}, base::InputError);
  options = quietOptions(1.0);
  options.robot.joints[1].dh.a = 0.1;  // no remote centre
  EXPECT_THROW(SimulatedSource{options}, base::InputError);
}

}  // namespace
}  // namespace capstan::simulation
