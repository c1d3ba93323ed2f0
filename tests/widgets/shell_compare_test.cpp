// A second run in the window: the session tracked again over the plots, and another recording beside them.
#include <QAction>
#include <QDialog>
#include <QToolButton>

#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/shell/compare_controller.h"
#include "widgets/shell/message_bar.h"
#include "widgets/shell/rerun_dialog.h"

namespace capstan::widgets {
namespace {

class Compare : public Shell {
 protected:
  void record(const QString& name, int seconds, const QStringList& more = {}) {
    commandLine(
        QStringList{"simulate", "--out", file(name), "--duration", QString::number(seconds), "--no-images"} +
        more);
  }
  std::unique_ptr<MainWindow> opened(const QString& name) {
    auto window = makeWindow();
    window->bar().setSpeed(50.0);
    window->open(SourceChoice::ofFile(file(name)));
    EXPECT_TRUE(waitFor([&] { return window->link().ended(); }));
    EXPECT_TRUE(waitFor([&] { return window->figure().history().end() > 5.0; }));
    return window;
  }
  static bool compared(MainWindow& window) {
    return waitFor([&] { return window.comparison().second() && !window.comparison().busy(); });
  }
  static QString news(MainWindow& window) {
    QString words;
    for (const MessageBar* bar : window.findChildren<MessageBar*>())
      if (!bar->isHidden()) words += bar->message();
    return words;
  }
};

TEST_F(Compare, TheSessionIsTrackedAgainAndDrawnOverItself) {
  record("trial.capstan", 6);
  auto window = opened("trial.capstan");
  analysis::RerunChange change;
  change.filter = tracking::FilterKind::kSixState;
  window->comparison().rerun(change);
  ASSERT_TRUE(compared(*window)) << news(*window).toStdString();
  EXPECT_GT(window->figure().plot(0).second()->dataCount(), 100);
  EXPECT_TRUE(news(*window).contains("six_state")) << news(*window).toStdString();
  EXPECT_TRUE(news(*window).contains("RMS errors")) << news(*window).toStdString();
  EXPECT_NEAR(window->comparison().second()->values.end(), window->figure().history().end(), 0.02);
  window->figure().showErrors(true);
  EXPECT_GT(window->figure().plot(0).second()->dataCount(), 100) << "errors of both";
  test::grab(*window, "compare_rerun_errors");
  window->figure().showErrors(false);
  window->figure().setTimeRange(1.0, 5.0);
  test::grab(*window, "compare_rerun");
  window->action("endComparison")->trigger();
  EXPECT_EQ(window->figure().plot(0).second()->dataCount(), 0);
  EXPECT_FALSE(window->comparison().second());
}

TEST_F(Compare, AnotherRecordingStandsBesideItInLinkedTime) {
  record("monday.capstan", 8);
  record("tuesday.capstan", 8, {"--seed", "1", "--truth", "matched"});
  auto window = opened("monday.capstan");
  window->comparison().compareWith(file("tuesday.capstan"));
  ASSERT_TRUE(compared(*window)) << news(*window).toStdString();
  JointFigure* second = window->comparison().secondFigure();
  ASSERT_TRUE(second);
  EXPECT_TRUE(news(*window).contains("tuesday.capstan")) << news(*window).toStdString();
  EXPECT_TRUE(news(*window).contains("Aligned by the motion")) << news(*window).toStdString();
  window->figure().setTimeRange(2.0, 4.0);
  EXPECT_NEAR(second->timeRange().lower, 2.0, 0.05);
  EXPECT_NEAR(second->timeRange().size(), 2.0, 1e-6);
  second->setTimeRange(3.0, 6.0);
  EXPECT_NEAR(window->figure().timeRange().lower, 3.0, 0.05);
  window->figure().setCursor(4.0);
  ASSERT_TRUE(second->cursorTime());
  EXPECT_NEAR(*second->cursorTime(), 4.0, 0.05);
  window->setThemeNamed("light");
  test::grab(*window, "compare_beside_light");
  window->setThemeNamed("dark");
  test::grab(*window, "compare_beside");
  window->open(SourceChoice::ofFile(file("tuesday.capstan")));
  ASSERT_TRUE(waitFor([&] { return window->comparison().secondFigure() == nullptr; }))
      << "it was of the session before";
}

TEST_F(Compare, WhatCannotBeComparedIsSaid) {
  record("trial.capstan", 6);
  auto window = opened("trial.capstan");
  window->comparison().rerun({});
  EXPECT_TRUE(news(*window).contains("Nothing is changed")) << news(*window).toStdString();
  analysis::RerunChange change;
  change.robot = "/nowhere/robot.yaml";
  window->comparison().rerun(change);
  EXPECT_TRUE(waitFor([&] { return news(*window).contains("/nowhere/robot.yaml"); }))
      << news(*window).toStdString();
  window->comparison().compareWith(file("absent.capstan"));
  EXPECT_TRUE(waitFor([&] { return news(*window).contains("absent.capstan"); }))
      << news(*window).toStdString();
  EXPECT_FALSE(window->comparison().second());
}

TEST_F(Compare, TheDialogGivesOnlyWhatWasChanged) {
  auto window = makeWindow();
  QTest::keyClick(window.get(), Qt::Key_B, Qt::ControlModifier);
  auto* dialog = window->findChild<RerunDialog*>();
  ASSERT_TRUE(dialog) << "Ctrl+B opens it";
  EXPECT_TRUE(dialog->change().empty());
  test::grab(*dialog, "compare_dialog");
}

}  // namespace
}  // namespace capstan::widgets
