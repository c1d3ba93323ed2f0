// Boards of markers, boards of another size than expected, coverage, and views from a running camera.
#include "core/vision/calibration_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "core/base/error.h"
#include "tests/core/vision/board_for_tests.h"
#include "tests/core/vision/rig_for_tests.h"
#include "tests/support/folders.h"
#include "tests/support/temporary_folder.h"

namespace capstan::vision {
namespace {

namespace fs = std::filesystem;
using Verdict = CalibrationViews::Verdict;

CalibrationOptions optionsOf(BoardKind kind, int columns, int rows) {
  CalibrationOptions options;
  options.board = kind;
  options.board_columns = columns;
  options.board_rows = rows;
  options.square_size = 0.02;
  options.marker_size = 0.015;
  options.corner_window = 9;
  options.square_pixels = false;  // those of the test rig differ
  return options;
}

class CalibrationViewsTest : public ::testing::Test {
 protected:
  std::array<cv::Mat, 2> pair(const CalibrationOptions& options, const Eigen::Isometry3d& pose) {
    const test::BoardPicture board = test::pictureOf(options);
    return {left().image(board, pose, random_), right().image(board, rig_.right_from_left * pose, random_)};
  }
  static const test::BoardCamera& left() {
    static const test::BoardCamera camera(testRig().left);
    return camera;
  }
  static const test::BoardCamera& right() {
    static const test::BoardCamera camera(testRig().right);
    return camera;
  }
  /// Shows each of `views` poses twice, so that the board stands still.
  CalibrationViews collect(const CalibrationOptions& options, int views, double reach) {
    CalibrationViews all(options);
    for (int i = 0; i < views; ++i) {
      const auto [left, right] = pair(options, test::boardPose(options, i, views, reach));
      all.observe(left, right, t_ += 0.1);
      all.observe(left, right, t_ += 0.1);
    }
    return all;
  }
  /// The corners of the kind of board are found to about `rms` [px].
  void expectRig(const CalibrationReport& report, double rms) const {
    EXPECT_LT(std::abs(report.rig.left.fx - rig_.left.fx), 4.0 * report.left.focal_sigma);
    EXPECT_LT(std::abs(report.rig.right.fx - rig_.right.fx), 4.0 * report.right.focal_sigma);
    EXPECT_LT(report.left.focal_sigma, 0.01 * rig_.left.fx);
    EXPECT_NEAR(report.rig.baseline(), rig_.baseline(), 0.3e-3);
    EXPECT_LT(report.stereo_rms, rms);
    EXPECT_LT(report.epipolar_rms, rms);
  }

