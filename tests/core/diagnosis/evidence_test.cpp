// What a measured table becomes: grid, gaps, sensors, noise, refusals.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "core/diagnosis/evidence/recorded_tracks.h"
#include "tests/core/diagnosis/data_folder.h"

namespace capstan::diagnosis {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double motorAt(double t) { return 20.0 * std::sin(2.0 * t); }
double jointAt(double t) { return 0.4 * std::sin(2.0 * t - 0.05); }

/// One joint for `seconds` at 1 kHz.
recording::MeasuredTable jointTable(double seconds = 2.0) {
  recording::MeasuredTable table;
  table.file = "joint.csv";
  table.q_m = table.dq_m = table.tau_m = table.q = Columns(1);
  for (int i = 0; 1e-3 * i <= seconds; ++i) {
    const double t = 3.0 + 1e-3 * i;
    table.t.push_back(t);
    table.q_m[0].push_back(motorAt(t));
    table.dq_m[0].push_back(40.0 * std::cos(2.0 * t));
    table.tau_m[0].push_back(0.01 * i);
    table.q[0].push_back(jointAt(t));
  }
  return table;
}

void eraseRows(recording::MeasuredTable& table, std::size_t begin, std::size_t end) {
  const auto cut = [&](std::vector<double>& x) {
    x.erase(x.begin() + static_cast<std::ptrdiff_t>(begin), x.begin() + static_cast<std::ptrdiff_t>(end));
  };
  cut(table.t);
  for (Columns* columns : {&table.q_m, &table.dq_m, &table.tau_m, &table.q})
    if (!columns->empty()) cut((*columns)[0]);
}

TEST(Evidence, LoadsThatWereNotReadDoNotCount) {
  recording::MeasuredTable table = jointTable();
  table.tau_ext = {std::vector<double>(table.rows(), 0.5)};
  for (std::size_t i = 0; i < 5; ++i) table.tau_ext[0][i] = kNaN;
  const Evidence evidence = evidenceOf(table, slide());
  for (std::size_t i = 0; i < evidence.rows(); ++i) {
    ASSERT_EQ(evidence.tau_ext[0][i], 0.5) << i;
    ASSERT_EQ(evidence.counts(i), i >= 5) << i;
  }
}

TEST(Evidence, AnEvenTableKeepsItsNumbers) {
  const recording::MeasuredTable table = jointTable();
  const Evidence evidence = evidenceOf(table, slide());
  ASSERT_EQ(evidence.rows(), table.rows());
  EXPECT_NEAR(evidence.step, 1e-3, 1e-12);
  EXPECT_EQ(evidence.q_m, table.q_m);
  EXPECT_EQ(evidence.dq_m, table.dq_m);
  EXPECT_EQ(evidence.tau_m, table.tau_m);
  EXPECT_EQ(evidence.q, table.q);
  EXPECT_TRUE(evidence.tau_ext.empty());
  EXPECT_EQ(evidence.countingRows(), evidence.rows());
  EXPECT_NEAR(evidence.duration(), 2.0, 1e-9);
  EXPECT_EQ(evidence.title, "joint.csv");
}

TEST(Evidence, AnUnevenClockIsInterpolated) {
  recording::MeasuredTable table = jointTable();
  base::Random random(2);
  for (std::size_t i = 1; i < table.rows(); ++i) {
    table.t[i] += random.uniform(-3e-4, 3e-4);
    table.q_m[0][i] = motorAt(table.t[i]);
    table.q[0][i] = jointAt(table.t[i]);
  }
  const Evidence evidence = evidenceOf(table, slide());
  EXPECT_EQ(evidence.countingRows(), evidence.rows());
  std::size_t read = 0;
  for (std::size_t i = 0; i < evidence.rows(); ++i) {
    EXPECT_NEAR(evidence.q_m[0][i], motorAt(evidence.t[i]), 4e-5);  // dq_m times a thousandth of a period
    if (std::isnan(evidence.q[0][i])) continue;
    ++read;
    EXPECT_NEAR(evidence.q[0][i], jointAt(evidence.t[i]), 1e-6);
  }
  EXPECT_GT(read, evidence.rows() * 7 / 10);
}

TEST(Evidence, ShortGapsAreBridgedAndLongOnesPart) {
  recording::MeasuredTable table = jointTable(3.0);
  eraseRows(table, 2000, 2400);
  eraseRows(table, 500, 520);
  const Evidence evidence = evidenceOf(table, slide());
  ASSERT_EQ(evidence.segments.size(), 2U);
  EXPECT_EQ(evidence.segments[0].size(), 2000U);
  EXPECT_NEAR(evidence.t[evidence.segments[1].begin], 5.4, 1e-9);
  EXPECT_EQ(evidence.rows() - evidence.countingRows(), 20U);
  EXPECT_EQ(evidence.exclusions[510], kGap);
  EXPECT_NEAR(evidence.q_m[0][510], motorAt(3.51), 5e-3);
  EXPECT_TRUE(std::isnan(evidence.q[0][510]));
  EXPECT_EQ(evidence.notices.size(), 2U) << fmt::format("{}", fmt::join(evidence.notices, "; "));
}

TEST(Evidence, AnEncoderReadNowAndThenStaysSparse) {
  recording::MeasuredTable table = jointTable();
  for (std::size_t i = 0; i < table.rows(); ++i)
    if (i % 5 != 2) table.q[0][i] = kNaN;
  const Evidence evidence = evidenceOf(table, slide());
  for (std::size_t i = 0; i < evidence.rows(); ++i) EXPECT_EQ(std::isnan(evidence.q[0][i]), i % 5 != 2);
  EXPECT_GT(evidence.noise.q[0].floor() + 1e-15, 0.0);
}

TEST(Evidence, VelocityIsDifferentiatedWhereNoneWasMeasured) {
  recording::MeasuredTable table = jointTable();
  table.dq_m.clear();
  const Evidence whole = evidenceOf(table, slide());
  for (std::size_t i = 0; i < whole.rows(); ++i)
    EXPECT_NEAR(whole.dq_m[0][i], 40.0 * std::cos(2.0 * whole.t[i]), 2e-3);
  table = jointTable();
  for (std::size_t i = 300; i < 400; ++i) table.dq_m[0][i] = kNaN;
  const Evidence partly = evidenceOf(table, slide());
  EXPECT_EQ(partly.dq_m[0][299], table.dq_m[0][299]);
  EXPECT_NEAR(partly.dq_m[0][350], 40.0 * std::cos(2.0 * partly.t[350]), 2e-3);
}

TEST(Evidence, TheStartMayBeSkipped) {
  const Evidence evidence = evidenceOf(jointTable(), slide(), {.skip_start = 0.5});
  EXPECT_EQ(evidence.countingRows(), evidence.rows() - 500);
  EXPECT_EQ(evidence.exclusions[0], kStart);
  EXPECT_TRUE(evidence.counts(500));
}

TEST(Evidence, AnEncoderAtItsEndIsNoReading) {
  recording::MeasuredTable table = jointTable(4.0);
  std::size_t cut = 0;
  for (double& q : table.q[0])
    if (q > 0.3) q = 0.3, ++cut;
  const Evidence evidence = evidenceOf(table, slide());
  const auto lost = static_cast<std::size_t>(
      std::count_if(evidence.q[0].begin(), evidence.q[0].end(), [](double x) { return std::isnan(x); }));
  EXPECT_EQ(lost, cut);
  EXPECT_EQ(evidence.countingRows(), evidence.rows());
}

/// A motion that stops at its farthest point and rests there is none.
TEST(Evidence, RestAtTheFarthestPointCounts) {
  recording::MeasuredTable table = jointTable(4.0);
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double t = std::min(1e-3 * static_cast<double>(i), 2.0), s = t / 2.0;
    const double path = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
    table.q_m[0][i] = 1.5e-3 * std::round(30.0 * path / 1.5e-3);
    table.q[0][i] = 1e-5 * std::round(0.4 * path / 1e-5);
  }
  const Evidence evidence = evidenceOf(table, slide());
  EXPECT_EQ(evidence.countingRows(), evidence.rows());
  EXPECT_EQ(std::count_if(evidence.q[0].begin(), evidence.q[0].end(), [](double x) { return std::isnan(x); }),
            0);
}

