#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QFileDialog>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>
#include <QToolButton>
#include <QtTest/QTest>
#include <fstream>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/recording/export.h"
#include "core/simulation/simulation_request.h"
#include "core/stats/rms.h"
#include "tests/widgets/analysed_panel.h"
#include "tests/widgets/figures/layout_check.h"
#include "tests/widgets/picture.h"
#include "widgets/panels/analysis/analysis_panel.h"
#include "widgets/panels/analysis/analysis_table.h"
#include "widgets/panels/analysis/figure_pair.h"
#include "widgets/panels/analysis/options_bar.h"

namespace capstan::widgets {
namespace {

using ::testing::HasSubstr;

class ExportsAll : public Analysed {
 protected:
  void SetUp() override {
    Analysed::SetUp();
    QObject::connect(&panel, &AnalysisPanel::exported, [this](const QString& what) { told = what; });
  }
  bool idle() {
    return QTest::qWaitFor([&] { return !panel.busy(); }, kPatience);
  }
  QString out(const QString& name) const { return QDir(folder.path()).filePath(name); }
  static QStringList endingIn(const QString& ending, const QString& where) {
    return QDir(where).entryList({"*" + ending});
  }
  QTemporaryDir folder;
  QString told;
  const PaperSize small = {180.0, 120.0};
};

TEST_F(ExportsAll, FiguresAndTablesOfBothRuns) {
  panel.setSession([] {
    analysis::ErrorRun run{.title = "live", .simulated = true};
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3d error = Eigen::Vector3d::Constant(1e-3 * std::cos(0.3 * i));
      run.errors.push_back({0.01 * i, error, error, 0.5 * error, false});
    }
    return run;
  });
  panel.choose(0, recording(path("mine.yaml")));
  panel.choose(1, {.kind = RunChoice::Kind::kSession});
  ASSERT_TRUE(settled());
  panel.exportAllTo(out("all"), small);
  EXPECT_TRUE(panel.busy());
  EXPECT_TRUE(panel.findChild<QPushButton*>("cancel_analysis")->isVisible());
  ASSERT_TRUE(idle());
  EXPECT_EQ(endingIn(".pdf", out("all")),
            (QStringList{"comparison-boxplot.pdf", "comparison-histogram-page-1.pdf",
                         "comparison-histogram-page-2.pdf", "comparison-histogram-page-3.pdf",
                         "session-boxplot.pdf", "session-histogram-session.pdf", "trial-mine-boxplot.pdf",
                         "trial-mine-histogram-trial.pdf", "trial-mine-trajectory-trial.pdf"}));
  EXPECT_FALSE(endingIn(".tex", out("all")).isEmpty());
  const QString index = out("all/index.html");
  EXPECT_EQ(told, index);
  EXPECT_THAT(panel.words().toStdString(), HasSubstr(index.toStdString()));
  EXPECT_THAT(panel.words().toStdString(), HasSubstr("7 figures"));
  const std::string html = base::readTextFile(index.toStdString());
  EXPECT_THAT(html, HasSubstr("trial.capstan, mine"));
  EXPECT_THAT(html, HasSubstr("live"));
  // RMS of half a cosine over many periods: 0.5e-3/√2 rad.
  const std::string table = base::readTextFile(out("all/session-table-trials.csv").toStdString());
  EXPECT_THAT(table,
              HasSubstr(QString::number(0.5e-3 / std::sqrt(2.0) * 180.0 / M_PI, 'f', 3).toStdString()));
  test::grab(panel, "analysis_exported_all");
}

TEST_F(ExportsAll, AForeignFolderIsRefusedInWords) {
  panel.choose(0, recording());
  ASSERT_TRUE(settled());
  base::writeTextFile(out("mine.txt").toStdString(), "mine");
  panel.exportAllTo(folder.path(), small);
  EXPECT_FALSE(panel.busy());
  EXPECT_THAT(panel.words().toStdString(), HasSubstr("is not empty and holds no former figures"));
  EXPECT_THAT(panel.words().toStdString(), HasSubstr(folder.path().toStdString()));
  EXPECT_TRUE(told.isEmpty());
  EXPECT_EQ(QDir(folder.path()).entryList(QDir::Files), QStringList{"mine.txt"});
}

TEST_F(ExportsAll, CancelLeavesWhatIsDrawnAndCanBeRepeated) {
  panel.choose(0, recording());
  ASSERT_TRUE(settled());
  panel.exportAllTo(out("all"), small);
  panel.cancel();  // before anything is drawn
  ASSERT_TRUE(idle());
  EXPECT_THAT(panel.words().toStdString(), HasSubstr("Cancelled: nothing was exported"));
  EXPECT_FALSE(QFileInfo::exists(out("all")));
  panel.exportAllTo(out("all"), small);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !endingIn(".pdf", out("all")).isEmpty(); }, kPatience));
  panel.findChild<QPushButton*>("cancel_analysis")->click();
  EXPECT_FALSE(panel.busy());
  EXPECT_THAT(panel.words().toStdString(), HasSubstr("Cancelled. "));
  EXPECT_THAT(base::readTextFile(out("all/index.html").toStdString()),
              HasSubstr("Cancelled: not all figures"));
  panel.exportAllTo(out("all"), small);
  ASSERT_TRUE(idle());
  EXPECT_EQ(endingIn(".pdf", out("all")).size(), 3);
}

TEST_F(ExportsAll, TheButtonAndItsKeyAskForAFolder) {
  auto* button = panel.findChild<QToolButton*>("export_all");
  EXPECT_FALSE(button->isEnabled()) << "no run to export";
  panel.choose(0, recording());
  ASSERT_TRUE(settled());
  EXPECT_TRUE(button->isEnabled());
  panel.activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&panel));
  QTest::keyClick(&panel, Qt::Key_E, Qt::ControlModifier | Qt::ShiftModifier);
  auto* dialog = panel.findChild<QFileDialog*>("ask_export_all");
  ASSERT_TRUE(dialog);
  EXPECT_EQ(dialog->fileMode(), QFileDialog::Directory);
  ASSERT_TRUE(QDir(folder.path()).mkdir("chosen"));
  Q_EMIT dialog->fileSelected(out("chosen"));
  dialog->close();
  ASSERT_TRUE(idle());
  EXPECT_EQ(told, out("chosen/index.html"));
}

}  // namespace
}  // namespace capstan::widgets