  StereoRig rig_ = testRig();
  base::Random random_{17};
  double t_ = 0.0;
};

TEST_F(CalibrationViewsTest, BoardsOfMarkersGiveTheRigAlsoSeenInPart) {
  for (const auto& options : {optionsOf(BoardKind::kCharuco, 9, 6), optionsOf(BoardKind::kAruco, 8, 6)}) {
    const CalibrationViews views = collect(options, 14, 0.13);
    EXPECT_GE(views.used(), 9U) << base::nameOf(options.board);
    std::size_t least = 1000, most = 0;
    for (const auto& corners : views.corners(0)) {
      least = std::min(least, corners.size());
      most = std::max(most, corners.size());
    }
    EXPECT_LT(least, most) << "no board was cut off by the image's edge";
    base::Progress progress;
    expectRig(views.calibrate(progress), options.board == BoardKind::kCharuco ? 0.2 : 0.8);
  }
}

TEST_F(CalibrationViewsTest, AViewIsTakenOnceAndWhenTheBoardStandsStill) {
  const CalibrationOptions options = optionsOf(BoardKind::kChessboard, 9, 6);
  const auto first = pair(options, test::boardPose(options, 0, 10));
  const auto other = pair(options, test::boardPose(options, 5, 10));
  CalibrationViews views(options);
  EXPECT_EQ(views.observe(first[0], first[1], 0.0).verdict, Verdict::kMoving) << "nothing to compare with";
  EXPECT_EQ(views.observe(other[0], other[1], 0.1).verdict, Verdict::kMoving);
  const auto taken = views.observe(other[0], other[1], 0.2);
  EXPECT_EQ(taken.verdict, Verdict::kTaken);
  EXPECT_EQ(taken.left->pixels.size(), 54U);
  EXPECT_EQ(views.observe(other[0], other[1], 0.3).verdict, Verdict::kSimilar);
  const cv::Mat blank(other[0].size(), CV_8U, cv::Scalar(120));
  EXPECT_EQ(views.observe(other[0], blank, 0.4).verdict, Verdict::kNotSeen);
  EXPECT_EQ(views.observe(cv::Mat(), cv::Mat(), 0.4).verdict, Verdict::kNotSeen);
  const cv::Mat small(240, 320, CV_8U, cv::Scalar(120));
  EXPECT_EQ(views.observe(small, small, 0.5).verdict, Verdict::kWrongSize);
  EXPECT_EQ(views.views().size(), 1U);
  for (const Verdict verdict : {Verdict::kMoving, Verdict::kSimilar, Verdict::kNotSeen, Verdict::kWrongSize})
    EXPECT_FALSE(wordsOf(verdict).empty());
}

TEST_F(CalibrationViewsTest, AnExcludedViewDoesNotCount) {
  const CalibrationOptions options = optionsOf(BoardKind::kChessboard, 9, 6);
  CalibrationViews views = collect(options, 8, 0.06);
  const std::size_t used = views.used();
  ASSERT_GE(used, 5U);
  base::Progress progress;
  const CalibrationReport all = views.calibrate(progress);
  expectRig(all, 0.1);
  EXPECT_EQ(all.views_used, static_cast<int>(used));
  views.exclude(1, true);
  EXPECT_EQ(views.used(), used - 1);
  EXPECT_EQ(views.corners(1).size(), used - 1);
  const CalibrationReport fewer = views.calibrate(progress);
  EXPECT_EQ(fewer.views_used, static_cast<int>(used) - 1);
  EXPECT_NE(fewer.rig.left.fx, all.rig.left.fx);
  views.exclude(1, false);
  EXPECT_EQ(views.calibrate(progress).rig.left.fx, all.rig.left.fx);
}

TEST_F(CalibrationViewsTest, ARunningCameraNamesAnotherBoardToo) {
  const CalibrationOptions shown = optionsOf(BoardKind::kChessboard, 8, 6);
  CalibrationViews views(optionsOf(BoardKind::kChessboard, 9, 6));
  for (int i = 0; i < 6 && !views.otherBoard(); ++i) {
    const auto [left, right] = pair(shown, test::boardPose(shown, i, 6));
    EXPECT_EQ(views.observe(left, right, t_ += 0.1).verdict, Verdict::kNotSeen);
  }
  EXPECT_EQ(views.otherBoard(), cv::Size(8, 6));
}

TEST_F(CalibrationViewsTest, SavedImagesGiveTheSameCalibration) {
  const CalibrationOptions options = optionsOf(BoardKind::kChessboard, 9, 6);
  const CalibrationViews views = collect(options, 6, 0.06);
  const test::TemporaryFolder folder;
  views.saveImages(folder.path());
  base::Progress progress;
  const CalibrationReport ours = views.calibrate(progress);
  const CalibrationReport again = calibrateStereo(findStereoPairs(folder.path()), options, progress);
  EXPECT_EQ(again.views_used, ours.views_used);
  EXPECT_DOUBLE_EQ(again.rig.left.fx, ours.rig.left.fx);
  CalibrationViews read(options);
  read.addFiles(findStereoPairs(folder.path()), progress);
  EXPECT_DOUBLE_EQ(read.calibrate(progress).rig.left.fx, ours.rig.left.fx);
  EXPECT_DOUBLE_EQ(read.coverage(0).x, views.coverage(0).x);
}

TEST_F(CalibrationViewsTest, AChessboardOfAnotherSizeIsNamed) {
  const CalibrationOptions shown = optionsOf(BoardKind::kChessboard, 8, 6);
  const test::TemporaryFolder folder;
  for (int i = 0; i < 4; ++i) {
    const auto [left, right] = pair(shown, test::boardPose(shown, i, 4));
    cv::imwrite((folder.path() / ("left" + std::to_string(i) + ".png")).string(), left);
    cv::imwrite((folder.path() / ("right" + std::to_string(i) + ".png")).string(), right);
  }
  base::Progress progress;
  for (const auto& [columns, rows] : {std::pair{9, 6}, {8, 7}, {11, 8}}) {
    try {
      calibrateStereo(findStereoPairs(folder.path()), optionsOf(BoardKind::kChessboard, columns, rows),
                      progress);
      ADD_FAILURE() << columns << "x" << rows;
    } catch (const base::InputError& error) {
      EXPECT_EQ(error.fault().key, "board");
      EXPECT_NE(error.fault().reason.find("8x6"), std::string::npos) << error.what();
    }
  }
}

TEST_F(CalibrationViewsTest, ImagesThatWereNotTakenTogetherAreOutliersAndSpoilTheEpipolarLines) {
  const CalibrationOptions options = optionsOf(BoardKind::kChessboard, 9, 6);
  const test::TemporaryFolder folder;
  for (int i = 0; i < 9; ++i) {
    const auto [left, right] = pair(options, test::boardPose(options, i, 9));
    cv::imwrite((folder.path() / ("left" + std::to_string(i) + ".png")).string(), left);
    cv::imwrite((folder.path() / ("right" + std::to_string(i) + ".png")).string(), right);
  }
  CalibrationInput input = findStereoPairs(folder.path());
  std::swap(input.right[2], input.right[3]);
  base::Progress progress;
  const CalibrationReport report = calibrateStereo(input, options, progress);
  for (std::size_t i = 0; i < report.views.size(); ++i)
    EXPECT_EQ(report.views[i].outlying, i == 2 || i == 3) << i << ": " << report.views[i].epipolar_error;
  CalibrationViews views(options);
  views.addFiles(input, progress);
  for (std::size_t i = 0; i < report.views.size(); ++i) views.exclude(i, report.views[i].outlying);
  const CalibrationReport better = views.calibrate(progress);
  EXPECT_LT(better.epipolar_rms, 0.1);
  EXPECT_GT(report.epipolar_rms, 10.0 * better.epipolar_rms);
  expectRig(better, 0.1);
}

TEST(BoardCoverageTest, FollowsThePlaceTheSizeAndTheTilt) {
  const std::vector<cv::Point3f> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const cv::Size size(640, 480);
  const auto square = [&](float x, float y, float side, float lean) {
    return shapeOf(points, {{x + lean, y}, {x + side + lean, y}, {x + side, y + side}, {x, y + side}}, size);
  };
  const ViewShape straight = square(100, 100, 96, 0);
  EXPECT_NEAR(straight.x, 148.0 / 640.0, 1e-6);
  EXPECT_NEAR(straight.y, 148.0 / 480.0, 1e-6);
  EXPECT_NEAR(straight.size, 96.0 / std::sqrt(640.0 * 480.0), 1e-6);
  EXPECT_NEAR(straight.skew, 0.0, 1e-6);
  EXPECT_GT(square(100, 100, 96, 40).skew, 0.5);
  const BoardCoverage one = coverageOf({straight});
  EXPECT_EQ(one.x, 0.0);
  EXPECT_EQ(one.missing().size(), 4U);
  const BoardCoverage good = coverageOf(
      {square(0, 0, 96, 60), square(540, 380, 96, 0), square(20, 380, 96, 0), square(200, 100, 300, 0)});
  EXPECT_TRUE(good.missing().empty());
  EXPECT_TRUE(coverageOf({}).missing().size() == 4U);
}

TEST(BoardFinderTest, RefusesBoardsThatDoNotExist) {
  CalibrationOptions options = optionsOf(BoardKind::kCharuco, 9, 6);
  options.marker_size = 0.021;
  EXPECT_THROW(BoardFinder{options}, base::InputError);
  options = optionsOf(BoardKind::kAruco, 30, 20);
  EXPECT_THROW(BoardFinder{options}, base::InputError) << "more markers than the dictionary has";
}

TEST(BoardFinderTest, TheSizeOfARealBoardIsFound) {
  const fs::path folder = test::dataFolder() / "opencv-stereo";
  if (!fs::is_directory(folder))
    GTEST_SKIP() << "no " << folder << "; set CAPSTAN_DATA to the folder of measured data";
  CalibrationOptions options;
  base::Progress progress;
  CalibrationInput input = findStereoPairs(folder);
  for (auto* side : {&input.left, &input.right}) side->resize(5);
  EXPECT_EQ(calibrateStereo(input, options, progress).other_board, (std::array{0, 0}));
  options.board_columns = 8;  // a part of the board, which OpenCV finds
  EXPECT_EQ(calibrateStereo(input, options, progress).other_board, (std::array{9, 6}));
}

}  // namespace
}  // namespace capstan::vision