robot::Description rigidSlide(double force_limit) {
  robot::Description robot = slide(force_limit);
  robot.drive = DriveKind::kRigid;
  return robot;
}

TEST(Evidence, ATorqueBeyondTheMotorDoesNotCount) {
  const Evidence evidence = evidenceOf(jointTable(), rigidSlide(15.0));
  EXPECT_EQ(evidence.countingRows(), 1501U);
  EXPECT_EQ(evidence.exclusions[1700], kSaturated);
}

base::InputFault faultOf(const recording::MeasuredTable& table, const robot::Description& robot,
                         const EvidenceOptions& options = {}) {
  try {
    evidenceOf(table, robot, options);
  } catch (const base::InputError& error) {
    return error.fault();
  }
  ADD_FAILURE() << "accepted";
  return {};
}

TEST(Evidence, WhatTheRobotComputedIsNoReference) {
  recording::MeasuredTable table = jointTable();
  table.own_kinematics = true;
  const base::InputFault fault = faultOf(table, slide());
  EXPECT_EQ(fault.key, "q1, p_c1");
  EXPECT_NE(fault.reason.find("computed from its motors"), std::string::npos) << fault.reason;
}

TEST(Evidence, RefusesByNameWithARemedy) {
  recording::MeasuredTable table = jointTable();
  table.q.clear();
  base::InputFault fault = faultOf(table, slide());
  EXPECT_EQ(fault.file, "joint.csv");
  EXPECT_EQ(fault.key, "q1, p_c1");
  EXPECT_NE(fault.reason.find("neither joint encoders nor cameras"), std::string::npos);

  table = jointTable();
  table.q_m.clear();
  EXPECT_EQ(faultOf(table, slide()).key, "q_m1");
  EXPECT_NO_THROW(evidenceOf(table, rigidSlide(1e4)));
  table.tau_m.clear();
  EXPECT_EQ(faultOf(table, rigidSlide(1e4)).key, "tau_m1");

  fault = faultOf(jointTable(), raven());
  EXPECT_EQ(fault.key, "q_m1");
  EXPECT_NE(fault.reason.find("3 joints"), std::string::npos) << fault.reason;

  fault = faultOf(jointTable(0.05), slide());
  EXPECT_EQ(fault.key, "t");
  EXPECT_NE(fault.reason.find("100"), std::string::npos) << fault.reason;
  EXPECT_EQ(faultOf(jointTable(), slide(), {.skip_start = 1.9505}).value, "50 rows");

  table = jointTable();
  std::fill(table.q[0].begin() + 50, table.q[0].end(), kNaN);
  EXPECT_EQ(faultOf(table, slide()).key, "q1");
}

}  // namespace
}  // namespace capstan::diagnosis
