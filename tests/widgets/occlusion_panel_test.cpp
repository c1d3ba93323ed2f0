#include <gtest/gtest.h>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include "tests/widgets/picture.h"
#include "widgets/panels/occlusion/occlusion_panel.h"
#include "widgets/panels/occlusion/occlusion_timeline.h"

namespace capstan::widgets {
namespace {

class Panel : public testing::Test {
 protected:
  void SetUp() override {
    panel.resize(280, 300);
    panel.show();
    QObject::connect(&panel, &OcclusionPanel::blockChanged,
                     [this](bool left, bool right) { asked.emplace_back(left, right); });
    QObject::connect(&panel, &OcclusionPanel::scheduleChanged,
                     [this](const live::OcclusionSchedule& schedule) { schedules.push_back(schedule); });
  }
  QPushButton* button(const QString& text) {
    for (auto* each : panel.findChildren<QPushButton*>())
      if (each->text() == text) return each;
    return nullptr;
  }
  using Sides = std::pair<bool, bool>;

  OcclusionPanel panel;
  std::vector<Sides> asked;
  std::vector<live::OcclusionSchedule> schedules;
};

TEST_F(Panel, ClickStaysUntilTheNext) {
  QTest::mouseClick(button("Left"), Qt::LeftButton);
  QApplication::processEvents();
  EXPECT_EQ(asked, (std::vector<Sides>{{true, false}}));
  EXPECT_TRUE(button("Left")->isChecked());
  EXPECT_FALSE(button("Both")->isChecked());
  QTest::mouseClick(button("Both"), Qt::LeftButton);
  QApplication::processEvents();
  EXPECT_EQ(asked.back(), Sides(true, true));
  EXPECT_TRUE(button("Right")->isChecked());
  QTest::mouseClick(button("Both"), Qt::LeftButton);
  QApplication::processEvents();
  EXPECT_EQ(asked.back(), Sides(false, false));
  EXPECT_FALSE(button("Left")->isChecked());
}

TEST_F(Panel, HeldBlocksOnlyAsLongAsHeld) {
  QTest::mousePress(button("Right"), Qt::LeftButton);
  EXPECT_EQ(asked, (std::vector<Sides>{{false, true}}));
  QTest::qWait(static_cast<int>(HoldToggle::kHoldMilliseconds) + 60);
  QTest::mouseRelease(button("Right"), Qt::LeftButton);
  QApplication::processEvents();
  EXPECT_EQ(asked, (std::vector<Sides>{{false, true}, {false, false}}));
  EXPECT_FALSE(button("Right")->isChecked());
}

TEST_F(Panel, KeysWorkInTheWholeWindowButNotWhileTyping) {
  QTest::keyClick(&panel, Qt::Key_L);
  EXPECT_EQ(asked, (std::vector<Sides>{{true, false}}));
  QTest::keyClick(&panel, Qt::Key_K);
  EXPECT_EQ(asked.back(), Sides(true, true));
  QTest::keyClick(&panel, Qt::Key_B);
  EXPECT_EQ(asked.back(), Sides(false, false));
  QTest::keyClick(&panel, Qt::Key_L, Qt::ControlModifier);
  EXPECT_EQ(asked.size(), 3U) << "a shortcut of somebody else";
  auto* box = panel.findChild<QDoubleSpinBox*>();
  QApplication::setActiveWindow(&panel);
  box->setFocus();
  ASSERT_EQ(QApplication::focusWidget(), box);
  QTest::keyClick(box, Qt::Key_B);
  EXPECT_EQ(asked.size(), 4U) << "no number holds a B";
  QLineEdit line(&panel);
  line.show();
  line.setFocus();
  ASSERT_EQ(QApplication::focusWidget(), &line);
  QTest::keyClick(&line, Qt::Key_B);
  EXPECT_EQ(asked.size(), 4U);
  EXPECT_EQ(line.text(), "b");
}

TEST_F(Panel, ScheduleIsThePapersAndBeginsNow) {
  tracking::Snapshot snapshot{};
  snapshot.t = 7.5;
  panel.showSnapshot(snapshot);
  QTest::mouseClick(button("40"), Qt::LeftButton);
  ASSERT_EQ(schedules.size(), 1U);
  EXPECT_EQ(schedules[0].percentage, 40.0);
  EXPECT_EQ(schedules[0].interval, 2.0);
  EXPECT_EQ(schedules[0].start, 7.5);
  auto* timeline = panel.findChild<OcclusionTimeline*>();
  timeline->resize(240, 46);
  const QImage image = test::grab(*timeline, "occlusion_timeline");
  for (double t = 7.5; t < 23.0; t += 0.53) {  // 40 %: 3 s of observation, 2 s blocked
    const bool blocked = std::fmod(t - 7.5, 5.0) >= 3.0;
    const double edge =
        std::min(std::abs(std::remainder(t - 7.5, 5.0)), std::abs(std::remainder(t - 10.5, 5.0)));
    if (edge < 0.3) continue;
    const int x = static_cast<int>(timeline->xOf(t));
    EXPECT_EQ(test::distance(image.pixel(x, 14), Theme::dark().warning.rgb()) < 8, blocked) << t;
  }
  QTest::mouseClick(button("off"), Qt::LeftButton);
  EXPECT_EQ(schedules.back().percentage, 0.0);
}

TEST_F(Panel, TheScheduleBlocksOneCameraWhoseRayIsThenNamed) {
  auto* cameras = panel.findChild<QComboBox*>("cameras");
  ASSERT_TRUE(cameras);
  QTest::mouseClick(button("40"), Qt::LeftButton);
  EXPECT_EQ(schedules.back().cameras, live::BlockedCameras::kBoth);
  QTest::keyClick(cameras, Qt::Key_Down);
  ASSERT_EQ(cameras->currentText(), "left");
  EXPECT_EQ(schedules.back().cameras, live::BlockedCameras::kLeft);
  EXPECT_EQ(schedules.back().percentage, 40.0);
  panel.showBlocked({true, false});
  const auto shown = [this](const QString& text) {
    for (const auto* label : panel.findChildren<QLabel*>())
      if (label->text() == text) return true;
    return false;
  };
  EXPECT_TRUE(shown("blocked"));
  panel.showBlocked({false, true});
  EXPECT_TRUE(shown("observable"));

  tracking::Snapshot snapshot{};
  snapshot.camera_samples = 1;
  snapshot.camera_images = true;
  snapshot.gate = tracking::Gate::kLeftLost;
  snapshot.marker[0].fault = vision::MarkerFault::kNoPixels;
  panel.showSnapshot(snapshot);
  EXPECT_EQ(panel.observation(), "now: observing the motors (q_kin)");
  snapshot.ray_used = true;
  panel.showSnapshot(snapshot);
  EXPECT_EQ(panel.observation(), "now: observing a single ray");
  EXPECT_EQ(panel.reason(), "right camera alone.");
  test::grab(panel, "occlusion_one_camera");

  panel.beginSession(3.0, false);
  EXPECT_EQ(panel.schedule().percentage, 0.0);
  EXPECT_EQ(cameras->currentText(), "left");
  panel.setSchedule({20.0, 2.0, 0.0, live::BlockedCameras::kRight});
  EXPECT_EQ(cameras->currentText(), "right");
}

TEST_F(Panel, OcclusionEndsWithItsSessionUnlessThatBeginsAgain) {
  tracking::Snapshot snapshot{};
  snapshot.t = 150.0;
  panel.showSnapshot(snapshot);
  QTest::mouseClick(button("40"), Qt::LeftButton);
  ASSERT_EQ(panel.schedule().start, 150.0);
  panel.beginSession(0.5, true);
  EXPECT_EQ(panel.schedule().start, 0.5);
  EXPECT_EQ(panel.schedule().percentage, 40.0);
  QTest::mouseClick(button("60"), Qt::LeftButton);
  EXPECT_EQ(schedules.back().start, 0.5) << "the panel's clock is the new session's";
  QTest::keyClick(&panel, Qt::Key_B);
  ASSERT_TRUE(panel.blocked()[0]);
  panel.beginSession(0.0, false);
  EXPECT_EQ(panel.schedule().percentage, 0.0);
  EXPECT_TRUE(button("off")->isChecked());
  EXPECT_FALSE(panel.blocked()[0] || panel.blocked()[1]);
}

TEST_F(Panel, SaysWhatTheFilterObservesAndWhy) {
  tracking::Snapshot snapshot{};
  snapshot.gate = tracking::Gate::kOpen;
  panel.showSnapshot(snapshot);
  EXPECT_EQ(panel.observation(), QString("now: observing the camera (q_cam)"));
  snapshot.gate = tracking::Gate::kRightLost;
  snapshot.marker[0].fault = vision::MarkerFault::kNone;
  snapshot.marker[1].fault = vision::MarkerFault::kNoPixels;
  panel.showSnapshot(snapshot);
  EXPECT_EQ(panel.observation(), QString("now: observing the motors (q_kin)"));
  EXPECT_TRUE(panel.reason().startsWith("right lost: no pixels of the marker's colour"));
  snapshot.gate = tracking::Gate::kJump;
  panel.showSnapshot(snapshot);
  EXPECT_TRUE(panel.reason().startsWith("marker jumped."));
}

TEST_F(Panel, SpeaksOfTipsWhereThereAreNoPictures) {
  tracking::Snapshot snapshot{};
  snapshot.camera_samples = 3;
  snapshot.gate = tracking::Gate::kOpen;
  panel.showSnapshot(snapshot);
  EXPECT_EQ(panel.observation(), QString("now: observing the tip (q_cam)"));
  EXPECT_EQ(panel.reason(), QString("The tip is seen."));
  snapshot.gate = tracking::Gate::kBothLost;
  snapshot.marker[0].fault = vision::MarkerFault::kNoPixels;
  panel.showSnapshot(snapshot);
  EXPECT_EQ(panel.reason(), QString("tip not seen."));
}

TEST_F(Panel, SaysThatRegistrationIsMissing) {
  tracking::Snapshot snapshot{};
  snapshot.camera_images = true;
  snapshot.camera_samples = 3;
  snapshot.gate = tracking::Gate::kUnregistered;
  panel.showSnapshot(snapshot);
  EXPECT_TRUE(panel.reason().startsWith("not registered: the marker is seen"))
      << panel.reason().toStdString();
}

TEST_F(Panel, Pictures) {
  QTest::mouseClick(button("Both"), Qt::LeftButton);
  QTest::mouseClick(button("40"), Qt::LeftButton);
  tracking::Snapshot snapshot{};
  snapshot.t = 11.0;
  snapshot.gate = tracking::Gate::kBothLost;
  snapshot.marker[0].fault = vision::MarkerFault::kNoPixels;
  panel.showSnapshot(snapshot);
  const QImage dark = test::grab(panel, "occlusion_dark");
  EXPECT_GT(test::count(dark, QRect(0, 0, 280, 50), Theme::dark().warning, 4).pixels, 500)
      << "blocked is amber";
  applyTheme(*qApp, Theme::light());
  panel.setTheme(Theme::light());
  test::grab(panel, "occlusion_light");
  applyTheme(*qApp, Theme::dark());
}

}  // namespace
}  // namespace capstan::widgets
