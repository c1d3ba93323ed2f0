#include <gtest/gtest.h>

#include <QPushButton>
#include <QSpinBox>
#include <QTemporaryDir>
#include <QTest>
#include <opencv2/imgproc.hpp>

#include "tests/widgets/picture.h"
#include "widgets/panels/marker/marker_panel.h"
#include "widgets/panels/marker/marker_picture.h"

namespace capstan::widgets {
namespace {

class MarkerPanelTest : public testing::Test {
 protected:
  MarkerPanelTest() {
    panel_.resize(820, 560);
    panel_.show();
    panel_.begin({});
    frame_.left = picture({200, 150});
    frame_.right = picture({160, 150});
    panel_.showFrames(frame_);
    QObject::connect(&panel_, &MarkerPanel::optionsChanged,
                     [this](const vision::MarkerOptions& options) { used_.push_back(options); });
  }
  static cv::Mat picture(const cv::Point& at) {
    cv::Mat image(240, 320, CV_8UC3, cv::Scalar(80, 110, 105));
    cv::circle(image, at, 11, cv::Scalar(30, 40, 180), cv::FILLED, cv::LINE_AA);
    return image;
  }
  void click(int side, const QPoint& pixel) {
    MarkerPicture& picture = panel_.picture(side);
    QTest::mouseClick(&picture, Qt::LeftButton, {}, picture.place(pixel));
  }

  tracking::StereoFrame frame_;
  std::vector<vision::MarkerOptions> used_;
  MarkerPanel panel_;
};

TEST_F(MarkerPanelTest, AClickOnTheMarkerGivesItsLimits) {
  click(1, {160, 150});
  ASSERT_EQ(used_.size(), 1u);
  EXPECT_TRUE(used_[0].hue_low > used_[0].hue_high) << "red wraps";
  EXPECT_GT(used_[0].saturation_low, 60);
  EXPECT_TRUE(panel_.message().contains("right picture"));
  const QImage shown = test::grab(panel_, "marker_picked");
  MarkerPicture& left = panel_.picture(0);
  const QColor tint = shown.pixelColor(left.mapTo(&panel_, left.place({200, 150})));
  EXPECT_GT(tint.blue(), 120) << "tinted in the other picture, too";
  for (auto* each : panel_.findChildren<QPushButton*>())
    if (each->text() == "Undo") each->click();
  ASSERT_EQ(used_.size(), 2u);
  EXPECT_EQ(used_[1].hue_low, vision::MarkerOptions{}.hue_low);
}

TEST_F(MarkerPanelTest, AClickBesideItSaysWhyNot) {
  click(0, {40, 40});
  EXPECT_TRUE(used_.empty());
  EXPECT_TRUE(panel_.message().contains(", at 40, 40 px. ")) << panel_.message().toStdString();
  test::grab(panel_, "marker_refused");
}

TEST_F(MarkerPanelTest, LimitsByHandAndFromAFile) {
  panel_.findChild<QSpinBox*>("hue_low")->setValue(170);
  ASSERT_EQ(used_.size(), 1u);
  EXPECT_EQ(used_[0].hue_low, 170);
  QTemporaryDir folder;
  ASSERT_TRUE(panel_.saveFile(folder.filePath("m.yaml")));
  panel_.begin({});
  ASSERT_TRUE(panel_.openFile(folder.filePath("m.yaml")));
  EXPECT_EQ(panel_.options().hue_low, 170);
  EXPECT_FALSE(panel_.openFile(folder.filePath("none.yaml")));
  EXPECT_TRUE(panel_.message().contains("none.yaml"));
}

}  // namespace
}  // namespace capstan::widgets
