// Tips that cameras saw: their place among the rows, their noise, their outliers.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "core/robot/kinematics.h"
#include "core/robot/transmission.h"
#include "tests/core/diagnosis/data_folder.h"

namespace capstan::diagnosis {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Eigen::Vector3d jointsAt(double t) {
  return {0.6 + 0.4 * std::sin(2.0 * t), 1.6 + 0.3 * std::sin(3.1 * t), 0.4 + 0.05 * std::sin(4.3 * t)};
}

/// RAVEN-II for twenty seconds; a tip every 66 rows, `latency` late, with noise of 0.3, 0.3 and 1.5 mm.
recording::MeasuredTable armTable(bool encoders, double latency) {
  const robot::Description robot = raven();
  const robot::Transmission transmission(robot);
  const robot::Chain chain(robot);
  base::Random random(3, "tips");
  recording::MeasuredTable table;
  table.file = "arm.csv";
  table.q_m = table.p_c = Columns(3);
  if (encoders) table.q = Columns(3);
  for (int i = 0; i < 20000; ++i) {
    const double t = 1e-3 * i;
    table.t.push_back(t);
    const robot::JointVector q_m = transmission.motorFromJoint(jointsAt(t));
    const Eigen::Vector3d seen =
        chain.marker(jointsAt(t - latency)) +
        Eigen::Vector3d(random.normal(0.0, 3e-4), random.normal(0.0, 3e-4), random.normal(0.0, 1.5e-3));
    for (Eigen::Index j = 0; j < 3; ++j) {
      const auto column = static_cast<std::size_t>(j);
      table.q_m[column].push_back(q_m(j));
      if (encoders) table.q[column].push_back(jointsAt(t)(j));
      table.p_c[column].push_back(i % 66 == 7 ? seen(j) : kNaN);
    }
  }
  return table;
}

class Observations : public ::testing::TestWithParam<bool> {};

TEST_P(Observations, KeepTheirInstantsAndShowTheirNoise) {
  const Evidence evidence = evidenceOf(armTable(GetParam(), 0.0), raven());
  ASSERT_EQ(evidence.tip.size(), 303U);
  EXPECT_EQ(evidence.tip[2].row, 139.0);
  EXPECT_NEAR(evidence.tip[2].t, 0.139, 1e-12);
  EXPECT_EQ(evidence.countingObservations(), 303U);
  EXPECT_NEAR(evidence.noise.tip[0].sigma, 3e-4, 4e-5);
  EXPECT_NEAR(evidence.noise.tip[1].sigma, 3e-4, 4e-5);
  EXPECT_NEAR(evidence.noise.tip[2].sigma, 1.5e-3, 2e-4);
}

/// A late camera is a cause to be found, no heap of outliers and no noise.
TEST_P(Observations, OfALateCameraCount) {
  const Evidence evidence = evidenceOf(armTable(GetParam(), 0.05), raven());
  EXPECT_EQ(evidence.countingObservations(), 303U);
  EXPECT_NEAR(evidence.noise.tip[0].sigma, 3e-4, 8e-5);
}

TEST_P(Observations, FarFromTheirNeighboursDoNotCount) {
  recording::MeasuredTable table = armTable(GetParam(), 0.0);
  table.p_c[1][7 + 66 * 40] += 0.02;
  table.p_c[2][7 + 66 * 100] -= 0.05;
  const Evidence evidence = evidenceOf(table, raven());
  EXPECT_EQ(evidence.countingObservations(), 301U);
  EXPECT_FALSE(evidence.tip[40].counts);
  EXPECT_FALSE(evidence.tip[100].counts);
  ASSERT_EQ(evidence.notices.size(), 1U);
  EXPECT_NE(evidence.notices[0].find("2 of 303 tip observations"), std::string::npos) << evidence.notices[0];
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutEncoders, Observations, ::testing::Bool());

}  // namespace
}  // namespace capstan::diagnosis
