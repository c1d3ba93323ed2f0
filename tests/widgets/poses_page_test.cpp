#include <gtest/gtest.h>

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QTableWidget>
#include <QTemporaryDir>
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
  /// Whether a visible text contains `words`.
  bool says(const QString& words) const {
    for (const auto* label : page_.findChildren<QLabel*>())
      if (label->isVisible() && label->text().contains(words)) return true;
    return false;
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

TEST_F(PosesPageTest, WarnsOfPosesByAWrongRobotFileBesideItsOtherTexts) {
  button("Collect poses")->click();
  visit(6);
  EXPECT_FALSE(says("q1 travel +7.0 %"));
  travel_error_ = 0.07;
  visit(1);
  EXPECT_TRUE(says("q1 travel +7.0 %"));
  EXPECT_TRUE(says("7 pairs leave a wrong one hard to recognise"));
  test::grab(page_, "poses_wrong_robot");
  page_.setRobot(robot_);
  EXPECT_FALSE(says("q1 travel +7.0 %")) << "the poses are those of another robot file now";
  button("Clear")->click();
  button("Collect poses")->click();
  visit(2);
  EXPECT_TRUE(says("q1 travel +7.0 %"));
  EXPECT_TRUE(says("Add poses that span the workspace"));
  test::grab(page_, "poses_wrong_robot_too_few");
}

TEST_F(PosesPageTest, ButtonsStayWhereTheyAreWhateverTheTextsSay) {
  QScrollArea dock;  // as in the window: its content has its preferred height where there is room
  dock.setWidgetResizable(true);
  dock.setWidget(&page_);
  dock.show();
  for (const QSize size : {QSize(680, 620), QSize(560, 400)}) {
    dock.resize(size);
    page_.begin(robot_, {});
    QApplication::processEvents();
    const auto places = [&] {
      QApplication::processEvents();
      std::vector<QRect> all;
      for (auto* each : page_.findChildren<QPushButton*>())
        all.emplace_back(each->mapTo(&page_, QPoint()), each->size());
      return all;
    };
    const auto before = places();
    ASSERT_EQ(before.size(), 6u);
    button("Collect poses")->click();
    EXPECT_EQ(places(), before);
    visit(3);
    EXPECT_EQ(places(), before) << "too few poses";
    travel_error_ = 0.07;
    visit(12);
    EXPECT_EQ(places(), before) << "a fit, and a wrong robot file";
    button("Check at three more poses")->click();
    EXPECT_EQ(places(), before);
    visit(3);
    EXPECT_EQ(places(), before) << "a check";
    test::grab(page_, QString("poses_full_%1").arg(size.width()));
    EXPECT_EQ(dock.verticalScrollBar()->maximum(), 0) << size.height();
    for (auto* each : page_.findChildren<QPushButton*>())
      EXPECT_TRUE(page_.rect().contains(QRect(each->mapTo(&page_, QPoint()), each->size())));
    button("Clear")->click();
    travel_error_ = 0.0;
  }
  dock.takeWidget();
}

TEST_F(PosesPageTest, TheResultOfAFailedCheckIsReadWhole) {
  page_.resize(560, 400);
  button("Collect poses")->click();
  visit(8);
  button("Check at three more poses")->click();
  truth_.translation().x() += 0.012;  // another mark is detected
  visit(3);
  for (const auto* label : page_.findChildren<QLabel*>())
    if (label->text().contains("does not hold")) {
      EXPECT_TRUE(label->text().endsWith("another mark was detected.")) << label->text().toStdString();
      EXPECT_LE(label->heightForWidth(label->width()), label->height());
      return;
    }
  FAIL() << "the check does not fail";
}

TEST_F(PosesPageTest, WithoutARegistrationNoneIsSaidToBeInUse) {
  EXPECT_TRUE(says("Compares the registration in use"));
  page_.begin(robot_, {});
  EXPECT_FALSE(says("the registration in use"));
  EXPECT_TRUE(says("No registration is in use"));
  page_.setCurrent(Eigen::Isometry3d::Identity());  // accepted at the hard stop
  EXPECT_TRUE(says("Compares the registration in use"));
  EXPECT_TRUE(button("Check at three more poses")->isEnabled());
  page_.begin(robot_, {});
  button("Collect poses")->click();
  visit(8);
  EXPECT_TRUE(says("Compares the fit"));
  EXPECT_FALSE(page_.summary().contains("from the one in use")) << page_.summary().toStdString();
}

TEST_F(PosesPageTest, KeepsPosesThatAreNeitherAcceptedNorSaved) {
  const QTemporaryDir folder;
  button("Collect poses")->click();
  EXPECT_FALSE(page_.unsaved());
  visit(6);
  EXPECT_TRUE(page_.unsaved());
  page_.begin(robot_, {});
  EXPECT_EQ(page_.collector()->poses().size(), 6u) << "the same session begins again";
  EXPECT_FALSE(page_.active());
  button("Collect more")->click();
  visit(2);
  EXPECT_EQ(page_.collector()->poses().size(), 8u);

  page_.begin(robot_, {}, "in the session a.capstan");
  EXPECT_EQ(page_.collector()->poses().size(), 8u);
  EXPECT_TRUE(page_.elsewhere());
  EXPECT_TRUE(says("in the session a.capstan"));
  for (const char* text : {"Collect more", "Check at three more poses", "Accept"})
    EXPECT_FALSE(button(text)->isEnabled()) << text;
  test::grab(page_, "poses_elsewhere");
  page_.begin(robot_, {});
  EXPECT_FALSE(page_.elsewhere()) << "back in the session of the poses";
  EXPECT_TRUE(button("Accept")->isEnabled());
  EXPECT_FALSE(page_.saveTo(folder.filePath("no/such/folder/poses.csv")));
  EXPECT_TRUE(page_.unsaved());
  EXPECT_TRUE(says("no/such/folder"));
  EXPECT_TRUE(page_.saveTo(folder.filePath("poses.csv")));
  EXPECT_FALSE(page_.unsaved());
  EXPECT_FALSE(says("no/such/folder"));
  page_.begin(robot_, {}, "in the session a.capstan");
  EXPECT_TRUE(page_.collector()->poses().empty()) << "they are in a file";
}

TEST_F(PosesPageTest, AcceptedPosesAreNotUnsaved) {
  button("Collect poses")->click();
  visit(8);
  EXPECT_TRUE(page_.unsaved());
  button("Accept")->click();
  EXPECT_FALSE(page_.unsaved());
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
