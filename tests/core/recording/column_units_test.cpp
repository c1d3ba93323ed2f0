/// Units of measured tables: what stops, what is proposed, what passes without a question.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/base/resource.h"
#include "core/recording/read_table.h"
#include "core/recording/settle_units.h"
#include "tests/support/folders.h"

namespace capstan::recording {
namespace {

robot::Description raven() { return robot::readDescription(base::resource("robots/raven2_left.yaml")); }

/// 400 rows at 1 kHz around a pose of the RAVEN-II, `reach` radians of the motors to either side.
MeasuredTable moving(double reach) {
  MeasuredTable table;
  table.file = "x.csv";
  const std::array q_m = {80.0, -80.0, -480.0}, q = {0.6, 1.6, 0.34}, p_c = {0.071, -0.046, -0.101};
  for (auto* columns : {&table.q_m, &table.dq_m, &table.q, &table.p_c}) columns->resize(3);
  for (int row = 0; row < 400; ++row) {
    const double t = 1e-3 * row, phase = 2.0 * std::numbers::pi * t;
    table.t.push_back(t);
    for (std::size_t i = 0; i < 3; ++i) {
      table.q_m[i].push_back(q_m[i] + reach * std::sin(phase));
      table.dq_m[i].push_back(2.0 * std::numbers::pi * reach * std::cos(phase));
      table.q[i].push_back(q[i]);
      table.p_c[i].push_back(p_c[i]);
    }
  }
  return table;
}

void scale(std::vector<double>& column, double factor) {
  for (double& value : column) value *= factor;
}

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::string proposed(const MeasuredTable& table) {
  return proposedReadAs(table, implausibleUnits(table, raven()));
}

TEST(ColumnUnits, ATableInSiPassesWhetherItMovesOrNot) {
  EXPECT_EQ(proposed(moving(20.0)), "");
  EXPECT_EQ(proposed(moving(0.0)), "") << "at rest";
  EXPECT_EQ(proposed(moving(1e-4)), "") << "less than an encoder count";
}

TEST(ColumnUnits, EachQuantityIsFoundInItsOtherUnit) {
  MeasuredTable table = moving(20.0);
  for (auto& column : table.q_m) scale(column, kDegrees);
  EXPECT_EQ(proposed(table), "q_m=deg");
  for (auto& column : table.dq_m) scale(column, kDegrees);
  EXPECT_EQ(proposed(table), "q_m=deg,dq_m=deg");
  for (auto& column : table.p_c) scale(column, 1e3);
  scale(table.t, 1e3);
  EXPECT_EQ(proposed(table), "t=ms,q_m=deg,dq_m=deg,p_c=mm");
  scale(table.t, 1e3);
  EXPECT_EQ(proposed(table), "t=us,q_m=deg,dq_m=deg,p_c=mm");
}

TEST(ColumnUnits, SpeedsInDegreesAreFoundHoweverSlow) {
  MeasuredTable table = moving(0.5);
  for (auto& column : table.dq_m) scale(column, kDegrees);
  EXPECT_EQ(proposed(table), "dq_m=deg");
}

// 0.34 m is 340 mm, and 19.5 as the RAVEN-II's software publishes it.
TEST(ColumnUnits, ASlidingJointIsInMillimetresOrAsTheRavensSoftwarePublishesIt) {
  MeasuredTable millimetres = moving(20.0), published = moving(20.0);
  scale(millimetres.q[2], 1e3);
  EXPECT_EQ(proposed(millimetres), "q3=mm");
  for (auto& column : published.q) scale(column, kDegrees);
  EXPECT_EQ(proposed(published), "q=deg");
  scale(published.q[2], 1.0 / kDegrees);
  EXPECT_EQ(proposed(published), "q1=deg,q2=deg");
}

TEST(ColumnUnits, AColumnThatCouldBeEitherGoesWithItsNeighbours) {
  MeasuredTable table = moving(20.0);
  for (auto& column : table.q_m) scale(column, kDegrees);
  for (double& value : table.q_m[1]) value = 3.0;  // near the hard stop
  const auto findings = implausibleUnits(table, raven());
  ASSERT_EQ(findings.size(), 3U);
  EXPECT_FALSE(findings[1].implausible);
  EXPECT_EQ(findings[1].unit, ColumnUnit::kDegrees);
  EXPECT_NE(findings[1].text.find("plausible by itself, but q_m1 has the same unit"), std::string::npos)
      << findings[1].text;
}

TEST(ColumnUnits, AColumnThatItsSpeedShowsInSiDoesNotGoWithItsNeighbours) {
  MeasuredTable table = moving(20.0);
  scale(table.q_m[0], kDegrees);
  EXPECT_EQ(proposed(table), "q_m1=deg");
  scale(table.dq_m[0], kDegrees);
  EXPECT_EQ(proposed(table), "q_m=deg,dq_m=deg") << "both may be in degrees: a person is asked about all";
}

TEST(ColumnUnits, CentimetresAreToldFromMillimetres) {
  MeasuredTable table = moving(20.0);
  for (auto& column : table.p_c) scale(column, 1e2);
  scale(table.q[2], 1e2);
  EXPECT_EQ(proposed(table), "q3=cm,p_c=cm");
  for (auto& column : table.p_c) scale(column, 1e-6);
  EXPECT_EQ(proposed(table), "q3=cm,p_c=keep") << "a tip at the base is in no unit that there is";
}

TEST(ColumnUnits, AStatedUnitThatDoesNotSuitTheTableIsRefusedByName) {
  const MeasuredTable si = moving(20.0);
  MeasuredTable millimetres = si;
  scale(millimetres.q[2], 1e3);
  struct Case {
    const MeasuredTable& table;
    const char* stated;
    const char* column;
  };
  for (const auto& [table, stated, column] :
       {Case{millimetres, "q=deg", "q3 "}, Case{si, "p_c=mm", "p_c1 "}, Case{si, "q_m=deg", "dq_m1 "},
        Case{si, "t=ms", "t "}, Case{si, "dq_m=deg", ""}}) {
    MeasuredTable read = table;
    std::string message;
    try {
      settleUnits(read, raven(), parseReadAs(stated, "x"));
    } catch (const ImplausibleUnits&) {
      ADD_FAILURE() << stated << " was accepted, and another unit required";
    } catch (const base::InputError& error) {
      message = error.what();
    }
    if (*column == '\0') continue;  // slow motors: nothing shows it
    EXPECT_NE(message.find("--read-as"), std::string::npos) << stated << ": " << message;
    EXPECT_NE(message.find(stated), std::string::npos) << message;
    EXPECT_NE(message.find(column), std::string::npos) << message;
  }
}

TEST(ColumnUnits, GlitchesAreNoUnits) {
  MeasuredTable table = moving(20.0);
  for (const std::size_t row : {100U, 300U}) table.q_m[0][row] = 1e6, table.p_c[1][row] = 40.0;
  EXPECT_EQ(proposed(table), "");
}

TEST(ColumnUnits, WhatNoUnitExplainsIsAskedForAsWell) {
  MeasuredTable table = moving(20.0);
  for (double& value : table.q[0]) value = 1e9;
  EXPECT_EQ(proposed(table), "q1=keep");
}

TEST(ColumnUnits, SettledColumnsAreInSiAndAskedForNoMore) {
  const MeasuredTable si = moving(20.0);
  MeasuredTable table = si;
  for (auto& column : table.q_m) scale(column, kDegrees);
  MeasuredTable kept = table, part = table;
  EXPECT_THROW(settleUnits(part, raven(), {}), ImplausibleUnits);
  part = table;
  EXPECT_THROW(settleUnits(part, raven(), parseReadAs("q_m1=deg", "x")), ImplausibleUnits);
  settleUnits(table, raven(), parseReadAs("q_m=deg", "x"));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t row = 0; row < si.rows(); ++row)
      ASSERT_NEAR(table.q_m[i][row], si.q_m[i][row], 1e-12 * std::abs(si.q_m[i][row]));
  const TableColumns before = kept.q_m;
  settleUnits(kept, raven(), parseReadAs("q_m=keep,dq_m=keep", "x"));
  EXPECT_EQ(kept.q_m, before);
}

TEST(ColumnUnits, TheOptionReadsWhatItWrites) {
  const ReadAs read_as = parseReadAs("q_m=deg,q3=mm,t=ms,p_c=keep", "x");
  EXPECT_EQ(parseReadAs(formatReadAs(read_as), "x"), read_as);
  EXPECT_EQ(read_as.of("q_m", "q_m2"), ColumnUnit::kDegrees);
  EXPECT_EQ(read_as.of("q", "q1"), std::nullopt);
  EXPECT_EQ(read_as.of("q", "q3"), ColumnUnit::kMillimetres);
  for (const char* wrong : {"q_m=mm", "t=deg", "tau_m=keep", "q_m", "q9=deg", "q_m=deg,q_m=deg", ","})
    EXPECT_THROW(parseReadAs(wrong, "x"), base::InputError) << wrong;
  MeasuredTable table = moving(1.0);
  EXPECT_THROW(readColumnsAs(table, raven(), parseReadAs("q1=mm", "x")), base::InputError) << "it turns";
  table.dq_m.clear();
  EXPECT_THROW(readColumnsAs(table, raven(), parseReadAs("dq_m=deg", "x")), base::InputError);
}

TEST(ColumnUnits, TheSharedRecordingsPassWithoutAQuestion) {
  REQUIRE_DATA(test::dataFolder());
  std::size_t tables = 0;
  for (const char* folder :
       {"plant", "plant-textured", "davinci-jaw", "davinci-jaw-right", "emps", "raven2-motors"})
    for (const auto& entry : std::filesystem::directory_iterator(test::dataFolder() / folder)) {
      if (entry.path().extension() != ".csv") continue;
      EXPECT_NO_THROW(readTable(entry.path(), raven())) << entry.path();
      ++tables;
    }
  EXPECT_GT(tables, 60U);
}

}  // namespace
}  // namespace capstan::recording
