// The live error table: radians and metres in, degrees and millimetres out.
#include "widgets/panels/errors/errors_panel.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QVBoxLayout>
#include <QtTest/QTest>
#include <cmath>

#include "tests/widgets/picture.h"

namespace capstan::widgets {
namespace {

/// Constant errors, so that RMS is the error itself: kinematic 1 deg, camera 2 deg, UKF 0.5 deg on joints 1
/// and 2, and 3 mm, 4 mm, 12.346 mm on joint 3.
tracking::TrackReport knownErrors(bool own_kinematics = false) {
  tracking::TrackReport report;
  const double degree = M_PI / 180.0;
  for (int i = 0; i < 10; ++i) {
    tracking::Snapshot snapshot;
    const Eigen::Vector3d truth(0.5, 1.5, 0.4);
    snapshot.q_link_true = snapshot.q_link_true_cam = truth;
    snapshot.q_link_kin = truth + Eigen::Vector3d(degree, degree, 3e-3);
    snapshot.q_link_cam = truth - Eigen::Vector3d(2 * degree, 2 * degree, 4e-3);
    snapshot.q_link_ukf = truth + Eigen::Vector3d(0.5 * degree, -0.5 * degree, 12.346e-3);
    snapshot.reference_paired = true;
    snapshot.camera_updated = true;
    snapshot.gate = tracking::Gate::kOpen;
    snapshot.own_kinematics = own_kinematics;
    report.add(snapshot);
  }
  return report;
}

TEST(ErrorsPanel, ShowsDegreesAndMillimetres) {
  ErrorsPanel panel;
  panel.showReport(knownErrors());
  EXPECT_EQ(panel.cell(0, 0).trimmed(), "1.00");
  EXPECT_EQ(panel.cell(1, 1).trimmed(), "2.00");
  EXPECT_EQ(panel.cell(1, 2).trimmed(), "0.50");
  EXPECT_EQ(panel.cell(2, 0).trimmed(), "3.00");
  EXPECT_EQ(panel.cell(2, 1).trimmed(), "4.00");
  EXPECT_EQ(panel.cell(2, 2).trimmed(), "12.35");
  for (int joint = 0; joint < 3; ++joint)
    for (int column = 0; column < 3; ++column)
      EXPECT_EQ(panel.cell(joint, column).size(), panel.cell(0, 0).size())
          << "decimals stand below each other";
  test::grab(panel, "errors_panel");
}

TEST(ErrorsPanel, NamesOfTheColumnsAreLegible) {
  for (const Theme& theme : {Theme::dark(), Theme::light()}) {
    ErrorsPanel panel;
    panel.setTheme(theme);
    for (const auto* label : panel.findChildren<QLabel*>())
      EXPECT_GE(contrastOf(label->palette().color(QPalette::WindowText), theme.window), Theme::kLeastContrast)
          << label->text().toStdString();
  }
}

TEST(ErrorsPanel, SaysSoWithoutNumbers) {
  ErrorsPanel panel;
  panel.setReference(false);
  EXPECT_TRUE(panel.cell(0, 0).contains("—"));
  bool said = false;
  for (const auto* label : panel.findChildren<QLabel*>())
    said = said || label->text().contains("no joint encoders");
  EXPECT_TRUE(said);
}

TEST(ErrorsPanel, DifferencesFromTheRobotsOwnKinematicsAreNoErrors) {
  ErrorsPanel panel;
  panel.showReport(knownErrors());
  EXPECT_EQ(panel.note(), "10 samples");
  panel.showReport(knownErrors(true));
  EXPECT_TRUE(panel.note().contains("own kinematics, no truth")) << panel.note().toStdString();
  test::grab(panel, "errors_panel_own_kinematics");
}

TEST(ErrorsPanel, SaysSinceWhenItCounts) {
  ErrorsPanel panel;
  panel.resize(260, 150);
  auto report = knownErrors();
  report.since = tracking::ReportStart::kRegistration;
  panel.showReport(report);
  EXPECT_EQ(panel.note(), "10 since the registration");
  test::grab(panel, "errors_panel_since");
}

TEST(ErrorsPanel, GoesToTheClipboardAsATable) {
  ErrorsPanel panel;
  panel.showReport(knownErrors());
  ASSERT_EQ(panel.actions().size(), 1);
  panel.actions().front()->trigger();
  const QStringList lines = QApplication::clipboard()->text().split('\n', Qt::SkipEmptyParts);
  ASSERT_EQ(lines.size(), 4);
  EXPECT_EQ(lines[1], "q1\t1.00\t2.00\t0.50\tdeg");
  EXPECT_EQ(lines[3].section('\t', -1), "mm");
}

TEST(ErrorsPanel, ResetsByKeyButNotWhileTyping) {
  QWidget window;
  auto* column = new QVBoxLayout(&window);
  auto* panel = new ErrorsPanel;
  auto* line = new QLineEdit;
  column->addWidget(panel);
  column->addWidget(line);
  window.show();
  QApplication::setActiveWindow(&window);
  QSignalSpy asked(panel, &ErrorsPanel::resetRequested);
  panel->findChild<QPushButton*>()->setFocus();
  QTest::keyClick(panel->findChild<QPushButton*>(), Qt::Key_E);
  ASSERT_TRUE(QTest::qWaitFor([&] { return asked.count() == 1; }));
  line->setFocus();
  ASSERT_EQ(QApplication::focusWidget(), line);
  QTest::keyClick(line, Qt::Key_E);
  QTest::qWait(150);  // a shortcut of a button fires after its animation
  EXPECT_EQ(asked.count(), 1);
  EXPECT_EQ(line->text(), "e");
}

}  // namespace
}  // namespace capstan::widgets
