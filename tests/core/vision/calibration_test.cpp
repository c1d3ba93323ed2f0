#include "core/vision/calibration.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/error.h"
#include "core/base/random.h"
#include "tests/core/vision/board_for_tests.h"
#include "tests/core/vision/rig_for_tests.h"
#include "tests/support/folders.h"

namespace capstan::vision {
namespace {

namespace fs = std::filesystem;

/// The stereo chessboard images of OpenCV's samples, where they are at hand.
fs::path openCvStereo() { return test::dataFolder() / "opencv-stereo"; }

class RenderedBoards : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::path(::testing::TempDir()) / ("capstan_boards_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    base::Random random(11);
    const StereoRig rig = testRig();
    const test::BoardPicture board = test::pictureOf(options());
    const test::BoardCamera left(rig.left), right(rig.right);
    for (int i = 0; i < kViews; ++i) {
      const Eigen::Isometry3d pose = test::boardPose(options(), i, kViews);
      cv::imwrite(name("left", i), left.image(board, pose, random));
      cv::imwrite(name("right", i), right.image(board, rig.right_from_left * pose, random));
    }
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static CalibrationOptions options() {
    CalibrationOptions chosen;
    chosen.square_size = 0.02;
    chosen.corner_window = 7;
    return chosen;
  }
  static std::string name(const std::string& side, int view) {
    return (folder_ / (side + std::to_string(10 + view) + ".png")).string();
  }

  static constexpr int kViews = 10;
  static inline fs::path folder_;
};

TEST_F(RenderedBoards, GiveTheRigBack) {
  base::Progress progress;
  CalibrationOptions free = options();
  free.square_pixels = false;  // the pixels of the test rig are not square
  const CalibrationReport report = calibrateStereo(findStereoPairs(folder_), free, progress);
  const StereoRig truth = testRig();
  EXPECT_EQ(report.views_used, kViews);
  EXPECT_DOUBLE_EQ(progress.fraction(), 1.0);
  EXPECT_LT(std::abs(report.rig.left.fx - truth.left.fx), 4.0 * report.left.focal_sigma);
  EXPECT_LT(std::abs(report.rig.right.fx - truth.right.fx), 4.0 * report.right.focal_sigma);
  EXPECT_NEAR(report.rig.left.fx, truth.left.fx, 0.003 * truth.left.fx);
  EXPECT_NEAR(report.rig.right.fx, truth.right.fx, 0.003 * truth.right.fx);
  EXPECT_NEAR(report.rig.left.cx, truth.left.cx, 3.0);
  EXPECT_NEAR(report.rig.left.cy, truth.left.cy, 3.0);
  EXPECT_NEAR(report.rig.baseline(), truth.baseline(), 0.1e-3);
  const Eigen::AngleAxisd turn(report.rig.right_from_left.linear() *
                               truth.right_from_left.linear().transpose());
  EXPECT_LT(turn.angle(), 0.01);
  for (const CalibrationView& view : report.views) {
    EXPECT_TRUE(view.used());
    EXPECT_GT(view.left_error, 0.0);
    EXPECT_LT(view.stereo_error, 0.15);
    EXPECT_FALSE(view.outlying) << view.left;
  }
}

TEST_F(RenderedBoards, PairsThatCannotBeUsedAreListedWithTheirReason) {
  const auto extra = [&](const char* file, const cv::Mat& image) {
    cv::imwrite((folder_ / file).string(), image);
    return folder_ / file;
  };
  CalibrationInput input = findStereoPairs(folder_);
  const fs::path left = input.left.front(), right = input.right.front();
  const fs::path blank = extra("blank.png", cv::Mat(480, 640, CV_8U, cv::Scalar(128)));
  const fs::path small = extra("small.png", cv::Mat(240, 320, CV_8U, cv::Scalar(128)));
  const fs::path text = folder_ / "text.png";
  std::ofstream(text) << "not an image";
  for (const auto& [l, r] :
       {std::pair{blank, right}, {left, blank}, {blank, blank}, {text, right}, {left, text}, {left, small}}) {
    input.left.push_back(l);
    input.right.push_back(r);
  }
  base::Progress progress;
  const CalibrationReport report = calibrateStereo(input, options(), progress);
  EXPECT_EQ(report.views_used, kViews);
  ASSERT_EQ(report.views.size(), kViews + 6U);
  const ViewFault expected[] = {ViewFault::kBoardNotInLeft,  ViewFault::kBoardNotInRight,
                                ViewFault::kBoardInNeither,  ViewFault::kLeftUnreadable,
                                ViewFault::kRightUnreadable, ViewFault::kWrongSize};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(report.views[kViews + i].fault, expected[i]) << i;
  for (const fs::path& path : {blank, small, text}) fs::remove(path);
}

TEST_F(RenderedBoards, AViewOfAnotherPoseIsSuspectAndLeftOutOnlyWhenAsked) {
  CalibrationInput input = findStereoPairs(folder_);
  input.left.push_back(input.left[0]);  // a pair whose images were not taken together
  input.right.push_back(input.right[5]);
  base::Progress progress;
  const CalibrationReport kept = calibrateStereo(input, options(), progress);
  EXPECT_EQ(kept.views_used, kViews + 1);
  EXPECT_TRUE(kept.views.back().outlying);
  CalibrationOptions strict = options();
  strict.outlier_factor = 3.0;
  const CalibrationReport dropped = calibrateStereo(input, strict, progress);
  EXPECT_EQ(dropped.views.back().fault, ViewFault::kBadView);
  EXPECT_EQ(dropped.views_used, kViews);
  EXPECT_NEAR(dropped.rig.baseline(), testRig().baseline(), 0.1e-3);
}

TEST_F(RenderedBoards, StopsWhenCancelled) {
  base::Progress progress;
  progress.cancel();
  EXPECT_TRUE(calibrateStereo(findStereoPairs(folder_), options(), progress).cancelled);
}

TEST_F(RenderedBoards, RefusesInputsThatCannotWork) {
  base::Progress progress;
  const CalibrationInput input = findStereoPairs(folder_);
  CalibrationInput few = input;
  few.left.resize(2);
  few.right.resize(2);
  EXPECT_THROW(calibrateStereo(few, options(), progress), base::InputError);
  CalibrationOptions wrong = options();
  wrong.square_size = -1.0;
  try {
    calibrateStereo(input, wrong, progress);
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().key, "square_size");
  }
  CalibrationInput uneven = input;
  uneven.right.pop_back();
  EXPECT_THROW(calibrateStereo(uneven, options(), progress), base::InputError);
  EXPECT_THROW(findStereoPairs(folder_ / "absent"), base::InputError);
}

TEST(OpenCvStereoPictures, GiveThePublishedFocalLengthAndErrors) {
  if (!fs::is_directory(openCvStereo()))
    GTEST_SKIP() << "no " << openCvStereo() << "; set CAPSTAN_DATA to the folder of measured data";
  base::Progress progress;
  const CalibrationReport report =
      calibrateStereo(findStereoPairs(openCvStereo()), CalibrationOptions{}, progress);
  EXPECT_EQ(report.views_used, 13);
  EXPECT_NEAR(report.rig.left.fx, 535.91573, 0.005 * 535.91573);  // left_intrinsics.yml
  EXPECT_LE(report.left.rms, 0.45);
  EXPECT_LE(report.stereo_rms, 0.45);
  // Per-view errors of left_intrinsics.yml, corners by another release of the same library.
  const double published[] = {0.193, 1.182, 0.173, 0.193, 0.160, 0.180, 0.231,
                              0.242, 0.296, 0.167, 0.202, 0.381, 0.174};
  ASSERT_EQ(report.views.size(), 13U);
  for (std::size_t i = 0; i < 13; ++i) EXPECT_NEAR(report.views[i].left_error, published[i], 0.1) << i;
  EXPECT_TRUE(report.views[1].outlying);
}

}  // namespace
}  // namespace capstan::vision
