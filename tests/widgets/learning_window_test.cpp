// Learning in the whole window: the panel takes the place of the plots; its pages are legible in small and
// large windows, dark and light.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QTemporaryDir>
#include <QtTest/QTest>

#include "tests/support/folders.h"
#include "tests/support/sample_poses.h"
#include "tests/widgets/picture.h"
#include "widgets/panels/analysis/analysis_panel.h"
#include "widgets/panels/diagnosis/diagnosis_panel.h"
#include "widgets/panels/learning/ablation_view.h"
#include "widgets/panels/learning/clouds_view.h"
#include "widgets/panels/learning/confidence_view.h"
#include "widgets/panels/learning/learning_pages.h"
#include "widgets/panels/learning/learning_panel.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/scene/cloud_view.h"
#include "widgets/shell/main_window.h"

namespace capstan::widgets {
namespace {

using ::testing::HasSubstr;

template <class Condition>
bool waitFor(Condition&& condition) {
  const bool pictures = qEnvironmentVariableIsSet("CAPSTAN_PICTURES");  // of all that takes long
  return QTest::qWaitFor(condition, pictures ? 600000 : 110000);
}

class LearningWindow : public ::testing::Test {
 protected:
  void SetUp() override {
    window_ = std::make_unique<MainWindow>(folder_.filePath("settings.ini"));
    window_->resize(1280, 800);
    window_->show();
    QApplication::setActiveWindow(window_.get());  // for its keys
    window_->action("learn")->trigger();
    LearningSettings quick;
    quick.learning.correction.likelihood_points = 400;
    quick.learning.correction.inducing_points = 500;
    panel().setSettings(quick);
  }
  LearningPanel& panel() { return window_->learning(); }
  void done() {
    ASSERT_TRUE(waitFor([&] { return !panel().busy(); }));
  }
  void pictures(const QString& state, bool all_pages = true) {
    if (!qEnvironmentVariableIsSet("CAPSTAN_PICTURES")) return;
    for (const char* theme : {"dark", "light"}) {
      window_->setThemeNamed(theme);
      for (const QSize& size : {QSize(1280, 800), QSize(1920, 1080)}) {
        window_->resize(size);
        for (int page = 0; page < (all_pages ? panel().pages().count() : 1); ++page) {
          if (all_pages) panel().pages().setCurrentIndex(page);
          QTest::qWait(250);
          test::grab(
              *window_,
              QStringLiteral("learning_%1_%2_%3_%4").arg(state).arg(page).arg(size.width()).arg(theme));
        }
      }
    }
    window_->setThemeNamed("dark");
    window_->resize(1280, 800);
  }

  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;
};

TEST_F(LearningWindow, TakesThePlaceOfThePlotsAndOfTheOtherPanels) {
  EXPECT_TRUE(panel().isVisible());
  EXPECT_FALSE(window_->figure().isVisible());
  pictures("empty", false);
  window_->action("diagnose")->trigger();
  EXPECT_TRUE(window_->diagnosis().isVisible());
  EXPECT_FALSE(panel().isVisible());
  QTest::keyClick(window_.get(), Qt::Key_L, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_TRUE(panel().isVisible());
  EXPECT_FALSE(window_->action("diagnose")->isChecked());
  QTest::keyClick(window_.get(), Qt::Key_L, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_TRUE(window_->figure().isVisible());
}

TEST_F(LearningWindow, CloudsMoveTogetherByTheCorrection) {
  testing::SamplePoses sample;
  if (!qEnvironmentVariableIsSet("CAPSTAN_PICTURES")) sample.trajectories = 8;  // as quick as can be
  testing::writeSamplePoses(folder_.filePath("poses.csv").toStdString(), sample);
  panel().choose({.tables = {folder_.filePath("poses.csv")}});
  done();
  panel().train();
  done();
  ASSERT_TRUE(panel().results().evaluation);
  EXPECT_EQ(window_->size(), QSize(1280, 800)) << "the panel does not force a larger window";
  panel().pages().setCurrentWidget(&panel().pages().clouds());
  CloudView& view = panel().pages().clouds().view();
  EXPECT_GT(view.width(), 300);
  EXPECT_GT(view.height(), 300);
  const QImage picture = view.image();
  const Theme& theme = Theme::dark();
  for (const QColor& colour : {theme.colour(Quantity::kTrue), theme.colour(Quantity::kUkf), theme.warning})
    EXPECT_GT(test::count(picture, picture.rect(), colour, 40).pixels, 100) << colour.name().toStdString();
  ASSERT_TRUE(waitFor([&] { return panel().pages().confidence().slice() != nullptr; }));
  if (qEnvironmentVariableIsSet("CAPSTAN_PICTURES")) {
    panel().pages().ablation().setSplits(1);
    panel().runAblation();
    done();
    panel().runCurve();
    done();
    pictures("sample");
  }
  panel().exportTo(folder_.filePath("out"));
  done();
  EXPECT_TRUE(QFile::exists(folder_.filePath("out/clouds.png"))) << panel().words().toStdString();
  EXPECT_THAT(window_->notes().row(window_->notes().rows() - 1).toStdString(), HasSubstr("out"));
}

TEST_F(LearningWindow, ReadsTheRecordingOfTheDebridementTask) {
  const auto table = test::dataFolder() / "raven2-phasespace" / "left_arm.csv";
  REQUIRE_DATA(table);
  panel().choose({.tables = {QString::fromStdString(table.string())}});
  done();
  ASSERT_TRUE(panel().results().stages) << panel().summary().toStdString();
  EXPECT_EQ(panel().results().stages->screen.motions.size(), 243U);
  if (!qEnvironmentVariableIsSet("CAPSTAN_PICTURES")) return;
  panel().train();
  pictures("training", false);
  done();
  ASSERT_TRUE(waitFor([&] { return panel().pages().confidence().slice() != nullptr; }));
  panel().pages().ablation().setSplits(1);
  panel().runAblation();
  done();
  panel().runCurve();
  done();
  pictures("measured");
}

}  // namespace
}  // namespace capstan::widgets
