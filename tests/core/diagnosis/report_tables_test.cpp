// Tables and robot file of a report say its numbers, in units for people.
#include "core/diagnosis/report/report_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/diagnosis/hypotheses/hypothesis.h"
#include "core/diagnosis/report/extended_robot.h"
#include "tests/support/sample_diagnosis.h"

namespace capstan::diagnosis {
namespace {

using base::Table;
using testing::sampleReport;

std::size_t columnOf(const Table& table, const std::string& name) {
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    if (table.columns[i].name == name) return i;
  ADD_FAILURE() << "no column " << name;
  return 0;
}

void expectWhole(const Table& table) {
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.title;
}

TEST(ReportTables, ChannelsInDegreesAndMillimetres) {
  const Report report = sampleReport({.recordings = 2, .duration = 12.0});
  const Table table = channelTable(report);
  expectWhole(table);
  ASSERT_EQ(table.rows.size(), 6U);
  EXPECT_EQ(table.rows[1][1].text, "q2 [deg]");
  EXPECT_EQ(table.rows[2][1].text, "q3 [mm]");
  EXPECT_EQ(table.rows[4][0].text, "fast1.csv");
  EXPECT_NEAR(table.rows[1][columnOf(table, "refitted")].number,
              report.channels[1].refitted_statistics.rms * 180.0 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(table.rows[2][columnOf(table, "extended")].number,
              report.channels[2].extended_statistics.rms * 1e3, 1e-12);
  const std::string left = table.rows[1][columnOf(table, "RMS ratio, held out [%]")].text;
  EXPECT_NE(left.find('('), std::string::npos) << left;
  const Table quiet = channelTable(sampleReport({.verdict = Verdict::kNothing, .duration = 12.0}));
  expectWhole(quiet);
  for (const auto& column : quiet.columns) EXPECT_NE(column.name, "extended") << "nothing was added";
}

TEST(ReportTables, RefitShowsFirstWhatMoved) {
  Report report = sampleReport({.duration = 12.0});
  std::swap(report.refit[0], report.refit[1]);
  const Table table = refitTable(report);
  expectWhole(table);
  const std::size_t change = columnOf(table, "change"), remark = columnOf(table, "remark");
  EXPECT_EQ(table.rows[0][0].text, "cable stiffness of joint 2");
  EXPECT_EQ(table.rows[0][change].text, "−18.0 %");
  EXPECT_EQ(table.rows[0][remark].text, "material: 0.859 deg at joint 2");
  EXPECT_NE(table.rows[1][remark].text.find("bound"), std::string::npos);
  EXPECT_EQ(table.rows[2][remark].text, "not moved");
  report.refit[0].nominal = 0.0;
  expectWhole(refitTable(report));
}

// A change of 494 % of a tiny number that moves nothing is no news; one of 3 % that moves a joint is.
TEST(ReportTables, RefitEmphasisesWhatIsSignificantAndMaterial) {
  Report report;
  RefitNumber tiny{"centre_of_mass_x of joint 2", "m", -2e-3, -11.88e-3, 0.1e-3, false, true, -10e-3};
  tiny.moves.joints = {{0.0, 0.0, false}, {5e-5, 9e-5, false}, {1e-6, 2e-6, true}};
  RefitNumber large{"mass of joint 3", "kg", 0.231, 0.238, 0.001, false, true, 0.24};
  large.moves.joints = {{0.0, 0.0, false}, {1e-3, 2e-3, false}, {1e-6, 2e-6, true}};
  large.material = true;
  report.refit = {tiny, large};
  EXPECT_EQ(refitInOrder(report)[0].name, large.name);
  EXPECT_EQ(refitChange(large), "+3.0 %");
  EXPECT_EQ(refitChange(tiny), "−9.88 mm") << "the difference, where it is larger than the nominal value";
  EXPECT_EQ(refitRemark(large, {}), "material: 0.0573 deg at joint 2");
  EXPECT_EQ(refitRemark(tiny, {}), "moved: 0.00286 deg at joint 2");
  RefitNumber zero{"centre_of_mass_x of joint 3", "m", 0.0, 5e-3, 1e-2, true, false, 0.0};
  EXPECT_EQ(refitChange(zero), "+5.00 mm");
  EXPECT_EQ(refitRemark(zero, {}), "not moved; at its bound: it would go further");
}

TEST(ReportTables, RefitShowsValuesWithAndWithoutEffects) {
  Report report = sampleReport({.duration = 12.0});
  report.refit = {{"cable_stiffness of joint 2", "N", 1000.0, 820.0, 0.0, false, true, 710.0}};
  const Table with = refitTable(report);
  EXPECT_EQ(with.rows[0][columnOf(with, "without effects")].text, "710 N");
  EXPECT_EQ(with.rows[0][columnOf(with, "with effects")].text, "820 N");
  report.causes.clear(), report.also_measurable.clear();
  const Table alone = refitTable(report);
  expectWhole(alone);
  EXPECT_EQ(alone.rows[0][columnOf(alone, "refitted")].text, "820 N");
  for (const auto& column : alone.columns)
    EXPECT_EQ(column.name.find("effects"), std::string::npos) << column.name;
}

TEST(ReportTables, RankingIsByRoundAndLikelihoodAndSaysWhatItLeavesOut) {
  const Report report = sampleReport({.verdict = Verdict::kSeveral, .duration = 12.0});
  const Table table = rankingTable(report);
  expectWhole(table);
  ASSERT_EQ(table.rows.size(), report.candidates.size());
  EXPECT_EQ(table.rows[0][1].text, titleOf("backlash"));
  EXPECT_EQ(table.rows[3][2].text, "whole arm") << "not refitted: last of its round";
  EXPECT_TRUE(std::isnan(table.rows[3][columnOf(table, "trial score")].number));
  EXPECT_EQ(table.rows[4][0].number, 2.0);
  const Table brief = rankingTable(report, 1);
  EXPECT_EQ(brief.rows.size(), 2U) << "one a round";
  EXPECT_NE(brief.note.find("4 more"), std::string::npos) << brief.note;
}

// A candidate that removes more in its trial than the cause, and is improbable in the end.
TEST(ReportTables, RankingAgreesWithTheVerdict) {
  Report report = sampleReport({.duration = 12.0});
  Candidate& trial = report.candidates[1];
  trial.reduction = 0.978, trial.score = 500.0, trial.probability = 3e-4;
  report.candidates[2].probability = 0.0;
  report.candidates[3].probability = 0.68;  // settled before this round: no trial fit in it
  const Table table = rankingTable(report);
  const std::size_t final = columnOf(table, "final probability [%]");
  EXPECT_EQ(table.rows[0][1].text, titleOf("backlash"));
  EXPECT_EQ(table.rows[0][final].text, "97");
  EXPECT_EQ(table.rows[0].back().text, "yes");
  EXPECT_EQ(table.rows[1][1].text, titleOf("gravity_tilt")) << "by its probability, before those of none";
  EXPECT_EQ(table.rows[1][final].text, "68");
  EXPECT_EQ(table.rows[2][final].text, "< 1") << "not 0: it was fitted to the end";
  EXPECT_EQ(table.rows[2].back().text, "no");
  EXPECT_EQ(table.rows[3][final].text, "–");
  EXPECT_NE(table.note.find(rankingNote()), std::string::npos);
}

TEST(ReportTables, ATieListsTheMoreProbableCauseFirst) {
  Report report = sampleReport({.verdict = Verdict::kTie, .duration = 12.0});
  Tie& tie = report.ties[0];
  tie.causes[0].probability = 0.36, tie.causes[1].probability = 0.64;
  const std::vector<Cause> shown = mostProbableFirst(tie);
  ASSERT_EQ(shown.size(), 2U);
  EXPECT_EQ(shown[0].effect, "cable_hysteresis");
  EXPECT_EQ(shown[1].effect, "backlash");
  EXPECT_EQ(tie.causes[0].effect, "backlash") << "the model stays what it is";
}

TEST(ReportTables, LinesProcessesAndFilter) {
  const Report report = sampleReport({.verdict = Verdict::kUnexplained});
  const Table lines = lineTable(report);
  expectWhole(lines);
  EXPECT_EQ(lines.rows[0][2].text, "0.400 mm");
  const Table process = processTable(report.processes[0]);
  expectWhole(process);
  EXPECT_EQ(process.rows[0][0].text, report.processes[0].variables[0].name);
  EXPECT_LT(process.rows.size(), report.processes[0].variables.size());
  EXPECT_NE(process.note.find("more variables hardly matter"), std::string::npos) << process.note;
  ResidualProcess nothing = report.processes[0];
  for (ProcessVariable& variable : nothing.variables) variable.relevance = -0.01;
  EXPECT_EQ(processTable(nothing).rows.size(), 1U);
  EXPECT_TRUE(filterTable(report).rows.empty());
  const Table filter = filterTable(sampleReport({.duration = 12.0}));
  expectWhole(filter);
  EXPECT_NEAR(filter.rows[2][1].number, 1.6, 1e-12) << "[mm]";
}

TEST(ReportTables, CausesInWords) {
  const Report report = sampleReport({.verdict = Verdict::kTie, .duration = 12.0});
  EXPECT_EQ(causeText(report.causes[0]),
            titleOf("backlash") +
                ", joint 2: half width 0.930 ± 0.030 mm of cable (0.859 ± 0.028 deg "
                "at the joint)");
  EXPECT_EQ(causeText(report.ties[0].causes[1]),
            titleOf("cable_hysteresis") + ", joint 2: force 31.0 ± 4.0 N, yield 0.110 ± 0.060 mm");
  EXPECT_EQ(titleOf("backlash"), hypothesisNamed("backlash")->words.title);
  EXPECT_EQ(titleOf("no such effect"), "no such effect");
  Gain gain{"q3", "m", 2e-3, 1e-3, {}, {}, {0.4, 0.6}};
  EXPECT_EQ(
      gainText(gain),
      "q3: RMS 2.00 mm becomes 1.00 mm, 50.0 % of it (95 %: 40.0 to 60.0 %), on data that were not fitted");
  gain.rms_before = 0.0;
  EXPECT_EQ(gainText(gain).find("%"), std::string::npos) << "no share of nothing";
}

TEST(ReportTables, WhatAnEffectMoves) {
  Cause cause;
  EXPECT_EQ(movesText(cause), "moves nothing in these recordings");
  cause.moves.joints = {
      {1e-6, 2e-6, false}, {std::numbers::pi / 180.0, std::numbers::pi / 90.0, false}, {4e-3, 5e-3, true}};
  const std::string joints =
      "moves joint 2 by 1.00 deg RMS (largest 2.00 deg), joint 3 by 4.00 mm RMS (largest 5.00 mm)";
  EXPECT_EQ(movesText(cause), joints) << "joint 1 moves by less than a tenth of joint 2";
  cause.moves.tip = {1e-3, 3e-3, true};
  EXPECT_EQ(movesText(cause), joints + ", the tip by 1.00 mm RMS (largest 3.00 mm)");
  cause.moves.joints.clear();
  cause.effect = "camera_latency";
  EXPECT_EQ(movesText(cause), "moves the tip in the cameras' view by 1.00 mm RMS (largest 3.00 mm)");
}

TEST(ReportTables, TheDisplacementOfTheTipIsOneLine) {
  Report report;
  EXPECT_EQ(tipText(report), "");
  Cause cause{.effect = "backlash", .joint = 2, .parameters = {}};
  report.causes = {cause};
  EXPECT_EQ(tipText(report), "") << "it does not move the tip";
  report.causes[0].moves.tip = {1.9e-3, 4.2e-3, true};
  EXPECT_EQ(tipText(report), "Tip displacement: 1.90 mm RMS (largest 4.20 mm).");
  report.causes.push_back({.effect = "camera_latency", .parameters = {}});
  report.causes[1].moves.tip = {1e-3, 3e-3, true};
  EXPECT_EQ(tipText(report), "Tip displacement: 1.90 mm RMS (largest 4.20 mm) by " + titleOf("backlash") +
                                 " (joint 2); 1.00 mm RMS (largest 3.00 mm) in the cameras' view by " +
                                 titleOf("camera_latency") + " (cameras).");
}

TEST(ReportTables, ExplainableBesideRegressions) {
  Report report;
  report.explainable = {{"q2", "rad", 1e-5, 2.0 * std::numbers::pi / 180.0, std::numbers::pi / 180.0, 3e-3,
                         NAN, 0.75, "depends on q_m2"},
                        {"q3", "m", 1e-6, 2e-3, 2e-3, NAN, NAN, NAN, {}}};
  const Table table = explainableTable(report);
  expectWhole(table);
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0][0].text, "q2 [deg]");
  EXPECT_NEAR(table.rows[0][columnOf(table, "refitted")].number, 2.0, 1e-12);
  EXPECT_NEAR(table.rows[0][columnOf(table, "with effects")].number, 1.0, 1e-12);
  EXPECT_NEAR(table.rows[0][columnOf(table, "least squares")].number, 3e-3 * 180.0 / std::numbers::pi, 1e-12);
  EXPECT_TRUE(std::isnan(table.rows[0][columnOf(table, "Gaussian process")].number));
  EXPECT_NEAR(table.rows[0][columnOf(table, "explained")].number, 75.0, 1e-12);
  EXPECT_EQ(table.rows[1][0].text, "q3 [mm]");
  EXPECT_TRUE(std::isnan(table.rows[1][columnOf(table, "explained")].number));
  EXPECT_NE(explainedText(report, "q2").find("75 %"), std::string::npos) << explainedText(report, "q2");
  EXPECT_NE(explainedText(report, "q3").find("No regression"), std::string::npos)
      << explainedText(report, "q3");
  EXPECT_TRUE(explainedText(report, "q1").empty());
}

TEST(ReportTables, PosteriorOfSetsAndAllOthers) {
  Report report;
  report.posterior = {{{{"backlash", 2}, {"payload", 0}}, 0.5}, {{{"backlash", 2}}, 0.25}, {{}, 0.125}};
  const Table table = posteriorTable(report);
  expectWhole(table);
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.rows[0][0].text,
            titleOf("backlash") + " (joint 2) + " + titleOf("payload") + " (whole arm)");
  EXPECT_EQ(table.rows[0][1].number, 50.0);
  EXPECT_EQ(table.rows[2][0].text, "none");
  EXPECT_NE(table.note.find("12.5 %"), std::string::npos) << table.note;
  const Table brief = posteriorTable(report, 1);
  EXPECT_EQ(brief.rows.size(), 1U);
  EXPECT_NE(brief.note.find("50.0 %"), std::string::npos) << brief.note;
}

