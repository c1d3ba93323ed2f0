// Diagnosis in the whole window, beside a running session: what was recorded is offered, the panel takes the
// place of the plots, the extended robot that of the one in use.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QDir>
#include <QHeaderView>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QTabBar>
#include <QTemporaryDir>
#include <QToolButton>
#include <QTreeWidget>
#include <QtTest/QTest>

#include "tests/support/sample_diagnosis.h"
#include "tests/widgets/picture.h"
#include "widgets/panels/analysis/analysis_panel.h"
#include "widgets/panels/diagnosis/diagnosis_panel.h"
#include "widgets/panels/diagnosis/report_pages.h"
#include "widgets/panels/diagnosis/signature_view.h"
#include "widgets/panels/identification/identification_panel.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/session_bar.h"

namespace capstan::widgets {
namespace {

using diagnosis::Verdict;
using ::testing::HasSubstr;

template <class Condition>
bool waitFor(Condition&& condition) {
  return QTest::qWaitFor(condition, 90000);
}

class DiagnosisWindow : public ::testing::Test {
 protected:
  void open(int width, int height) {
    window_ = std::make_unique<MainWindow>(folder_.filePath("settings.ini"));
    window_->bar().setRecordingFolder(folder_.filePath("recordings"));
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
  DiagnosisPanel& panel() { return window_->diagnosis(); }
  QPushButton* button(const char* name) { return panel().findChild<QPushButton*>(name); }
  void pictures(const char* state) {
    if (!qEnvironmentVariableIsSet("CAPSTAN_PICTURES")) return;
    for (const char* theme : {"dark", "light"}) {
      window_->setThemeNamed(theme);
      for (const QSize& size : {QSize(1280, 800), QSize(1920, 1080)}) {
        window_->resize(size);
        QTest::qWait(300);
        test::grab(*window_, QStringLiteral("diagnosis_%1_%2_%3").arg(size.width()).arg(theme, state));
      }
    }
    window_->setThemeNamed("dark");
  }

  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;
};

TEST_F(DiagnosisWindow, TakesThePlaceOfThePlotsAndOfTheAnalysis) {
  open(1280, 800);
  window_->action("diagnose")->trigger();
  EXPECT_TRUE(panel().isVisible());
  EXPECT_FALSE(window_->figure().isVisible());
  window_->action("analyse")->trigger();
  EXPECT_TRUE(window_->analysis().isVisible());
  EXPECT_FALSE(panel().isVisible());
  EXPECT_FALSE(window_->action("diagnose")->isChecked());
  window_->action("diagnose")->trigger();
  EXPECT_TRUE(panel().isVisible());
  EXPECT_FALSE(window_->action("analyse")->isChecked());
  window_->action("diagnose")->trigger();
  EXPECT_TRUE(window_->figure().isVisible());
}

TEST_F(DiagnosisWindow, OffersWhatWasJustRecordedOnceItIsWhole) {
  open(1280, 800);
  window_->action("diagnose")->trigger();
  pictures("empty");
  auto* offered = panel().findChild<QToolButton*>("offered");
  EXPECT_FALSE(offered->isVisible());
  window_->action("record")->trigger();
  ASSERT_TRUE(waitFor([&] { return window_->link().recording(); }));
  QTest::qWait(300);
  EXPECT_FALSE(offered->isVisible()) << "it is still being written";
  window_->action("record")->trigger();
  ASSERT_TRUE(waitFor([&] { return offered->isVisible(); }));
  offered->click();
  ASSERT_EQ(panel().choice().recordings.size(), 1);
  EXPECT_TRUE(QFileInfo(panel().choice().recordings[0]).size() > 0);
  EXPECT_TRUE(button("diagnose_now")->isEnabled());
}

TEST_F(DiagnosisWindow, ShowsLargePicturesAndItsRobotIsUsed) {
  open(1280, 800);
  window_->action("diagnose")->trigger();
  const diagnosis::Report report = testing::sampleReport({.verdict = Verdict::kFound, .cameras = true});
  panel().showReport(report);
  QTest::qWait(100);
  EXPECT_EQ(window_->size(), QSize(1280, 800)) << "the panel does not force a larger window";
  ASSERT_TRUE(panel().pages().signatures().figure());
  EXPECT_GT(panel().pages().signatures().figure()->width(), 300);
  EXPECT_GT(panel().pages().signatures().figure()->height(), 230);
  pictures("found_signature");
  for (const auto& [page, state] : {std::pair{1, "found_course"},
                                    {2, "found_ranking"},
                                    {3, "found_refit"},
                                    {4, "found_gain"},
                                    {5, "found_posterior"}}) {
    panel().pages().setCurrentIndex(page);
    pictures(state);
  }
  panel().pages().setCurrentIndex(0);

  ASSERT_NE(window_->link().runner()->robot().drives[1].cable_stiffness,
            report.extended.drives[1].cable_stiffness);
  ASSERT_TRUE(button("use_extended")->isEnabled());
  button("use_extended")->click();
  EXPECT_EQ(window_->link().runner()->robot().drives[1].cable_stiffness,
            report.extended.drives[1].cable_stiffness);
  EXPECT_THAT(window_->notes().row(window_->notes().rows() - 1).toStdString(),
              HasSubstr("extended robot in use"));
  // The calibration begins with it.
  QTest::keyClick(window_.get(), Qt::Key_I);
  ASSERT_EQ(window_->identification().live().phase(), identification::LivePhase::kCollecting);
  EXPECT_EQ(window_->identification().live().set()->nominal().drives[1].cable_stiffness,
            report.extended.drives[1].cable_stiffness);
}

TEST_F(DiagnosisWindow, TheOpenRecordingIsChosenWhereNoneIs) {
  open(1280, 800);
  EXPECT_TRUE(panel().choice().recordings.isEmpty()) << "a simulation is no recording";
  window_->action("record")->trigger();
  ASSERT_TRUE(waitFor([&] { return window_->link().recording(); }));
  QTest::qWait(1500);
  auto* offered = panel().findChild<QToolButton*>("offered");
  window_->action("diagnose")->trigger();
  window_->action("record")->trigger();
  ASSERT_TRUE(waitFor([&] { return offered->isVisible(); }));
  EXPECT_TRUE(panel().choice().recordings.isEmpty());
  const QFileInfoList files = QDir(folder_.filePath("recordings")).entryInfoList({"*.capstan"}, QDir::Files);
  ASSERT_EQ(files.size(), 1);
  window_->open(SourceChoice::ofFile(files[0].absoluteFilePath()));
  ASSERT_TRUE(waitFor([&] { return !panel().choice().recordings.isEmpty(); }));
  EXPECT_EQ(panel().choice().recordings, QStringList{files[0].absoluteFilePath()});
  EXPECT_TRUE(button("diagnose_now")->isEnabled());
}

/// At 1280 px every tab of the pages is shown, and the panel needs no horizontal scroll bar.
TEST_F(DiagnosisWindow, NothingIsCutAt1280Pixels) {
  open(1280, 800);
  window_->action("diagnose")->trigger();
  panel().showReport(testing::sampleReport({.verdict = Verdict::kSeveral, .cameras = true}));
  QTest::qWait(100);
  const auto* tabs = panel().pages().findChild<QTabBar*>();
  ASSERT_TRUE(tabs);
  EXPECT_LE(tabs->tabRect(tabs->count() - 1).right(), panel().pages().width());
  for (const QWidget* up = panel().parentWidget(); up; up = up->parentWidget())
    if (const auto* area = qobject_cast<const QScrollArea*>(up)) {
      EXPECT_EQ(area->horizontalScrollBar()->maximum(), 0);
    }
}

TEST_F(DiagnosisWindow, NoColumnOfATableIsCutAt1280Pixels) {
  open(1280, 800);
  window_->action("diagnose")->trigger();
  panel().showReport(testing::sampleReport({.verdict = Verdict::kSeveral, .cameras = true}));
  auto* tabs = panel().pages().findChild<QTabBar*>();
  ASSERT_TRUE(tabs);
  for (const char* name : {"refit", "gain"}) {
    auto* table = panel().pages().findChild<QTreeWidget*>(name);
    ASSERT_TRUE(table) << name;
    for (int tab = 0; tab < tabs->count() && !table->isVisible(); ++tab) tabs->setCurrentIndex(tab);
    QTest::qWait(50);
    ASSERT_TRUE(table->isVisible()) << name;
    EXPECT_EQ(table->horizontalScrollBar()->maximum(), 0) << name;
    for (int column = 0; column < table->columnCount(); ++column) {
      if (table->isColumnHidden(column)) continue;
      const QFontMetrics metrics(table->header()->font());
      const QString title = table->headerItem()->text(column);
      int widest = 0;
      for (const QString& line : title.split('\n'))
        widest = std::max(widest, metrics.horizontalAdvance(line));
      EXPECT_GE(table->columnWidth(column), widest) << name << ": " << title.toStdString();
    }
  }
}

TEST_F(DiagnosisWindow, EveryVerdictHasAFace) {
  open(1280, 800);
  window_->action("diagnose")->trigger();
  for (const auto& [verdict, state] : {std::pair{Verdict::kSeveral, "several"},
                                       {Verdict::kTie, "tie"},
                                       {Verdict::kNothing, "nothing"},
                                       {Verdict::kUnexplained, "unexplained"}}) {
    panel().showReport(testing::sampleReport({.verdict = verdict}));
    EXPECT_FALSE(panel().headline().isEmpty());
    EXPECT_EQ(window_->size(), QSize(1280, 800)) << state;
    pictures(state);
    window_->resize(1280, 800);
  }
}

}  // namespace
}  // namespace capstan::widgets
