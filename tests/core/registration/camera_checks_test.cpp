#include "core/registration/camera_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/base/random.h"

namespace capstan::registration {
namespace {

using ::testing::HasSubstr;

class Checks : public ::testing::Test {
 protected:
  static vision::StereoRig rig() {
    vision::StereoRig rig;
    for (vision::Camera* camera : {&rig.left, &rig.right}) {
      camera->width = 320, camera->height = 240;
      camera->fx = camera->fy = 500.0;
      camera->cx = 160.0, camera->cy = 120.0;
    }
    rig.right_from_left.translation() = Eigen::Vector3d(-0.06, 0.0, 0.0);
    return rig;
  }
  /// A green ball of brightness `value` and radius 14 px at (x, 120), blurred, with noise.
  cv::Mat imageAt(double x, int value = 160, double blur = 0.9) {
    cv::Mat image(240, 320, CV_8UC3, cv::Scalar(70, 66, 72));
    cv::circle(image, cv::Point(cvRound(x), 120), 14, cv::Scalar(0.3 * value, value, 0.3 * value),
               cv::FILLED);
    cv::GaussianBlur(image, image, {}, blur);
    for (int row = 0; row < image.rows; ++row)
      for (int column = 0; column < image.cols; ++column)
        for (int channel = 0; channel < 3; ++channel) {
          auto& level = image.at<cv::Vec3b>(row, column)[channel];
          level = cv::saturate_cast<uchar>(level + random_.normal(0.0, 1.5));
        }
    return image;
  }
  /// The next pair, 66 ms later.
  void show(cv::Mat left, cv::Mat right, double skew = 0.0) {
    t_ += 0.066;
    tracking::StereoFrame frame{t_, t_ + 0.01, std::move(left), std::move(right), skew};
    tracking::Snapshot snapshot{};
    snapshot.t = frame.t_arrival;
    snapshot.t_cam = t_;
    snapshot.camera_samples = ++samples_;
    snapshot.camera_updated = snapshot.camera_images = true;
    snapshot.tip_kin_cam.setConstant(std::numeric_limits<double>::quiet_NaN());
    for (std::size_t side = 0; side < 2; ++side) {
      auto& marker = snapshot.marker[side];
      marker.fault = faults_[side];
      marker.centroid = {side == 0 ? left_x_ : right_x_, 120.0};
      marker.radius = 14.0;
      marker.sigma = 0.1;
    }
    checks_.observe(snapshot);
    checks_.see(frame, snapshot);
  }
  void showGood(int pairs) {
    for (int i = 0; i < pairs; ++i) show(imageAt(left_x_), imageAt(right_x_));
  }
  CameraCheck check(const std::string& name) const {
    for (const CameraCheck& each : checks_.checks())
      if (each.name == name) return each;
    ADD_FAILURE() << name;
    return {};
  }

