// The calibration panel with pictures of boards as cameras give them.
#include "widgets/panels/calibration/calibration_panel.h"

#include <gtest/gtest.h>

#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <QtTest/QTest>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/vision/rig_file.h"
#include "tests/core/vision/board_for_tests.h"
#include "tests/core/vision/rig_for_tests.h"
#include "tests/support/temporary_folder.h"
#include "tests/widgets/picture.h"
#include "widgets/panels/calibration/board_form.h"

namespace capstan::widgets {
namespace {

using vision::BoardKind;
using vision::CalibrationOptions;

class CalibrationPanelTest : public testing::Test {
 protected:
  CalibrationPanelTest() {
    panel_.resize(panel_.sizeHint());
    panel_.show();
  }
  static CalibrationOptions board(int columns = 9, int rows = 6) {
    CalibrationOptions options;
    options.board_columns = columns;
    options.board_rows = rows;
    options.square_size = 0.02;
    return options;
  }
  tracking::StereoFrame frame(const CalibrationOptions& options, const Eigen::Isometry3d& pose) {
    const test::BoardPicture picture = test::pictureOf(options);
    tracking::StereoFrame frame;
    static const test::BoardCamera left(vision::testRig().left), right(vision::testRig().right);
    cv::cvtColor(left.image(picture, pose, random_), frame.left, cv::COLOR_GRAY2BGR);
    cv::cvtColor(right.image(picture, rig_.right_from_left * pose, random_), frame.right, cv::COLOR_GRAY2BGR);
    return frame;
  }
  /// Shows the frame twice, as a camera before a board at rest does.
  void show(tracking::StereoFrame frame) {
    for (int i = 0; i < 2; ++i) {
      frame.t = t_ += 0.1;
      panel_.showFrames(frame);
      ASSERT_TRUE(QTest::qWaitFor([&] { return !panel_.busy(); }, 20000));
    }
  }
  QPushButton* button(const QString& text) {
    for (auto* each : panel_.findChildren<QPushButton*>())
      if (each->text() == text) return each;
    return nullptr;
  }
  void fit() {
    button("Calibrate")->click();
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel_.report().has_value() && !panel_.busy(); }, 20000))
        << panel_.message().toStdString();
  }

  vision::StereoRig rig_ = vision::testRig();
  base::Random random_{19};
  double t_ = 0.0;
  CalibrationPanel panel_;
};

TEST_F(CalibrationPanelTest, LeadsFromViewsToFiles) {
  panel_.form().setOptions(board());
  button("Clear")->click();
  EXPECT_FALSE(button("Calibrate")->isEnabled());
  EXPECT_FALSE(button("Save calibration…")->isEnabled());
  button("Collect views")->click();
  tracking::StereoFrame empty;
  empty.left = empty.right = cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(120));
  show(empty);
  EXPECT_TRUE(panel_.message().contains("Show the whole board")) << panel_.message().toStdString();
  for (int i = 0; i < 7; ++i) show(frame(board(), test::boardPose(board(), i, 7)));
  test::grab(panel_, "calibration_collecting");
  const auto views = panel_.views().views().size();
  ASSERT_GE(views, 5U);
  auto* table = panel_.findChild<QTableWidget*>();
  EXPECT_EQ(table->rowCount(), static_cast<int>(views));
  fit();
  EXPECT_FALSE(panel_.collecting());
  EXPECT_NEAR(panel_.report()->rig.left.fx, rig_.left.fx, 0.01 * rig_.left.fx);
  test::grab(panel_, "calibration_result");

  table->item(0, 0)->setCheckState(Qt::Unchecked);
  EXPECT_FALSE(panel_.report()) << "it was of other views";
  EXPECT_FALSE(button("Save calibration…")->isEnabled());
  fit();
  EXPECT_EQ(panel_.report()->views_used, static_cast<int>(views) - 1);

  const test::TemporaryFolder folder;
  ASSERT_TRUE(panel_.save(QString::fromStdString(folder.path().string()))) << panel_.message().toStdString();
  const vision::StereoRig read = vision::readRig(folder.path());
  EXPECT_NEAR(read.left.fx, panel_.report()->rig.left.fx, 1e-6);
  ASSERT_TRUE(panel_.saveImages(QString::fromStdString(folder.path().string())));
  EXPECT_EQ(vision::findStereoPairs(folder.path()).left.size(), views);
  EXPECT_FALSE(panel_.save("/proc/nowhere"));
  EXPECT_TRUE(panel_.message().contains("/proc/nowhere")) << panel_.message().toStdString();
}

TEST_F(CalibrationPanelTest, AFolderWithAnotherBoardOffersItsSize) {
  const test::TemporaryFolder folder;
  for (int i = 0; i < 5; ++i) {
    const auto pair = frame(board(8, 6), test::boardPose(board(8, 6), i, 5));
    cv::imwrite((folder.path() / ("left" + std::to_string(i) + ".png")).string(), pair.left);
    cv::imwrite((folder.path() / ("right" + std::to_string(i) + ".png")).string(), pair.right);
  }
  const QString path = QString::fromStdString(folder.path().string());
  panel_.form().setOptions(board());
  button("Clear")->click();
  panel_.addFolder(path);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !panel_.busy(); }, 60000));
  EXPECT_EQ(panel_.views().used(), 0U);
  auto* use = button("Use 8 × 6");
  ASSERT_TRUE(use) << panel_.message().toStdString();
  test::grab(panel_, "calibration_other_board");
  use->click();
  EXPECT_EQ(panel_.form().options().board_columns, 8);
  panel_.addFolder(path);
  ASSERT_TRUE(QTest::qWaitFor([&] { return panel_.views().used() == 5U; }, 60000));
  panel_.addFolder("/proc/nowhere");
  EXPECT_TRUE(panel_.message().contains("/proc/nowhere")) << panel_.message().toStdString();
}

TEST_F(CalibrationPanelTest, ABoardThatCannotExistIsRefusedAndTheFormSaysWhy) {
  CalibrationOptions options = board();
  options.board = BoardKind::kCharuco;
  options.marker_size = 0.5 * options.square_size;
  panel_.form().setOptions(options);
  panel_.findChild<QDoubleSpinBox*>("marker")->setValue(25.0);
  EXPECT_TRUE(panel_.message().contains("marker_size")) << panel_.message().toStdString();
  test::grab(panel_, "calibration_refused");
}

TEST_F(CalibrationPanelTest, Light) {
  applyTheme(*qApp, Theme::light());
  panel_.setTheme(Theme::light());
  panel_.form().setOptions(board());
  button("Clear")->click();
  button("Collect views")->click();
  for (int i = 0; i < 4; ++i) show(frame(board(), test::boardPose(board(), i, 4)));
  fit();
  EXPECT_GT(
      test::count(test::grab(panel_, "calibration_light"), panel_.rect(), Theme::light().accent, 8).pixels,
      100)
      << "bars";
  applyTheme(*qApp, Theme::dark());
}

}  // namespace
}  // namespace capstan::widgets
