#include <gtest/gtest.h>

#include <QPushButton>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>

#include "core/base/yaml.h"
#include "core/registration/registration_difference.h"
#include "core/vision/registration_file.h"
#include "tests/widgets/picture.h"
#include "tests/widgets/scene_snapshot.h"
#include "widgets/panels/registration/history_page.h"

namespace capstan::widgets {
namespace {

using registration::Decision;
using registration::HistoryEntry;

class HistoryPageTest : public testing::Test {
 protected:
  HistoryPageTest() {
    page_.resize(680, 460);
    page_.show();
    QObject::connect(&page_, &HistoryPage::useRequested,
                     [this](const HistoryEntry& entry) { asked_ = entry; });
  }
  ~HistoryPageTest() override { applyTheme(*qApp, Theme::dark()); }

  static Eigen::Isometry3d poseAt(double shift) {
    Eigen::Isometry3d pose(Eigen::AngleAxisd(0.4 + 0.1 * shift, Eigen::Vector3d::UnitX()));
    pose.translation() = Eigen::Vector3d(0.1 + 1e-3 * shift, 0.2, 0.3);
    return pose;
  }
  HistoryEntry entryOn(int day, Decision decision, const std::optional<Eigen::Isometry3d>& pose) const {
    HistoryEntry entry;
    entry.date = "2026-11-0" + std::to_string(day) + "T09:30:00";
    entry.decision = decision;
    entry.robot = robot_.name;
    entry.session = "monday";
    if (pose) {
      entry.setPose(*pose);
      entry.rms = 4.2e-4;
      entry.used = 18;
      entry.excluded = 2;
    }
    return entry;
  }
  /// Accepted, rejected with and without a result, accepted: the last one is in use.
  void show() {
    auto rejected = entryOn(2, Decision::kRejected, poseAt(4.0));
    rejected.reason = "overlay does not lie on the arm";
    auto nothing = entryOn(3, Decision::kRejected, std::nullopt);
    nothing.reason = "too few poses";
    page_.setRobot(robot_);
    page_.setCurrent(poseAt(2.0));
    page_.setEntries({entryOn(1, Decision::kAccepted, poseAt(0.0)), rejected, nothing,
                      entryOn(4, Decision::kAccepted, poseAt(2.0))});
  }
  QPushButton& button(const QString& text) {
    for (auto* each : page_.findChildren<QPushButton*>())
      if (each->text() == text) return *each;
    ADD_FAILURE() << "no button " << text.toStdString();
    return *page_.findChild<QPushButton*>();
  }
  QString cellAt(int row, int column) { return page_.findChild<QTableWidget*>()->item(row, column)->text(); }

  robot::Description robot_ = test::leftArm();
  HistoryPage page_;
  std::optional<HistoryEntry> asked_;
  QTemporaryDir folder_;
};

TEST_F(HistoryPageTest, ShowsDateResidualAndReasonNewestFirst) {
  show();
  EXPECT_EQ(cellAt(0, 0), "2026-11-04 09:30");
  EXPECT_EQ(cellAt(0, 1), "accepted, in use");
  EXPECT_EQ(cellAt(0, 3), "0.42");
  EXPECT_EQ(cellAt(0, 4), "18, 2 out");
  EXPECT_EQ(cellAt(1, 3), "–");
  EXPECT_EQ(cellAt(2, 5), "overlay does not lie on the arm");
  EXPECT_EQ(cellAt(3, 1), "accepted");
  test::grab(page_, "history_dark");
  applyTheme(*qApp, Theme::light());
  page_.setTheme(Theme::light());
  page_.select({0, 3});
  test::grab(page_, "history_light");
}

TEST_F(HistoryPageTest, ComparesWithTheOneInUseOrTwoWithEachOther) {
  show();
  page_.select({0});
  const auto words = [&](double from, double to) {
    return wordsOf(registration::differenceOf(poseAt(from), poseAt(to), robot_));
  };
  EXPECT_EQ(page_.comparison().toStdString(),
            "From the one in use to 2026-11-01 09:30: " + words(2.0, 0.0) + ".");
  page_.select({1, 0});
  EXPECT_EQ(page_.comparison().toStdString(),
            "From 2026-11-01 09:30 to 2026-11-02 09:30: " + words(0.0, 4.0) + ".");
  page_.select({2});
  EXPECT_TRUE(page_.comparison().contains("no result")) << page_.comparison().toStdString();
}

TEST_F(HistoryPageTest, RestoresAnEarlierOneOfTheSameRobot) {
  show();
  EXPECT_FALSE(button("Restore").isEnabled()) << "none is chosen";
  page_.select({3});
  EXPECT_FALSE(button("Restore").isEnabled()) << "it is in use";
  page_.select({2});
  EXPECT_FALSE(button("Restore").isEnabled()) << "it has no result";
  page_.select({0});
  ASSERT_TRUE(button("Restore").isEnabled()) << button("Restore").toolTip().toStdString();
  QTest::mouseClick(&button("Restore"), Qt::LeftButton);
  ASSERT_TRUE(asked_);
  EXPECT_EQ(asked_->decision, Decision::kRestored);
  EXPECT_EQ(asked_->reason, "of 2026-11-01 09:30:00");
  EXPECT_EQ(asked_->pose()->matrix(), poseAt(0.0).matrix());
  auto other = robot_;
  other.name = "another arm";
  page_.setRobot(other);
  page_.select({0});
  EXPECT_FALSE(button("Restore").isEnabled());
  EXPECT_TRUE(button("Restore").toolTip().contains(QString::fromStdString(robot_.name)));
}

TEST_F(HistoryPageTest, AnExportedFileComesBackByImport) {
  show();
  page_.select({1});
  const QString file = folder_.filePath("registration.yaml");
  page_.exportTo(file);
  EXPECT_TRUE(page_.fault().isEmpty()) << page_.fault().toStdString();
  EXPECT_EQ(vision::readRegistration(file.toStdString()).matrix(), poseAt(4.0).matrix());
  page_.importFrom(file);
  ASSERT_TRUE(asked_);
  EXPECT_EQ(asked_->decision, Decision::kImported);
  EXPECT_EQ(asked_->pose()->matrix(), poseAt(4.0).matrix());
  asked_.reset();
  base::writeTextFile(folder_.filePath("bad.yaml").toStdString(), "translation: [0, 0]\n");
  page_.importFrom(folder_.filePath("bad.yaml"));
  EXPECT_FALSE(asked_);
  EXPECT_TRUE(page_.fault().contains("bad.yaml")) << page_.fault().toStdString();
  page_.exportTo("/proc/nowhere/registration.yaml");
  EXPECT_TRUE(page_.fault().contains("/proc/nowhere")) << page_.fault().toStdString();
}

}  // namespace
}  // namespace capstan::widgets
