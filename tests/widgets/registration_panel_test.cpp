#include <gtest/gtest.h>

#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QTabWidget>
#include <QTest>
#include <opencv2/imgproc.hpp>

#include "core/live/arm_overlay.h"
#include "tests/widgets/picture.h"
#include "tests/widgets/registration_feed.h"
#include "widgets/panels/registration/collect_page.h"
#include "widgets/panels/registration/registration_panel.h"
#include "widgets/panels/registration/result_page.h"
#include "widgets/panels/registration/stop_page.h"
#include "widgets/video/stereo_view.h"

namespace capstan::widgets {
namespace {

class Panel : public testing::Test {
 protected:
  void begin(bool live) {
    tracking::SourceInfo source;
    source.robot = feed.robot;
    source.rig = test::stereoRig();
    source.live = live;
    panel.resize(700, 640);
    panel.show();
    panel.begin(source, test::cameraBefore(feed.arm.tip(feed.stop)));
  }
  void run(double seconds) {
    for (int i = 0; i < 1000 * seconds; ++i) panel.showSnapshot(feed.next());
  }
  void click(const QString& text) {
    for (auto* each : panel.findChildren<QPushButton*>())
      if (each->text() == text && each->isVisible() && each->isEnabled())
        return QTest::mouseClick(each, Qt::LeftButton);
    ADD_FAILURE() << "no button " << text.toStdString() << " to click";
  }
  /// Both images with the shaft and the marker where the true cameras see them.
  std::array<cv::Mat, 2> frames() const {
    std::array<cv::Mat, 2> images;
    const auto seen =
        live::projectArm(feed.arm, feed.robot.marker_radius, test::stereoRig(), feed.truth, feed.q);
    for (std::size_t side = 0; side < 2; ++side) {
      images[side] = cv::Mat(480, 640, CV_8UC3, cv::Scalar(92, 96, 104));
      const auto point = [](const Eigen::Vector2d& p) { return cv::Point(cvRound(p.x()), cvRound(p.y())); };
      const auto& shaft = seen.sides[side].shaft;
      for (std::size_t i = 1; i < shaft.size(); ++i)
        cv::line(images[side], point(shaft[i - 1]), point(shaft[i]), {170, 170, 170}, 6, cv::LINE_AA);
      cv::circle(images[side], point(*seen.sides[side].marker), cvRound(seen.sides[side].marker_radius),
                 {60, 190, 50}, cv::FILLED, cv::LINE_AA);
    }
    return images;
  }

  /// The next snapshot with what a perfect detector says of frames().
  tracking::Snapshot seen() {
    tracking::Snapshot snapshot = feed.next();
    const auto arm =
        live::projectArm(feed.arm, feed.robot.marker_radius, test::stereoRig(), feed.truth, feed.q);
    for (std::size_t side = 0; side < 2; ++side) {
      auto& marker = snapshot.marker[side];
      marker.centroid = *arm.sides[side].marker;
      marker.radius = arm.sides[side].marker_radius;
      marker.sigma = 0.08;
      marker.roi = {cvRound(marker.centroid.x()) - 50, cvRound(marker.centroid.y()) - 50, 100, 100};
    }
    return snapshot;
  }

