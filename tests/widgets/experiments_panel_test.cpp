// The panel of experiments E to H: what it runs, shows and exports is what core gives.
#include "widgets/panels/experiments/experiments_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QApplication>
#include <QFile>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>
#include <QTextBrowser>
#include <QtTest/QTest>

#include "core/base/resource.h"
#include "core/base/yaml.h"
#include "tests/support/sample_poses.h"
#include "tests/widgets/picture.h"
#include "widgets/panels/experiments/experiment_picker.h"

namespace capstan::widgets {
namespace {

using experiments::CorrectionExperiment;
using experiments::CorrectionExperimentOptions;
using ::testing::HasSubstr;

template <class Condition>
bool waitFor(Condition&& condition) {
  return QTest::qWaitFor(condition, 100000);
}

CorrectionExperimentOptions quick() {
  CorrectionExperimentOptions options;
  options.errors.splits = 2;
  options.errors.correction.inducing_points = options.errors.correction.likelihood_points = 60;
  return options;
}

class Experiments : public ::testing::Test {
 protected:
  void SetUp() override {
    panel_.resize(1100, 820);
    panel_.show();
    QApplication::setActiveWindow(&panel_);
    testing::SamplePoses sample;
    sample.trajectories = 12;
    testing::writeSamplePoses(table_.toStdString(), sample);
  }
  std::string textOf(const QString& name) { return base::readTextFile(folder_.filePath(name).toStdString()); }

  QTemporaryDir folder_;
  const QString table_ = folder_.filePath("poses.csv");
  ExperimentsPanel panel_{quick()};
};

TEST_F(Experiments, AreRunShownAndExportedAsTheCommandLineDoes) {
  EXPECT_FALSE(panel_.picker().complete());
  panel_.picker().setTables({table_});
  ASSERT_TRUE(panel_.picker().complete());
  QTest::keyClick(&panel_, Qt::Key_F5);
  ASSERT_TRUE(panel_.busy());
  ASSERT_TRUE(waitFor([&] { return !panel_.busy() && panel_.results(); })) << panel_.words().toStdString();
  const QString shown = panel_.findChild<QTextBrowser*>("experiment_comparison")->toPlainText();
  EXPECT_TRUE(shown.contains("paper", Qt::CaseInsensitive)) << shown.toStdString();
  test::grab(panel_, "experiments_panel");

  panel_.exportTo(folder_.filePath("E"));
  EXPECT_THAT(panel_.words().toStdString(), HasSubstr("Exported to"));
  for (const char* name : {"E/comparison.md", "E/errors.pdf", "E/errors.svg", "E/errors.png"})
    EXPECT_TRUE(QFile::exists(folder_.filePath(name))) << name;
  CorrectionExperimentOptions options = quick();
  options.poses = {table_.toStdString()};
  base::Progress progress;
  EXPECT_EQ(textOf("E/numbers.json"), jsonOf(runCorrectionExperiment(options, progress)).dump(2) + "\n");
}

TEST_F(Experiments, AFaultIsShownAndNothingIsExported) {
  panel_.picker().setTables({folder_.filePath("none.csv")});
  panel_.runOrCancel();
  ASSERT_TRUE(waitFor([&] { return !panel_.busy(); }));
  EXPECT_THAT(panel_.words().toStdString(), HasSubstr("none.csv"));
  EXPECT_FALSE(panel_.findChild<QPushButton*>("export_experiment")->isEnabled());
}

TEST_F(Experiments, CanBeCancelled) {
  panel_.picker().choose(CorrectionExperiment::kDebridement);
  ASSERT_TRUE(panel_.picker().complete());
  panel_.runOrCancel();
  ASSERT_TRUE(panel_.busy());
  panel_.runOrCancel();
  ASSERT_TRUE(waitFor([&] { return !panel_.busy(); }));
  EXPECT_EQ(panel_.results(), nullptr);
  EXPECT_EQ(panel_.words(), "Cancelled.");
}

TEST_F(Experiments, TheChoiceIsKept) {
  panel_.picker().setTables({table_});
  panel_.picker().choose(CorrectionExperiment::kTrainingSize);
  panel_.picker().setTowards(learning::StreamKind::kRobot);
  QSettings settings(folder_.filePath("settings.ini"), QSettings::IniFormat);
  panel_.save(settings);
  ExperimentsPanel other;
  other.restore(settings);
  EXPECT_EQ(other.picker().experiment(), CorrectionExperiment::kTrainingSize);
  EXPECT_EQ(other.picker().towards(), learning::StreamKind::kRobot);
  EXPECT_EQ(other.picker().tables(), QStringList{table_});
}

}  // namespace
}  // namespace capstan::widgets
