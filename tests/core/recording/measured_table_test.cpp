#include "core/recording/measured_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/live/occlusion.h"
#include "core/recording/own_kinematics.h"
#include "core/recording/raven_motors.h"
#include "core/recording/settle_units.h"
#include "core/recording/table_source.h"
#include "core/robot/transmission.h"
#include "tests/core/recording/session_samples.h"

namespace capstan::recording {
namespace {

using namespace testing;

base::InputFault faultOf(const std::string& text) {
  try {
    parseMeasuredTable(text, "x.csv");
  } catch (const base::InputError& error) {
    EXPECT_FALSE(error.fault().remedy.empty()) << error.what();
    EXPECT_EQ(error.fault().file, "x.csv");
    return error.fault();
  }
  ADD_FAILURE() << "accepted: " << text;
  return {};
}

TEST(MeasuredTable, ColumnsInAnyOrderWithGapsAndOthers) {
  const auto table = parseMeasuredTable(
      "\xef\xbb\xbfq2, note ,q_m2,t,q1,q_m1\r\n2,9,-4,0,1e-3,\r\n3,abc,5,0.001,,+6\r\n\r\n", "x.csv");
  EXPECT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.joints(), 2);
  EXPECT_EQ(table.t, (std::vector<double>{0.0, 0.001}));
  EXPECT_EQ(table.q_m[1], (std::vector<double>{-4, 5}));
  EXPECT_TRUE(std::isnan(table.q_m[0][0]));
  EXPECT_EQ(table.q_m[0][1], 6.0);
  EXPECT_EQ(table.q[0][0], 1e-3);
  EXPECT_TRUE(std::isnan(table.q[0][1]));
  EXPECT_TRUE(table.dq_m.empty());
  EXPECT_EQ(table.ignored, (std::vector<std::string>{"note"}));
}

TEST(MeasuredTable, WritesWhatItReads) {
  base::Random random(1);
  MeasuredTable table;
  for (int i = 0; i < 500; ++i) table.t.push_back(i * 0.1 + random.uniform(0, 0.05));
  for (auto* quantity : {&table.q_m, &table.q, &table.p_c, &table.tau_ext})
    for (int k = 0; k < 3; ++k) {
      quantity->emplace_back();
      for (int i = 0; i < 500; ++i) quantity->back().push_back(awkward(random));
    }
  const auto back = parseMeasuredTable(formatMeasuredTable(table), "x.csv");
  for (std::size_t row = 0; row < 500; ++row) {
    ASSERT_TRUE(sameBits(table.t[row], back.t[row]));
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_TRUE(sameBits(table.q_m[k][row], back.q_m[k][row]));
      ASSERT_TRUE(sameBits(table.q[k][row], back.q[k][row]));
      ASSERT_TRUE(sameBits(table.p_c[k][row], back.p_c[k][row]));
      ASSERT_TRUE(sameBits(table.tau_ext[k][row], back.tau_ext[k][row]));
    }
  }
}

TEST(MeasuredTable, FaultsNameLineColumnAndValue) {
  const auto word = faultOf("t,q_m1\n0,1\n0.001,abc\n");
  EXPECT_EQ(word.line, 3);
  EXPECT_EQ(word.key, "q_m1");
  EXPECT_EQ(word.value, "abc");
  EXPECT_EQ(faultOf("t,q_m1\n0,1e999\n").value, "1e999");
  EXPECT_EQ(faultOf("t,q_m1\n0,inf\n").value, "inf");
  EXPECT_EQ(faultOf("t,q_m1\n0,1.5x\n").value, "1.5x");
  const auto nan = faultOf("t,q_m1\n0,1\n1,nan\n");
  EXPECT_EQ(nan.line, 3);
  EXPECT_EQ(nan.key, "q_m1");
  EXPECT_EQ(nan.value, "nan");
  EXPECT_EQ(faultOf("t,q_m1\nNaN,1\n").key, "t");
  const auto back = faultOf("t,q_m1\n0,1\n0.002,1\n0.002,1\n");
  EXPECT_EQ(back.line, 4);
  EXPECT_EQ(back.key, "t");
  EXPECT_EQ(faultOf("t,q_m1\n0,1\n,1\n").line, 3);
  EXPECT_EQ(faultOf("t,q_m1\n0,1\n1,1,1\n").line, 3);
  EXPECT_EQ(faultOf("t,q_m1\n0,1\n1\n2,3\n").line, 3);
  EXPECT_EQ(faultOf("t,q_m1\n0,1\n\n2,3\n").line, 3);
}

