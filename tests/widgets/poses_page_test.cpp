#include <gtest/gtest.h>

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QTest>

#include "core/base/random.h"
#include "tests/widgets/picture.h"
#include "tests/widgets/scene_snapshot.h"
#include "widgets/panels/registration/poses_page.h"

namespace capstan::widgets {
namespace {

class PosesPageTest : public testing::Test {
 protected:
  PosesPageTest() {
    page_.resize(680, 620);
    page_.show();
    page_.begin(robot_, test::cameraBefore(arm_.tip(robot::homingOf(robot_))));
  }
  void visit(int poses) {
    for (int i = 0; i < poses; ++i) {
      const Eigen::Vector3d q(random_.uniform(0.2, 1.4), random_.uniform(0.8, 2.0),
                              random_.uniform(-0.25, -0.05));
      for (int frame = 0; frame < 4; ++frame) {
        tracking::Snapshot s = test::snapshotAt(arm_, t_ += 0.066, q, Eigen::Vector3d::Constant(1e-3));
        s.camera_updated = true;
        s.tip_kin_cam = arm_.tip(q);
        s.transmission.scale(0) = travel_error_;
        s.tip_in_camera = truth_.inverse() * s.tip_kin_cam;
        for (int axis = 0; axis < 3; ++axis) s.tip_in_camera(axis) += random_.normal(0.0, 3e-4);
        page_.showSnapshot(s);
      }
    }
  }
  QPushButton* button(const QString& text) {
    for (auto* each : page_.findChildren<QPushButton*>())
      if (each->text() == text) return each;
    return nullptr;
  }

  robot::Description robot_ = test::leftArm();
  robot::ArmKinematics arm_{robot_};
  Eigen::Isometry3d truth_ = test::cameraBefore(arm_.tip(robot::homingOf(robot_))) *
                             Eigen::AngleAxisd(0.08, Eigen::Vector3d::UnitY());
  base::Random random_{3};
  double t_ = 0.0, travel_error_ = 0.0;
  PosesPage page_;
};

TEST_F(PosesPageTest, LeadsFromPosesOverACheckToAcceptance) {
  std::optional<Eigen::Isometry3d> accepted;
  QObject::connect(&page_, &PosesPage::accepted, [&](const Eigen::Isometry3d& pose) { accepted = pose; });
  EXPECT_FALSE(button("Accept")->isEnabled());
  button("Collect poses")->click();
  visit(3);
  EXPECT_FALSE(button("Accept")->isEnabled()) << "three poses leave nothing by which to judge one";
  test::grab(page_, "poses_too_few");
  visit(9);
  EXPECT_EQ(page_.findChild<QTableWidget*>()->rowCount(), 12);
  EXPECT_TRUE(page_.summary().contains("leave-one-out"));
  EXPECT_TRUE(page_.summary().contains("turned 4.5")) << page_.summary().toStdString();
  page_.findChild<QTableWidget*>()->item(2, 0)->setCheckState(Qt::Unchecked);
  EXPECT_TRUE(page_.collector()->poses()[2].excluded);
  button("Check at three more poses")->click();
  visit(3);
  EXPECT_EQ(page_.collector()->checks().size(), 3u);
  test::grab(page_, "poses_checked");
  button("Accept")->click();
  ASSERT_TRUE(accepted);
  EXPECT_LT((accepted->translation() - truth_.translation()).norm(), 5e-3);
  EXPECT_FALSE(page_.active());
}

TEST_F(PosesPageTest, WarnsOfPosesByAWrongRobotFile) {
  const auto warns = [&] {
    for (const auto* label : page_.findChildren<QLabel*>())
      if (label->isVisible() && label->text().contains("q1 travel +7.0 %")) return true;
    return false;
  };
  button("Collect poses")->click();
  visit(6);
  EXPECT_FALSE(warns());
  travel_error_ = 0.07;
  visit(1);
  EXPECT_TRUE(warns());
  test::grab(page_, "poses_wrong_robot");
  page_.setRobot(robot_);
  EXPECT_FALSE(warns()) << "the poses are those of another robot file now";
}

TEST_F(PosesPageTest, RejectionNeedsAReason) {
  QString reason;
  QObject::connect(&page_, &PosesPage::rejected, [&](const QString& text) { reason = text; });
  button("Collect poses")->click();
  visit(6);
  EXPECT_FALSE(button("Reject")->isEnabled());
  page_.findChild<QComboBox*>()->setEditText("only a trial");
  button("Reject")->click();
  EXPECT_EQ(reason, "only a trial");
  EXPECT_TRUE(page_.collector()->poses().empty());
}

}  // namespace
}  // namespace capstan::widgets