TEST(ReportTables, PosteriorMarksTheModel) {
  const Table table = posteriorTable(sampleReport({.duration = 12.0}));
  EXPECT_NE(table.rows[0][0].text.find("← the model"), std::string::npos) << table.rows[0][0].text;
  EXPECT_EQ(table.rows[1][0].text.find("← the model"), std::string::npos) << table.rows[1][0].text;
}

TEST(ExtendedRobot, IsARobotFileThatSaysWhereItIsFrom) {
  Report report = sampleReport({.duration = 12.0});
  report.recordings[0] = "two\nlines.csv";
  const std::string text = extendedRobotText(report, "capstan 9");
  EXPECT_EQ(text.rfind("# Extended by a diagnosis of two lines.csv, by capstan 9", 0), 0U)
      << text.substr(0, 90);
  EXPECT_NE(text.find("#   " + causeText(report.causes[0]) + "; probability 97 %\n"), std::string::npos);
  EXPECT_NE(text.find("cable stiffness of joint 2: "), std::string::npos);
  EXPECT_EQ(text.find("coulomb friction of joint 1: "), std::string::npos) << "it did not move";
  EXPECT_EQ(robot::formatDescription(robot::parseDescription(text, "text")),
            robot::formatDescription(report.extended));
  const Report quiet = sampleReport({.verdict = Verdict::kNothing, .duration = 12.0});
  EXPECT_NE(extendedRobotText(quiet, "").find("no missing effect was identified"), std::string::npos);
}

}  // namespace
}  // namespace capstan::diagnosis
