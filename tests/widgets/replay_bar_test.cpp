#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QTest>

#include "tests/widgets/picture.h"
#include "tests/widgets/scene_snapshot.h"
#include "widgets/panels/replay/replay_bar.h"

namespace capstan::widgets {
namespace {

class ReplayBarTest : public testing::Test {
 protected:
  ReplayBarTest() {
    const robot::ArmKinematics arm(test::leftArm());
    for (int i = 0; i <= 2000; ++i) {
      tracking::Snapshot s =
          test::snapshotAt(arm, 0.01 * i, {0.5, 1.5, 0.4}, Eigen::Vector3d::Constant(1e-3));
      s.motor_updated = true;
      s.q_link_ukf_sigma.setConstant(1e-3);
      history_.append(s);
    }
    bar_.resize(900, 50);
    bar_.show();
    bar_.begin(0.0, 40.0);
    bar_.setNewest(20.0);
    for (const auto& [t, kind] : {std::pair{5.0, "note"}, {12.0, "fault"}, {12.0, "occlusion"}})
      bar_.addEvent(t, kind, "text");
  }
  void click(double t, Qt::KeyboardModifiers keys = {}) {
    TimeLine& line = bar_.line();
    QTest::mouseClick(&line, Qt::LeftButton, keys, {line.placeOf(t), line.height() / 3});
  }

  JointHistory history_;
  ReplayBar bar_{history_};
};

TEST_F(ReplayBarTest, AClickShowsATimeThatWasTracked) {
  QSignalSpy reviewed(&bar_, &ReplayBar::reviewed);
  EXPECT_FALSE(bar_.reviewing());
  click(8.0);
  ASSERT_EQ(reviewed.size(), 1);
  EXPECT_NEAR(reviewed[0][0].toDouble(), 8.0, 0.1);
  click(30.0);
  EXPECT_NEAR(*bar_.time(), 20.0, 1e-9) << "not tracked yet";
  test::grab(bar_, "replay_bar");
  bar_.follow();
  EXPECT_FALSE(bar_.reviewing());
}

TEST_F(ReplayBarTest, KeysGoFromEventToEventAndFrameByFrame) {
  bar_.review(0.0);
  QTest::keyClick(&bar_, Qt::Key_Right);
  EXPECT_DOUBLE_EQ(*bar_.time(), 5.0);
  QTest::keyClick(&bar_, Qt::Key_Right);
  QTest::keyClick(&bar_, Qt::Key_Right);
  EXPECT_DOUBLE_EQ(*bar_.time(), 12.0) << "two events of one time are one place, and there is no third";
  QTest::keyClick(&bar_, Qt::Key_Left);
  EXPECT_DOUBLE_EQ(*bar_.time(), 5.0);
  QTest::keyClick(&bar_, Qt::Key_Right, Qt::ShiftModifier);
  EXPECT_NEAR(*bar_.time(), 5.0 + 1.0 / 15.0, 1e-9);
  QTest::keyClick(&bar_, Qt::Key_Escape);
  EXPECT_FALSE(bar_.reviewing());
}

TEST_F(ReplayBarTest, PlaysALoopAtItsSpeed) {
  bar_.setSpeed(20.0);
  bar_.setLoop({6.0, 8.0});
  QSignalSpy reviewed(&bar_, &ReplayBar::reviewed);
  QTest::keyClick(&bar_, Qt::Key_P);
  ASSERT_TRUE(bar_.playing());
  QTest::qWait(600);
  QTest::keyClick(&bar_, Qt::Key_P);
  EXPECT_FALSE(bar_.playing());
  int wrapped = 0;
  for (int i = 1; i < reviewed.size(); ++i)
    wrapped += reviewed[i][0].toDouble() < reviewed[i - 1][0].toDouble();
  EXPECT_GE(wrapped, 2) << "12 s of session in a loop of 2 s";
  for (const auto& each : reviewed) EXPECT_LE(each[0].toDouble(), 8.0);
}

TEST_F(ReplayBarTest, ShiftAndDragChooseALoop) {
  TimeLine& line = bar_.line();
  QTest::mousePress(&line, Qt::LeftButton, Qt::ShiftModifier, {line.placeOf(4.0), 10});
  QMouseEvent move(QEvent::MouseMove, QPointF(line.placeOf(9.0), 10), Qt::NoButton, Qt::LeftButton,
                   Qt::ShiftModifier);
  QCoreApplication::sendEvent(&line, &move);
  ASSERT_TRUE(bar_.loop().closed());
  EXPECT_NEAR(*bar_.loop().from, 4.0, 0.1);
  EXPECT_NEAR(*bar_.loop().to, 9.0, 0.1);
  EXPECT_FALSE(bar_.reviewing()) << "a loop alone moves nothing";
}

}  // namespace
}  // namespace capstan::widgets
