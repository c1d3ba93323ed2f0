// The analysis in the whole window, beside a running session.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QFile>
#include <QScrollBar>
#include <QTemporaryDir>
#include <QtTest/QTest>

#include "tests/widgets/picture.h"
#include "widgets/panels/analysis/analysis_panel.h"
#include "widgets/panels/analysis/analysis_table.h"
#include "widgets/panels/analysis/figure_pair.h"
#include "widgets/panels/errors/errors_panel.h"
#include "widgets/shell/dock_scroll.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/session_bar.h"

namespace capstan::widgets {
namespace {

using analysis::Measure;
using experiments::Estimator;

template <class Condition>
bool waitFor(Condition&& condition) {
  return QTest::qWaitFor(condition, 90000);
}

class AnalysisWindow : public testing::Test {
 protected:
  void open(int width, int height) {
    window_ = std::make_unique<MainWindow>(folder_.filePath("settings.ini"));
    window_->bar().setSpeed(10.0);
    window_->resize(width, height);
    window_->show();
    window_->activateWindow();
    simulation::SimulationRequest request;
    request.trajectory = "sinusoid";
    request.duration = 600.0;
    request.images = false;
    window_->open(SourceChoice::ofSimulation(request));
    ASSERT_TRUE(waitFor([&] { return window_->link().running(); }));
  }
  bool reaches(double t) {
    return waitFor([&] { return window_->link().runner()->status().t > t; });
  }
  AnalysisPanel& panel() { return window_->analysis(); }
  std::size_t samples() { return panel().analysis().rows.at(0).a.n; }

  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;
};

/// Least widths of the widest parts of a page, for the message of a failure.
std::string leastWidths(const QWidget& page) {
  std::string words;
  for (const QWidget* part : page.findChildren<QWidget*>())
    if (part->minimumSizeHint().width() > 500)
      words += fmt::format(" {} {} {}", part->metaObject()->className(), part->objectName().toStdString(),
                           part->minimumSizeHint().width());
  return words;
}

TEST_F(AnalysisWindow, TakesInTheSessionSoFar) {
  open(1280, 800);
  ASSERT_TRUE(reaches(8.0));
  window_->action("analyse")->trigger();
  ASSERT_TRUE(waitFor([&] { return panel().settled(); }));
  EXPECT_TRUE(panel().isVisible());
  EXPECT_FALSE(window_->figure().isVisible());
  ASSERT_TRUE(panel().figures().histogram());
  const std::size_t before = samples();
  EXPECT_GT(before, 600U);
  // The same numbers as the table of errors, which sees every sample.
  window_->link().setRunning(false);
  ASSERT_TRUE(waitFor([&] { return !window_->link().running(); }));
  panel().refresh();
  ASSERT_TRUE(waitFor([&] { return panel().settled(); }));
  EXPECT_GT(samples(), before);
  const auto report = window_->link().runner()->report();
  for (const auto& row : panel().analysis().rows) {
    if (row.estimator != Estimator::kUkf) continue;
    const double whole = report.errors.ukf().value()(row.joint) * (row.joint < 2 ? 180.0 / M_PI : 1e3);
    EXPECT_NEAR(row.a.of(Measure::kRms) / whole, 1.0, 0.05) << row.joint;
  }
  for (const char* theme : {"dark", "light"}) {
    window_->setThemeNamed(theme);
    for (const QSize& size : {QSize(1280, 800), QSize(1920, 1080)}) {
      window_->resize(size);
      QTest::qWait(300);
      test::grab(*window_, QStringLiteral("analysis_window_%1_%2").arg(size.width()).arg(theme));
    }
  }
  window_->action("analyse")->trigger();
  EXPECT_TRUE(window_->figure().isVisible());
}

TEST_F(AnalysisWindow, FitsBesideTheDocksOfASmallWindow) {
  open(1280, 800);
  for (const char* page : {"analyse", "diagnose", "learn"}) {
    window_->action(page)->trigger();
    QTest::qWait(200);
    for (const DockScroll* scroll : window_->centralWidget()->findChildren<DockScroll*>()) {
      if (!scroll->isVisible()) continue;
      EXPECT_EQ(scroll->horizontalScrollBar()->maximum(), 0)
          << page << ": least widths" << leastWidths(*scroll->widget());
    }
  }
}

TEST_F(AnalysisWindow, BeginsAnewWithTheErrorTable) {
  open(1280, 800);
  ASSERT_TRUE(reaches(6.0));
  window_->link().setRunning(false);
  ASSERT_TRUE(waitFor([&] { return !window_->link().running(); }));
  Q_EMIT window_->errors().resetRequested();
  window_->action("analyse")->trigger();
  ASSERT_TRUE(waitFor([&] { return panel().settled(); }));
  EXPECT_TRUE(panel().words().contains("no errors yet")) << panel().words().toStdString();
}

TEST_F(AnalysisWindow, ExportsTheTrajectoryOfTheRunningSession) {
  open(1280, 800);
  ASSERT_TRUE(reaches(6.0));
  window_->action("analyse")->trigger();
  ASSERT_TRUE(waitFor([&] { return panel().settled(); }));
  panel().exportAllTo(folder_.filePath("all"), {60.0, 60.0});
  ASSERT_TRUE(waitFor([&] { return !panel().busy(); }));
  QFile csv(folder_.filePath("all/session-trajectory-session.csv"));
  ASSERT_TRUE(csv.open(QIODevice::ReadOnly)) << panel().words().toStdString();
  EXPECT_GT(csv.readAll().count('\n'), 100) << "5 s and more, 20 a second";
}

// What else listens to the session neither ends the gathering nor is ended by it.
TEST_F(AnalysisWindow, ListensBesideOthers) {
  open(1280, 800);
  std::atomic<int> heard = 0;
  QObject other;
  window_->link().listen(&other,
                         {{}, [&heard](const tracking::Sample&, const tracking::Snapshot&) { ++heard; }});
  ASSERT_TRUE(reaches(5.0));
  EXPECT_GT(heard.load(), 0);
  window_->link().listen(&other, {});
  ASSERT_TRUE(reaches(6.0));
  const int then = heard.load();
  ASSERT_TRUE(reaches(8.0));
  EXPECT_EQ(heard.load(), then);
  window_->action("analyse")->trigger();
  ASSERT_TRUE(waitFor([&] { return panel().settled(); }));
  EXPECT_GT(samples(), 600U);
}

}  // namespace
}  // namespace capstan::widgets