TEST(MeasuredTable, HeadersThatCannotBe) {
  EXPECT_EQ(faultOf("q_m1\n1\n").key, "t");
  EXPECT_EQ(faultOf("").line, 1);
  EXPECT_EQ(faultOf("t,q_m1\n").line, 2);
  EXPECT_EQ(faultOf("t,q1,q1\n0,1,1\n").key, "q1");
  EXPECT_EQ(faultOf("t,q_m1,q_m3\n0,1,1\n").key, "q_m2");
  EXPECT_EQ(faultOf("t,q_m1,q_m2,q1\n0,1,1,1\n").key, "q2");
  EXPECT_EQ(faultOf("t,q_m8\n0,1\n").key, "q_m8");
  EXPECT_NE(faultOf("t;q_m1\n0;1\n").remedy.find("commas"), std::string::npos);
}

/// A misspelled column is named itself, with the one that is missing.
TEST(MeasuredTable, AMisspelledColumnIsNamed) {
  for (const auto& [header, unused, meant] : {std::tuple{"t,q_m1,qm2,q_m3", "qm2", "q_m2"},
                                              {"t,q_m1,Q_M2,q_m3", "Q_M2", "q_m2"},
                                              {"time,q_m1,q_m2,q_m3", "time", "t"},
                                              {"t,p_c1,p_c2,pc_3", "pc_3", "p_c3"}}) {
    const base::InputFault fault = faultOf(std::string(header) + "\n0,1,1,1\n");
    EXPECT_EQ(fault.key, unused) << header;
    EXPECT_NE(fault.remedy.find(std::string("Rename it to ") + meant), std::string::npos) << fault.remedy;
  }
  const base::InputFault nearest = faultOf("t,latency_time,q_d1,qm1,q_m2,q_m3\n0,1,1,1,1,1\n");
  EXPECT_EQ(nearest.key, "qm1");
  EXPECT_NE(nearest.reason.find("; not used: latency_time, q_d1"), std::string::npos) << nearest.reason;
  EXPECT_EQ(faultOf("stamp,latency_time,q_m1\n0,1,1\n").key, "stamp");
  EXPECT_NE(faultOf("t,q_m1,q_m2,q_m3,q1,q2,q4\n0,1,1,1,1,1,1\n").remedy.find("the number in q4"),
            std::string::npos);
  for (const char* words : {"arm1", "cam2", "p1", "i_m1", "q_d1", "x2", "1"})
    EXPECT_EQ(faultOf("t,q_m2," + std::string(words) + "\n0,1,1\n").key, "q_m1") << words;
  const base::InputFault other = faultOf("t,q_m1,q_m2,q_m4,current\n0,1,1,1,1\n");
  EXPECT_EQ(other.key, "q_m3");
  EXPECT_NE(other.reason.find("not used: current"), std::string::npos) << other.reason;
  EXPECT_NE(other.remedy.find("correct the number in q_m4"), std::string::npos) << other.remedy;
}

/// Columns of a stranger's table, or of one with hundreds of them, leave the message readable.
TEST(MeasuredTable, ManyAndLongColumnsAreNamedInShort) {
  std::string header = "t,q_m1,q_m3," + std::string(100000, 'x');
  for (int k = 0; k < 300; ++k) header += ",column" + std::to_string(k);
  std::string row = "0";
  for (auto commas = std::count(header.begin(), header.end(), ','); commas > 0; --commas) row += ",0";
  const base::InputFault fault = faultOf(header + "\n" + row + "\n");
  EXPECT_EQ(fault.key, "q_m2");
  EXPECT_LT(fault.reason.size(), 300U) << fault.reason;
  EXPECT_NE(fault.reason.find("and 293 more"), std::string::npos) << fault.reason;
}

TEST(TableSource, MisspelledColumnsAreNoticed) {
  const robot::Description raven = robot::readDescriptionOrDefault({});
  const auto faultOfTracking = [&](const char* text) {
    try {
      TableSource(parseMeasuredTable(text, "rows"), raven);
    } catch (const base::InputError& error) {
      return error.fault();
    }
    return base::InputFault{};
  };
  const base::InputFault fault = faultOfTracking("t,m1,m2,m3,q1,q2,q3\n0,1,2,3,4,5,6\n");
  EXPECT_EQ(fault.key, "m1");
  EXPECT_EQ(fault.remedy, "Rename it to q_m1, if that is what it holds");
  EXPECT_EQ(faultOfTracking("t,q_m1,q_m2,qm3\n0,1,2,3\n").key, "qm3") << "the last one, too";
  const TableSource source(parseMeasuredTable("t,q_m1,q_m2,q_m3,Q1,Q2,Q3,current\n0,1,2,3,4,5,6,7\n", "rows"),
                           raven);
  EXPECT_EQ(
      source.info().notices.back(),
      "rows: columns not used: Q1 (rename it, if it is q1), Q2 (rename it, if it is q2), Q3 (rename it, "
      "if it is q3), current");
}

