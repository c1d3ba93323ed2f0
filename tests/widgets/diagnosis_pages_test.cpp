// What the diagnosis panel shows of a report besides its signatures: displacements, effects below the
// tolerance, posterior, refit and gain; and the choices of tolerance and recording.
#include <gmock/gmock.h>

#include <QAction>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QSettings>
#include <QTemporaryDir>
#include <QToolButton>
#include <QTreeWidgetItemIterator>

#include "tests/widgets/diagnosis_fixture.h"
#include "tests/widgets/picture.h"
#include "widgets/figures/share_bar.h"
#include "widgets/panels/diagnosis/gain_table.h"
#include "widgets/panels/diagnosis/interval_cell.h"
#include "widgets/panels/diagnosis/posterior_table.h"
#include "widgets/panels/diagnosis/refit_table.h"
#include "widgets/panels/diagnosis/signature_view.h"
#include "widgets/panels/diagnosis/time_view.h"
#include "widgets/panels/diagnosis/wrapped_words.h"

namespace capstan::widgets {
namespace {

using ::testing::HasSubstr;

/// Every text of the tree is at most as wide as its cell.
void expectWhole(QTreeWidget& tree) {
  for (QTreeWidgetItemIterator it(&tree); *it; ++it)
    for (int column = 0; column < tree.columnCount(); ++column) {
      if ((*it)->isFirstColumnSpanned() || tree.isColumnHidden(column)) continue;
      const QFontMetrics metrics((*it)->font(column));
      for (const QString& line : (*it)->text(column).split('\n'))
        EXPECT_LE(metrics.horizontalAdvance(line), tree.columnWidth(column)) << line.toStdString();
    }
  const QFontMetrics metrics(tree.header()->font());
  for (int column = 0; column < tree.columnCount(); ++column) {
    if (tree.isColumnHidden(column)) continue;
    for (const QString& line : tree.headerItem()->text(column).split('\n'))
      EXPECT_LE(metrics.horizontalAdvance(line), tree.columnWidth(column)) << line.toStdString();
  }
}

TEST_F(Diagnosis, EffectsBelowTheToleranceAreFolded) {
  panel->showReport(sample(Verdict::kFound));
  CauseTree& tree = panel->causes();
  QTreeWidgetItem* group = tree.topLevelItem(tree.topLevelItemCount() - 1);
  EXPECT_THAT(causes(), HasSubstr("Also measurable, below the tolerance of 0.02deg,0.02mm or 6 % of the mean "
                                  "square of a channel (1)"));
  EXPECT_FALSE(group->isExpanded());
  EXPECT_EQ(tree.chosen()->effect, "backlash");
  tree.scrollToItem(group);
  QTest::mouseClick(tree.viewport(), Qt::LeftButton, {}, tree.visualItemRect(group).center());
  EXPECT_TRUE(group->isExpanded());
  ASSERT_TRUE(tree.chosen());
  EXPECT_EQ(tree.chosen()->effect, "asymmetric_friction");
  QTest::keyClick(&tree, Qt::Key_Space);
  EXPECT_FALSE(group->isExpanded());
  panel->showReport(sample(Verdict::kNothing));
  EXPECT_THAT(causes(), ::testing::Not(HasSubstr("Also measurable")));
}

TEST_F(Diagnosis, TheExplainedShareIsALineInBothFigures) {
  panel->showReport(sample(Verdict::kFound));
  const char* words = "of what the recorded signals can explain of the residual of q2";
  EXPECT_THAT(panel->pages().signatures().figure()->caption().toStdString(), HasSubstr(words));
  panel->pages().setCurrentIndex(1);
  EXPECT_THAT(panel->pages().course().figure()->caption().toStdString(), HasSubstr(words));
}

TEST_F(Diagnosis, ThePosteriorIsShownAsBars) {
  panel->showReport(sample(Verdict::kTie));
  PosteriorTable& posterior = panel->pages().posterior();
  const QStringList lines = posterior.lines();
  ASSERT_EQ(lines.size(), 2);
  EXPECT_TRUE(lines[0].endsWith("| 55.0 %")) << lines[0].toStdString();
  EXPECT_TRUE(lines[1].endsWith("| 43.0 %")) << lines[1].toStdString();
  EXPECT_NEAR(ShareBar::shareOf(*posterior.topLevelItem(0), PosteriorTable::kProbability), 0.55, 1e-12);
  EXPECT_THAT(posterior.topLevelItem(2)->text(0).toStdString(), HasSubstr("All other sets"));
}

TEST_F(Diagnosis, TheRefitHasAColumnWithoutAndOneWithTheEffects) {
  panel->showReport(sample(Verdict::kFound));
  const RefitTable& refit = panel->pages().refit();
  EXPECT_FALSE(refit.isColumnHidden(RefitTable::kWithout));
  EXPECT_EQ(refit.headerItem()->text(RefitTable::kValue), "with effects");
  EXPECT_THAT(wordsOf(*refit.topLevelItem(0), RefitTable::kName).toStdString(),
              HasSubstr("Grey: changed by less"));
  const QTreeWidgetItem& stiffness = *refit.topLevelItem(1);
  EXPECT_NE(stiffness.text(RefitTable::kWithout), stiffness.text(RefitTable::kNominal));
  EXPECT_THAT(stiffness.text(RefitTable::kValue).toStdString(), HasSubstr("±"));
  EXPECT_THAT(refit.topLevelItem(2)->text(RefitTable::kChange).toStdString(), HasSubstr("at its bound"));
  EXPECT_TRUE(stiffness.font(RefitTable::kChange).bold()) << "significant and material";
  EXPECT_THAT(stiffness.toolTip(RefitTable::kChange).toStdString(), HasSubstr("0.859 deg at joint 2"));
  EXPECT_FALSE(refit.topLevelItem(2)->font(RefitTable::kChange).bold())
      << "it moves no joint by the tolerance";
  panel->showReport(sample(Verdict::kNothing));
  EXPECT_TRUE(refit.isColumnHidden(RefitTable::kWithout)) << "both are the same";
}

TEST_F(Diagnosis, TheGainIsDrawnOverAnAxis) {
  panel->showReport(sample(Verdict::kSeveral));
  const QTreeWidgetItem& simulation = *panel->pages().gain().topLevelItem(0);
  QStringList units;
  for (int i = 0; i < simulation.childCount(); ++i) {
    const QStringList numbers = IntervalCell::numbersOf(*simulation.child(i), GainTable::kDrawn);
    if (numbers.isEmpty()) continue;
    units << simulation.child(i)->text(GainTable::kLeft);
    EXPECT_EQ(numbers[0], "0");
    EXPECT_GE(numbers.size(), 2);
    EXPECT_LE(numbers.size(), 5);
  }
  EXPECT_EQ(units, (QStringList{"[deg]", "[mm]"}));
  EXPECT_THAT(IntervalAxis::to(0.9).ticks, ::testing::ElementsAre(0.0, 0.5));
  EXPECT_THAT(IntervalAxis::to(4.0).ticks, ::testing::ElementsAre(0.0, 1.0, 2.0, 3.0, 4.0));
  EXPECT_THAT(IntervalAxis::to(0.0).ticks, ::testing::ElementsAre(0.0));
}

TEST_F(Diagnosis, NumbersAtTheAxisOfTheGainDoNotTouch) {
  using ::testing::ElementsAre;
  EXPECT_THAT(numbersDrawn({10, 50, 90, 130, 170}, {8, 20, 20, 20, 20}), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(numbersDrawn({10, 50, 90, 130, 170}, {8, 38, 38, 38, 38}), ElementsAre(0, 2, 4));
  EXPECT_THAT(numbersDrawn({10, 25, 40, 55}, {8, 30, 30, 30}), ElementsAre(0, 2))
      << "0, 0.0005, 0.001, 0.0015";
  EXPECT_THAT(numbersDrawn({10, 20}, {8, 30}), ElementsAre(1)) << "the scale stays readable";
  EXPECT_THAT(numbersDrawn({}, {}), ElementsAre());
}

TEST_F(Diagnosis, TheToleranceIsChangedInPlaceAndKept) {
  DiagnosisChoice asked;
  show([&asked](const DiagnosisChoice& choice, base::Progress&) {
    asked = choice;
    return sample(Verdict::kFound);
  });
  panel->choose({.recordings = {"/a/one.csv"}});
  auto* edit = panel->findChild<QLineEdit*>("tolerance");
  auto* words = panel->findChild<QLabel*>("tolerance_words");
  EXPECT_EQ(edit->text().toStdString(), diagnosis::formatTolerance({}));
  edit->setText("0.1");
  EXPECT_THAT(words->text().toStdString(), HasSubstr("is no angle or length"));
  EXPECT_FALSE(button("diagnose_now")->isEnabled());
  EXPECT_THAT(headline(), HasSubstr("tolerance cannot be read"));
  edit->setText("0.1deg");
  EXPECT_TRUE(button("diagnose_now")->isEnabled());
  panel->diagnose();
  ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  EXPECT_EQ(asked.material, "0.1deg");
  EXPECT_TRUE(panel->report());
  edit->setText("0.2deg");
  EXPECT_FALSE(panel->report()) << "of another tolerance";
  const QTemporaryDir folder;
  QSettings settings(folder.filePath("settings.ini"), QSettings::IniFormat);
  panel->save(settings);
  show(nullptr);
  panel->restore(settings);
  EXPECT_EQ(panel->choice().material, "0.2deg");
  EXPECT_EQ(toleranceOf(panel->choice().material).length, diagnosis::Tolerance{}.length);
}

TEST_F(Diagnosis, ARecordingIsPreselectedWhereNoneIsChosen) {
  panel->preselect("/a/open.csv", "/a/mine.yaml");
  EXPECT_EQ(panel->choice().recordings, QStringList{"/a/open.csv"});
  EXPECT_EQ(panel->choice().robot, "/a/mine.yaml");
  panel->preselect("/a/other.capstan", "");
  EXPECT_EQ(panel->choice().recordings, QStringList{"/a/other.capstan"}) << "the open one is diagnosed";
  EXPECT_EQ(panel->choice().robot, "") << "with its own robot";
  panel->showReport(sample(Verdict::kFound));
  panel->preselect("/a/third.capstan", "");
  EXPECT_EQ(panel->choice().recordings, QStringList{"/a/other.capstan"}) << "the report is of this one";
  panel->choose({.recordings = {"/a/one.csv", "/a/two.csv"}});
  panel->preselect("/a/third.capstan", "");
  EXPECT_EQ(panel->choice().recordings.size(), 2) << "what the user has chosen stays";
}

TEST_F(Diagnosis, TheEffortIsChosenAndKept) {
  DiagnosisChoice asked;
  show([&asked](const DiagnosisChoice& choice, base::Progress&) {
    asked = choice;
    return sample(Verdict::kFound);
  });
  panel->choose({.recordings = {"/a/one.csv"}});
  auto* effort = panel->findChild<QComboBox*>("effort");
  ASSERT_TRUE(effort);
  EXPECT_EQ(effort->currentText(), QString::fromUtf8("×1"));
  effort->setCurrentIndex(effort->findText(QString::fromUtf8("×4")));
  panel->diagnose();
  ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  EXPECT_EQ(asked.effort, 4.0);
  EXPECT_TRUE(panel->report());
  effort->setCurrentIndex(effort->findText(QString::fromUtf8("×16")));
  EXPECT_FALSE(panel->report()) << "of another effort";
  const QTemporaryDir folder;
  QSettings settings(folder.filePath("settings.ini"), QSettings::IniFormat);
  panel->choose({.effort = 3.0});
  panel->save(settings);
  show(nullptr);
  panel->restore(settings);
  EXPECT_EQ(panel->choice().effort, 3.0) << "also one that is not in the list";
}

TEST_F(Diagnosis, TheUnitsOfTheOpenRecordingAreThoseOfTheDiagnosis) {
  panel->offer("/a/open.csv", "Choose the open one", "q_m=deg");
  panel->preselect("/a/open.csv", "", "q_m=deg");
  EXPECT_EQ(panel->choice().read_as, "q_m=deg");
  auto* units = panel->findChild<QToolButton*>("units");
  ASSERT_TRUE(units);
  EXPECT_TRUE(units->isVisible());
  EXPECT_THAT(units->toolTip().toStdString(), HasSubstr("q_m=deg"));
  panel->showReport(sample(Verdict::kFound));
  units->menu()->actions().at(0)->trigger();
  EXPECT_EQ(panel->choice().read_as, "");
  EXPECT_FALSE(panel->report()) << "read in other units";
  panel->choose({.recordings = {"/a/one.csv"}});
  EXPECT_EQ(panel->choice().read_as, "");
  panel->findChild<QToolButton*>("offered")->click();
  EXPECT_EQ(panel->choice().read_as, "q_m=deg") << "it comes with its recording";
  const QTemporaryDir folder;
  QSettings settings(folder.filePath("settings.ini"), QSettings::IniFormat);
  panel->save(settings);
  show(nullptr);
  panel->restore(settings);
  EXPECT_EQ(panel->choice().read_as, "") << "of an earlier recording";
  EXPECT_FALSE(panel->findChild<QToolButton*>("units")->isVisible());
}

TEST_F(Diagnosis, RecordingsOfAnEarlierSessionAreForgotten) {
  panel->choose({.recordings = {"/a/one.csv"}, .robot = "/a/mine.yaml"});
  const QTemporaryDir folder;
  QSettings settings(folder.filePath("settings.ini"), QSettings::IniFormat);
  panel->save(settings);
  show(nullptr);
  panel->restore(settings);
  EXPECT_TRUE(panel->choice().recordings.isEmpty());
  EXPECT_TRUE(panel->choice().robot.isEmpty());
}

/// About the room between the docks of a window of 1280 px.
TEST_F(Diagnosis, NoTextIsCutInANarrowPanel) {
  panel->resize(620, 620);
  panel->showReport(sample(Verdict::kSeveral));
  QTest::qWait(50);
  expectWhole(panel->causes());
  for (int page = 2; page < panel->pages().count(); ++page) {
    panel->pages().setCurrentIndex(page);
    QTest::qWait(50);
    auto* tree = qobject_cast<QTreeWidget*>(panel->pages().currentWidget());
    ASSERT_TRUE(tree) << page;
    expectWhole(*tree);
    test::grab(*panel, QStringLiteral("diagnosis_panel_narrow_%1").arg(page));
  }
}

}  // namespace
}  // namespace capstan::widgets
