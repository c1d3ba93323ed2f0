// Evidence of measured tables of real robots, where they are on this machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/diagnosis/evidence/read_evidence.h"
#include "core/robot/kinematics.h"
#include "tests/core/diagnosis/data_folder.h"
#include "tests/support/folders.h"

namespace capstan::diagnosis {
namespace {

TEST(MeasuredEvidence, SlideOfThePublicBenchmark) {
  const std::filesystem::path file = dataFolder() / "emps" / "train.csv";
  REQUIRE_DATA(file);
  robot::Description rigid = slide(1e3);
  rigid.drive = DriveKind::kRigid;
  const Evidence evidence = readEvidence(file, rigid);
  EXPECT_EQ(evidence.rows(), 24841U);
  EXPECT_EQ(evidence.countingRows(), evidence.rows());
  EXPECT_NEAR(evidence.step, 1e-3, 1e-12);
  EXPECT_TRUE(evidence.q_m.empty());
  EXPECT_EQ(evidence.tau_m.size(), 1U);
  // The record is the benchmark's own, filtered; what is left of noise is far below a hundredth of a
  // millimetre, and its force has newtons of it.
  EXPECT_LT(evidence.noise.q[0].floor(), 1e-5);
  EXPECT_GT(evidence.noise.tau_m[0].floor(), 1e-4);
}

TEST(MeasuredEvidence, JawOfAnInstrument) {
  const std::filesystem::path file = dataFolder() / "davinci-jaw" / "tool4_left_0.3Hz_load4.csv";
  REQUIRE_DATA(file);
  EvidenceOptions options;
  options.skip_start = 1.0;
  const Evidence evidence = readEvidence(file, jaw(), options);
  EXPECT_NEAR(evidence.step, 4e-3, 1e-6);
  EXPECT_GT(evidence.duration(), 19.0);
  EXPECT_GT(evidence.countingRows(), evidence.rows() * 9 / 10 - 1);
  EXPECT_EQ(evidence.tau_ext.size(), 1U);
  EXPECT_EQ(evidence.dq_m.size(), 1U) << "velocity of the spindle by differentiation";
  // The jaw's encoder has 4000 counts: 2π/4000 in every change of the table.
  EXPECT_NEAR(evidence.noise.q[0].step, std::numbers::pi / 2000.0, 5e-6);
}

TEST(MeasuredEvidence, SimulatedArmsOfOthers) {
  const std::filesystem::path file = dataFolder() / "plant" / "rec101.csv";
  REQUIRE_DATA(file);
  const robot::Description robot = raven();
  const Evidence evidence = readEvidence(file, robot);
  EXPECT_EQ(evidence.rows(), 40001U);
  EXPECT_EQ(evidence.countingRows(), evidence.rows());
  for (const ChannelNoise& noise : evidence.noise.q_m)
    EXPECT_NEAR(noise.step, 2.0 * std::numbers::pi / robot.drives[0].encoder_counts, 1e-6);
  EXPECT_GT(evidence.tip.size(), 500U);
  EXPECT_GE(evidence.countingObservations() * 100, evidence.tip.size() * 98);
  const robot::Chain chain(robot);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_GT(evidence.noise.tip[axis].sigma, 5e-6);
    EXPECT_LT(evidence.noise.tip[axis].sigma, 2e-3);
  }
  for (const TipObservation& observation : evidence.tip) {
    robot::JointVector q(3);
    for (Eigen::Index j = 0; j < 3; ++j)
      q(j) = Evidence::at(evidence.q[static_cast<std::size_t>(j)], observation.row);
    EXPECT_LT((chain.marker(q) - observation.position).norm(), 0.03) << "at " << observation.t;
  }
}

}  // namespace
}  // namespace capstan::diagnosis