TEST(TableSource, GivesMotorsReferenceAndTipsOfEachRow) {
  auto table = parseMeasuredTable(
      "t,q_m1,q_m2,q_m3,q1,q2,q3,p_c1,p_c2,p_c3\n0,1,2,3,4,5,6,7,8,9\n1,1,2,3,,,,,,\n2,,2,3,4,5,6,7,8,9\n"
      "3,,,,4,5,6,,,\n",
      "x.csv");
  TableSource source(table, raven());
  EXPECT_TRUE(source.info().reference);
  std::vector<std::pair<std::size_t, double>> kinds;
  for (tracking::Sample sample; source.next(sample);) {
    kinds.emplace_back(sample.index(), std::visit([](const auto& s) { return s.t; }, sample));
    if (kinds.size() == 5) source.block(true, false);
    if (const auto* motor = std::get_if<tracking::MotorSample>(&sample)) {
      EXPECT_EQ(std::isnan(motor->position(0)), motor->t == 2) << "an empty cell: no number of that motor";
      if (motor->t != 2) {
        EXPECT_EQ(motor->position(0), 1);
      }
      EXPECT_EQ(motor->position.tail<2>(), Eigen::Vector2d(2, 3));
      EXPECT_TRUE(motor->torque.array().isNaN().all());
    }
    if (const auto* tip = std::get_if<tracking::TipSample>(&sample)) {
      EXPECT_EQ(tip->t == 2, std::isnan(tip->position(0)));
    }
  }
  const std::vector<std::pair<std::size_t, double>> expected = {{0, 0}, {3, 0}, {2, 0}, {0, 1},
                                                                {0, 2}, {3, 2}, {2, 2}, {3, 3}};
  EXPECT_EQ(kinds, expected);
}

TEST(TableSource, RefusesOtherNumbersOfJointsAndTablesWithoutMotors) {
  EXPECT_THROW(TableSource(parseMeasuredTable("t,q_m1\n0,1\n", "x.csv"), raven()), base::InputError);
  EXPECT_THROW(TableSource(parseMeasuredTable("t,q1,q2,q3\n0,1,2,3\n", "x.csv"), raven()), base::InputError);
}

/// A table whose q follows from q_m by transmission kinematics, plus `stretch` [rad, rad, m] where joint 1
/// moves up.
MeasuredTable movingTable(double travel, const Eigen::Vector3d& stretch) {
  const robot::Transmission transmission(raven());
  MeasuredTable table;
  table.file = "x.csv";
  table.q_m.resize(3);
  table.q.resize(3);
  for (int row = 0; row < 100; ++row) {
    const Eigen::Vector3d q(0.6 + travel * std::sin(0.1 * row), 1.4, 0.3);
    const Eigen::Vector3d q_m = transmission.motorFromJoint(q);
    table.t.push_back(1e-3 * row);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto joint = static_cast<Eigen::Index>(i);
      table.q_m[i].push_back(q_m(joint));
      table.q[i].push_back(q(joint) + (std::cos(0.1 * row) > 0.0 ? stretch(joint) : 0.0));
    }
  }
  table.q[1][7] = std::nan("");
  return table;
}

TEST(TableSource, JointsThatFollowFromTheMotorsAreTheRobotsOwnKinematics) {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  const TableSource own(movingTable(0.3, none), raven());
  EXPECT_TRUE(own.info().own_kinematics);
  EXPECT_NE(own.info().notices.back().find("own kinematics, no truth"), std::string::npos);
  EXPECT_TRUE(isOwnKinematics(movingTable(0.3, Eigen::Vector3d(1e-5, 1e-5, 1e-6)), raven())) << "rounding";
  EXPECT_FALSE(isOwnKinematics(movingTable(0.3, Eigen::Vector3d(1e-4, 0, 0)), raven())) << "0.006 deg";
  EXPECT_FALSE(isOwnKinematics(movingTable(0.3, Eigen::Vector3d(0, 0, 5e-6)), raven())) << "0.005 mm";
  EXPECT_FALSE(isOwnKinematics(movingTable(0.0, none), raven())) << "at rest nothing is known";
  robot::Description other = raven();
  other.drives[0].link_radius *= 0.99;
  EXPECT_FALSE(TableSource(movingTable(0.3, none), other).info().own_kinematics);
}