  base::Random random_{3};
  CameraChecks checks_{rig(), vision::MarkerOptions{}};
  std::array<vision::MarkerFault, 2> faults_ = {vision::MarkerFault::kNone, vision::MarkerFault::kNone};
  double left_x_ = 200.0, right_x_ = 100.0, t_ = 0.0;
  std::uint64_t samples_ = 0;
};

TEST_F(Checks, GoodCamerasPassWithTheirNumbers) {
  EXPECT_EQ(check("images").state, CheckState::kUnknown);
  showGood(6);
  for (const char* name : {"images", "same time", "focus", "exposure", "marker"}) {
    EXPECT_EQ(check(name).state, CheckState::kPass) << name << ": " << check(name).remedy;
    EXPECT_TRUE(check(name).remedy.empty()) << name;
  }
  EXPECT_EQ(check("images").value, "15.2 /s");
  EXPECT_EQ(check("same time").value, "0.0 ms");
  EXPECT_EQ(check("geometry").state, CheckState::kUnknown) << "the arm has not moved";
  EXPECT_FALSE(checks_.remedy());
}

TEST_F(Checks, ASilentAFrozenAnEmptyAndAWrongImageAreTold) {
  showGood(6);
  checks_.setNow(t_ + 1.2, {});
  EXPECT_EQ(check("images").state, CheckState::kFail);
  EXPECT_THAT(check("images").remedy, HasSubstr("No images arrive. Check cable"));
  tracking::SideStatus side;
  side.counted = "image";
  side.part = "right";
  side.from = "/dev/video2";
  side.state = tracking::SideStatus::State::kSilent;
  side.silent_for = 0.9;
  checks_.setNow(t_ + 1.2, {side});
  EXPECT_THAT(check("images").remedy, HasSubstr("The right camera is silent"));
  EXPECT_THAT(check("images").remedy, HasSubstr("/dev/video2"));
  checks_.setNow(t_ += 1.2, {});
  showGood(1);
  EXPECT_EQ(check("images").state, CheckState::kPass);
  const cv::Mat still = imageAt(right_x_);
  for (int i = 0; i < 5; ++i) show(imageAt(left_x_), still.clone());
  EXPECT_THAT(check("images").remedy, HasSubstr("The right camera repeats one image"));
  show({}, imageAt(right_x_));
  EXPECT_THAT(check("images").remedy, HasSubstr("The left camera gives no image"));
  cv::Mat small;
  cv::resize(imageAt(left_x_), small, {160, 120});
  show(small, imageAt(right_x_));
  EXPECT_THAT(check("images").remedy, HasSubstr("160 × 120 px, its calibration 320 × 240"));
}

TEST_F(Checks, ImagesOfDifferentTimesAreToldAndUnknownTimesAreNoFault) {
  for (int i = 0; i < 6; ++i) show(imageAt(left_x_), imageAt(right_x_), -0.011);
  EXPECT_EQ(check("same time").state, CheckState::kFail);
  EXPECT_EQ(check("same time").value, "11.0 ms");
  EXPECT_THAT(check("same time").remedy, HasSubstr("moves 1.1 mm meanwhile"));
  checks_ = CameraChecks(rig(), {});
  show(imageAt(left_x_), imageAt(right_x_), std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(check("same time").state, CheckState::kUnknown);
}

TEST_F(Checks, BlurIsToldBySide) {
  for (int i = 0; i < 3; ++i) show(imageAt(left_x_), imageAt(right_x_, 160, 3.5));
  EXPECT_EQ(check("focus").state, CheckState::kFail);
  EXPECT_THAT(check("focus").remedy, HasSubstr("of the marker in the right image"));
  EXPECT_THAT(check("focus").remedy, HasSubstr("Turn the focus"));
}

TEST_F(Checks, BrightAndDarkMarkersAreTold) {
  for (int i = 0; i < 3; ++i) show(imageAt(left_x_, 255), imageAt(right_x_));
  EXPECT_EQ(check("exposure").state, CheckState::kFail);
  EXPECT_THAT(check("exposure").remedy, HasSubstr("of the marker of the left camera is overexposed"));
  for (int i = 0; i < 3; ++i) show(imageAt(left_x_), imageAt(right_x_, 65));
  EXPECT_THAT(check("exposure").remedy,
              HasSubstr("The right image is too dark: half of the marker has 65 of 255"));
  EXPECT_THAT(check("exposure").remedy, HasSubstr("add light"));
}

TEST_F(Checks, AMarkerThatIsNotFoundIsToldWithItsReason) {
  faults_[1] = vision::MarkerFault::kTwoCandidates;
  showGood(1);
  EXPECT_EQ(check("marker").value, "right: two candidates");
  EXPECT_THAT(check("marker").remedy, HasSubstr("Remove other objects of the marker's colour"));
}

TEST_F(Checks, RaysBehindTheCamerasOfferTheExchangeBeforeTheArmHasMoved) {
  std::swap(left_x_, right_x_);
  showGood(12);
  EXPECT_EQ(check("geometry").state, CheckState::kFail);
  EXPECT_EQ(check("geometry").button, "Exchange the cameras");
  ASSERT_TRUE(checks_.remedy());
  EXPECT_EQ(checks_.remedy()->correction, (vision::ImageCorrection{true, {}, {}}));
  EXPECT_EQ(checks_.remedy()->scale, 1.0);
}

}  // namespace
}  // namespace capstan::registration