  test::RegistrationFeed feed;
  RegistrationPanel panel;
};

TEST_F(Panel, LeadsFromTheStopToAnAcceptedRegistration) {
  begin(true);
  bool driven = false;
  std::optional<Eigen::Isometry3d> taken;
  QObject::connect(&panel, &RegistrationPanel::driveToHardStopRequested, [&] { driven = true; });
  QObject::connect(&panel, &RegistrationPanel::accepted,
                   [&](const Eigen::Isometry3d& pose) { taken = pose; });
  feed.q = feed.stop - Eigen::Vector3d(0.3, 0.1, 0.05);
  run(0.2);
  test::grab(panel, "registration_1_away");
  click("Drive to the hard stop");
  EXPECT_TRUE(driven);
  feed.q = feed.stop;
  run(1.0);
  test::grab(panel, "registration_1_arrived");
  click("Collect frames");
  feed.outlier_every = 12;
  run(2.5);
  test::grab(panel, "registration_2_collecting");
  EXPECT_GT(panel.collectPage().plot().usedShown(), 30);
  EXPECT_EQ(panel.collectPage().plot().outliersShown(), panel.guide()->scatter().outliers);
  EXPECT_GT(panel.collectPage().plot().outliersShown(), 1);
  run(3.0);
  ASSERT_EQ(panel.guide()->step(), registration::RegistrationStep::kReview);
  const auto images = frames();
  panel.showFrames(images[0], images[1], seen());
  const QImage picture = test::grab(panel, "registration_3_result");
  EXPECT_TRUE(panel.resultPage().summary().contains(QString::fromUtf8("±")));
  RoiView& left = panel.resultPage().pictures().left();
  const QRect area(left.mapTo(&panel, left.mainMap().target.topLeft().toPoint()),
                   left.mainMap().target.size().toSize());
  EXPECT_GT(test::count(picture, area, Theme::dark().colour(Quantity::kUkf), 16).pixels, 60) << "new";
  EXPECT_GT(test::count(picture, area, Theme::dark().colour(Quantity::kKinematic), 16).pixels, 40) << "old";
  click("Accept");
  ASSERT_TRUE(taken);
  EXPECT_LT((taken->translation() - feed.truth.translation()).norm(), 6e-4);
  EXPECT_FALSE(panel.active());
}

TEST_F(Panel, EveryPageHasItsButtonsInAWindowOf1280By800) {
  QScrollArea dock;  // as in the window
  dock.setWidgetResizable(true);
  dock.setFrameShape(QFrame::NoFrame);
  auto* inside = new RegistrationPanel;
  dock.setWidget(inside);
  dock.resize(622, 676);
  tracking::SourceInfo source;
  source.robot = feed.robot;
  source.rig = test::stereoRig();
  source.live = true;
  dock.show();
  inside->begin(source, test::cameraBefore(feed.arm.tip(feed.stop)));
  auto* tabs = inside->findChild<QTabWidget*>();
  const auto fits = [&](const char* page) {
    QApplication::processEvents();
    EXPECT_EQ(dock.verticalScrollBar()->maximum(), 0) << page;
    test::grab(dock, QString("registration_1280_%1").arg(page));
  };
  fits("stop");
  tabs->setCurrentIndex(1);
  fits("poses");
  tabs->setCurrentIndex(2);
  fits("history");
  tabs->setCurrentIndex(0);
  const auto run = [&](double seconds) {
    for (int i = 0; i < 1000 * seconds; ++i) inside->showSnapshot(feed.next());
  };
  run(1.0);
  for (auto* each : inside->findChildren<QPushButton*>())
    if (each->text() == "Collect frames") each->click();
  feed.outlier_every = 12;
  run(2.5);
  fits("frames");
  run(3.0);
  ASSERT_EQ(inside->guide()->step(), registration::RegistrationStep::kReview);
  const auto images = frames();
  inside->showFrames(images[0], images[1], seen());
  fits("result");
}

TEST_F(Panel, RefusalIsShownWithReasonAndAdvice) {
  begin(false);
  run(1.0);
  click("Collect frames");
  feed.fault = vision::MarkerFault::kNoPixels;
  run(5.0);
  ASSERT_EQ(panel.guide()->step(), registration::RegistrationStep::kRefused);
  EXPECT_TRUE(panel.collectPage().refusal().contains("too few detections"));
  EXPECT_TRUE(panel.collectPage().refusal().contains("Unblock the view"));
  test::grab(panel, "registration_2_refused");
  feed.fault = vision::MarkerFault::kNone;
  click("Collect again");
  run(5.0);
  EXPECT_EQ(panel.guide()->step(), registration::RegistrationStep::kReview);
}

TEST_F(Panel, RejectionNeedsAReason) {
  begin(false);
  run(1.0);
  click("Collect frames");
  run(5.0);
  QString reason;
  QObject::connect(&panel, &RegistrationPanel::rejected, [&](const QString& text) { reason = text; });
  QPushButton* reject = nullptr;
  for (auto* each : panel.findChildren<QPushButton*>())
    if (each->text() == "Reject") reject = each;
  ASSERT_TRUE(reject);
  EXPECT_FALSE(reject->isEnabled());
  Q_EMIT panel.resultPage().rejectRequested("wrong thing detected");
  EXPECT_EQ(reason, "wrong thing detected");
  EXPECT_FALSE(panel.active());
}

TEST_F(Panel, LightThemeSmall) {
  applyTheme(*qApp, Theme::light());
  panel.setTheme(Theme::light());
  begin(false);
  panel.resize(520, 520);
  run(1.0);
  click("Collect frames");
  run(2.0);
  const QImage picture = test::grab(panel, "registration_light_collecting");
  EXPECT_GT(test::count(picture, picture.rect(), Theme::light().colour(Quantity::kCamera), 20).pixels, 100);
  run(3.0);
  const auto images = frames();
  panel.showFrames(images[0], images[1], seen());
  test::grab(panel, "registration_light_result");
  applyTheme(*qApp, Theme::dark());
}

}  // namespace
}  // namespace capstan::widgets