TEST(MeasuredTable, ReadsTheSharedRecordings) {
  const auto plant = dataFile("plant/rec101.csv");
  if (plant.empty()) GTEST_SKIP() << "no data sets (CAPSTAN_DATA)";
  const auto table = readMeasuredTable(plant);
  EXPECT_EQ(table.rows(), 40001U);
  EXPECT_EQ(table.joints(), 3);
  EXPECT_EQ(table.q_m[2][1], -482.209340);
  EXPECT_TRUE(implausibleUnits(table, raven()).empty());
  EXPECT_EQ(readMeasuredTable(dataFile("davinci-jaw/tool4_left_0.1Hz_load0.csv")).joints(), 1);
  EXPECT_EQ(readMeasuredTable(dataFile("emps/test.csv")).ignored, (std::vector<std::string>{"q_ref1"}));
}

/// Half a unit of the last of the six digits that the file was written with.
double halfDigit(double written) {
  return written == 0.0 ? 0.0 : 0.5 * std::pow(10.0, std::floor(std::log10(std::abs(written))) - 5.0);
}

// Insertion is published as metres × 57.3 with six digits: up to 0.87e-3 mm of rounding in the joint, 0.40e-3
// mm in its motor, 0.06e-3 mm through the coupling. No transmission can come nearer than these bounds, row by
// row.
TEST(RavenMotors, TransmissionKinematicsIsTheRobotsOwnUpToItsDigits) {
  const auto file = dataFile("raven2-motors/joints123.csv");
  if (file.empty()) GTEST_SKIP() << "no data sets (CAPSTAN_DATA)";
  const auto table = readRavenMotors(file, raven());
  ASSERT_EQ(table.rows(), 19415U);
  EXPECT_TRUE(implausibleUnits(table, raven()).empty());
  const robot::Transmission transmission(raven());
  Eigen::Vector3d worst = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const Eigen::Vector3d q_m(table.q_m[0][row], table.q_m[1][row], table.q_m[2][row]);
    const Eigen::Vector3d q(table.q[0][row], table.q[1][row], table.q[2][row]);
    const Eigen::Vector3d error = (transmission.jointFromMotor(q_m) - q).cwiseAbs();
    worst = worst.cwiseMax(error);
    squares += error.cwiseAbs2();
    const double written = base::toDegrees(q(2)), motor = written * 2158.59 + 6000.0;
    const double digits = base::toRadians(halfDigit(written) + halfDigit(motor) / 2158.59) + 6e-8;
    ASSERT_LE(error(2), digits) << "row " << row;
  }
  const Eigen::Vector3d rms = (squares / static_cast<double>(table.rows())).cwiseSqrt();
  std::printf(
      "transmission kinematics against the robot's own: worst %.2e deg, %.2e deg, %.2e mm; RMS %.2e mm\n",
      base::toDegrees(worst(0)), base::toDegrees(worst(1)), base::toMillimetres(worst(2)),
      base::toMillimetres(rms(2)));
  EXPECT_LE(base::toDegrees(worst(0)), 1e-3);
  EXPECT_LE(base::toDegrees(worst(1)), 1e-3);
  EXPECT_LE(base::toMillimetres(rms(2)), 1e-3);
}

TEST(RavenMotors, ARobotFileWithAnotherRadiusShowsInTheResult) {
  const auto file = dataFile("raven2-motors/joints123.csv");
  if (file.empty()) GTEST_SKIP() << "no data sets (CAPSTAN_DATA)";
  robot::Description thin = raven();
  thin.drives[0].link_radius = 59e-3;
  const auto nominal = readRavenMotors(file, raven()), other = readRavenMotors(file, thin);
  EXPECT_EQ(nominal.q_m, other.q_m);
}

TEST(Occlusion, BlocksThePercentageInEqualIntervals) {
  for (const double percentage : {10.0, 20.0, 40.0, 60.0, 80.0}) {
    const live::OcclusionSchedule schedule{percentage, 2.0, 0.0};
    int blocked = 0, begins = 0;
    double last = -1.0;
    for (int i = 0; i < 200000; ++i) {
      const bool now = schedule.blockedAt((i + 0.5) * 1e-3),
                 before = i > 0 && schedule.blockedAt((i - 0.5) * 1e-3);
      blocked += now;
      if (now && !before) {
        if (last >= 0.0) {
          EXPECT_NEAR(i * 1e-3 - last, 200.0 / percentage, 2e-3);
        }
        last = i * 1e-3;
        ++begins;
      }
    }
    EXPECT_NEAR(blocked / 2000.0, percentage, 0.01);
    EXPECT_EQ(begins, static_cast<int>(percentage));
    EXPECT_NEAR(schedule.shareUntil(200.0), percentage / 100.0, 1e-12);
  }
  EXPECT_FALSE(live::OcclusionSchedule{}.blockedAt(5.0));
}

}  // namespace
}  // namespace capstan::recording
