// Wrong cameras are named by what is wrong with them, from what they see of a moving arm.
#include "core/registration/stereo_fault.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/robot/arm_kinematics.h"
#include "tests/support/folders.h"

namespace capstan::registration {
namespace {

using ::testing::HasSubstr;
using vision::ImageCorrection;

vision::StereoRig parallelRig() {
  vision::StereoRig rig;
  for (vision::Camera* camera : {&rig.left, &rig.right}) {
    camera->fx = camera->fy = 800.0;
    camera->cx = 317.0, camera->cy = 243.0;
    camera->distortion = {-0.1, 0.02, 0.0, 0.0, 0.0};
  }
  rig.right_from_left.linear() = Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitY()).toRotationMatrix();
  rig.right_from_left.translation() = Eigen::Vector3d(-0.06, 0.001, 0.0);
  return rig;
}

class Stereo : public ::testing::Test {
 protected:
  /// Poses of a tip in a box 0.3 m in front of the cameras, seen by the true rig with 0.1 px of noise, the
  /// tips by kinematics being wrong by 1 mm; then `wrong` is done to the images.
  std::vector<PairRow> rows(int count, const ImageCorrection& wrong, std::uint64_t seed = 1) const {
    base::Random random(seed);
    std::vector<PairRow> rows;
    while (static_cast<int>(rows.size()) < count) {
      const Eigen::Vector3d point(random.uniform(-0.05, 0.05), random.uniform(-0.04, 0.04),
                                  random.uniform(0.25, 0.35));
      auto left = truth_.left.project(point), right = truth_.right.project(truth_.right_from_left * point);
      if (!left || !right) continue;
      PairRow row;
      row.base = base_from_camera_ * point;
      for (int axis = 0; axis < 3; ++axis) {
        (*row.base)(axis) += random.normal(0.0, 1e-3);
        if (axis == 2) continue;
        (*left)(axis) += random.normal(0.0, 0.1), (*right)(axis) += random.normal(0.0, 0.1);
      }
      const auto seen = wrong.apply(*left, *right, truth_.left.width, truth_.left.height);
      row.pixels = StereoPixels{seen[0], seen[1], 0.1, 0.1};
      rows.push_back(row);
    }
    return rows;
  }

  vision::StereoRig truth_ = parallelRig();
  vision::Triangulator triangulator_{truth_};
  Eigen::Isometry3d base_from_camera_ = Eigen::Translation3d(0.1, -0.4, 0.2) *
                                        Eigen::AngleAxisd(2.0, Eigen::Vector3d(1.0, 0.3, -0.4).normalized());
};

TEST_F(Stereo, RightCamerasFitAndFewPosesSayNothing) {
  EXPECT_EQ(findStereoFault(rows(5, {}), triangulator_).verdict, StereoVerdict::kUnknown);
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const auto finding = findStereoFault(rows(8, {}, seed), triangulator_);
    EXPECT_EQ(finding.verdict, StereoVerdict::kFits) << seed;
    EXPECT_LT(finding.rms, 4e-3);
  }
  EXPECT_EQ(wordsOf(findStereoFault(rows(8, {}), triangulator_), truth_).button, "");
}

TEST_F(Stereo, WrongImagesAreNamedByTheCorrectionThatUndoesThem) {
  const std::pair<ImageCorrection, const char*> wrongs[] = {
      {{true, {}, {}}, "cameras exchanged"},
      {{false, {true, true}, {}}, "both images mirrored"},
      {{false, {true, false}, {}}, "left image mirrored"},
      {{false, {false, true}, {}}, "right image mirrored"},
      {{false, {}, {true, false}}, "left image upside down"},
      {{false, {true, false}, {true, false}}, "left image mirrored, left image upside down"},
      {{false, {false, true}, {false, true}}, "right image mirrored, right image upside down"}};
  for (const auto& [wrong, words] : wrongs)
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const auto finding = findStereoFault(rows(12, wrong, seed), triangulator_);
      ASSERT_EQ(finding.verdict, StereoVerdict::kImages) << words << ", seed " << seed;
      EXPECT_EQ(finding.correction.words(), words);
      EXPECT_TRUE(wrong.then(finding.correction).none()) << words;
    }
  const auto words = wordsOf(findStereoFault(rows(12, {true, {}, {}}), triangulator_), truth_);
  EXPECT_EQ(words.reason, "wrong images: cameras exchanged");
  EXPECT_EQ(words.button, "Exchange the cameras");
}

/// A calibration whose board had squares of another size has base line and all lengths wrong by one factor.
TEST_F(Stereo, AWrongBaseLineOrBoardIsNamedWithItsFactor) {
  for (const double scale : {0.6, 0.8, 1.08, 1.25, 2.0}) {
    const vision::Triangulator wrong(scaledBaseline(truth_, 1.0 / scale));
    const auto finding = findStereoFault(rows(14, {}), wrong);
    ASSERT_EQ(finding.verdict, StereoVerdict::kScale) << scale;
    EXPECT_NEAR(finding.scale, scale, 0.03 * scale);
    EXPECT_NEAR(scaledBaseline(wrong.rig(), finding.scale).baseline(), truth_.baseline(),
                0.03 * truth_.baseline());
    const auto words = wordsOf(finding, wrong.rig());
    EXPECT_THAT(words.reason, HasSubstr("wrong base line or board"));
    EXPECT_EQ(words.button, "Scale the base line");
  }
}

TEST_F(Stereo, OtherCamerasFitInNoWay) {
  auto other = truth_;
  other.right_from_left.linear() = Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitY()).toRotationMatrix();
  auto wrong = rows(14, {});
  base::Random random(9);
  for (PairRow& row : wrong)
    row.base = Eigen::Vector3d(random.normal(0, 0.05), random.normal(0, 0.05), random.normal(0, 0.05));
  const auto finding = findStereoFault(wrong, vision::Triangulator(other));
  EXPECT_EQ(finding.verdict, StereoVerdict::kNoFit);
  EXPECT_THAT(wordsOf(finding, other).remedy, HasSubstr("camera files belong to these cameras"));
}

TEST_F(Stereo, WatchTakesSlowPosesThatAreApart) {
  StereoWatch watch(truth_);
  const auto seen = rows(10, {true, {}, {}});
  double t = 0.0;
  const auto show = [&](const PairRow& row, double step) {
    tracking::Snapshot s{};
    s.camera_updated = s.camera_images = true;
    s.t_cam = t += step;
    s.tip_kin_cam = *row.base;
    for (auto& marker : s.marker) marker.fault = vision::MarkerFault::kNone, marker.sigma = 0.1;
    s.marker[0].centroid = row.pixels->left;
    s.marker[1].centroid = row.pixels->right;
    return watch.observe(s);
  };
  int taken = 0;
  for (const PairRow& row : seen) {
    show(row, 0.066);  // a jump: too fast
    taken += show(row, 0.066);
    EXPECT_FALSE(show(row, 0.066)) << "the same pose again";
  }
  EXPECT_GE(taken, 8);
  EXPECT_EQ(watch.finding().verdict, StereoVerdict::kImages);
  EXPECT_EQ(watch.finding().poses, static_cast<std::size_t>(taken));
}

}  // namespace
}  // namespace capstan::registration
