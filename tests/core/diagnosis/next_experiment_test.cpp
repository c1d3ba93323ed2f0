// The proposed experiment: a motion that the robot can make, and that shows the difference between the
// candidates.
#include "core/diagnosis/experiment_design/next_experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/yaml.h"
#include "core/diagnosis/experiment_design/test_motion.h"
#include "core/diagnosis/hypotheses/joint_scales.h"
#include "core/simulation/trajectory.h"
#include "tests/core/diagnosis/planted_evidence.h"

namespace capstan::diagnosis {
namespace {

constexpr double kStep = 1e-3;

TEST(TestMotions, StayInsideLimitsAndSpeeds) {
  const Planted planted(1);
  const std::vector<TestMotion> motions = testMotions(planted.robot, planted.evidence, kStep);
  EXPECT_EQ(motions.size(), 4U * 3U + 2U);
  for (const TestMotion& motion : motions)
    for (std::size_t k = 0; k < motion.q.size(); ++k)
      for (int j = 0; j < 3; ++j) {
        const robot::Joint& joint = planted.robot.joints[static_cast<std::size_t>(j)];
        ASSERT_GT(motion.q[k][j], joint.limit_low) << motion.title;
        ASSERT_LT(motion.q[k][j], joint.limit_high) << motion.title;
        ASSERT_LE(std::abs(motion.dq[k][j]), 0.5 * joint.max_speed * 1.001) << motion.title;
      }
}

TEST(TestMotions, BeginAndEndAtRestInOnePose) {
  const Planted planted(1);
  const std::vector<TestMotion> motions = testMotions(planted.robot, planted.evidence, kStep);
  for (const TestMotion& motion : motions) {
    EXPECT_LT((motion.q.front() - motions.front().q.front()).norm(), 1e-9) << motion.title;
    EXPECT_LT((motion.q.back() - motion.q.front()).norm(), 1e-9) << motion.title;
    EXPECT_LT(motion.dq.front().norm() + motion.dq.back().norm(), 1e-9) << motion.title;
    EXPECT_GT(motion.duration(), 0.5 * kTestDuration) << motion.title;
    EXPECT_LT(motion.duration(), 2.0 * kTestDuration) << motion.title;
  }
}

TEST(TestMotions, HaveTheVelocityOfTheirPositions) {
  const Planted planted(1);
  for (const TestMotion& motion : testMotions(planted.robot, planted.evidence, kStep))
    for (std::size_t k = 1; k + 1 < motion.q.size(); k += 7) {
      const robot::JointVector slope = (motion.q[k + 1] - motion.q[k - 1]) / (2.0 * kStep);
      ASSERT_LT((slope - motion.dq[k]).norm(), 0.02) << motion.title << " at row " << k;
    }
}

/// A selection between the refitted nominal robot and the same with one effect, equally probable.
class Undecided {
 public:
  Undecided(const Planted& planted, const char* effect, int joint, const EffectStart& start)
      : data_(planted.evidence, planted.robot, 0.0, EncoderZeros::kKnown, 2) {
    const FitModel nominal(planted.robot, jointScales(planted.evidence, planted.robot));
    const SetFit without = SetFitter(data_).nominal(nominal, Eigen::VectorXd::Zero(nominal.size()));
    const Hypothesis& hypothesis = *hypothesisNamed(effect);
    const FitModel model = nominal.with(hypothesis, joint, start);
    SetFit with{{{&hypothesis, joint}},
                linearise(data_, model, model.startFrom(nominal, without.fit.u), noneBeyond(data_),
                          without.weighting),
                without.weighting,
                without.fitted,
                without.squares,
                true};
    selection_.emplace(Selection{.base = without.fit,
                                 .base_squares = without.squares,
                                 .input_noise = {},
                                 .torque_noise = {},
                                 .best = without.fit,
                                 .best_squares = without.squares,
                                 .weighting = without.weighting,
                                 .effects = {},
                                 .uncertain = {},
                                 .competitors = {},
                                 .posterior = {},
                                 .probable = {{with, 0.5}, {without, 0.5}},
                                 .candidates = {}});
  }

  std::optional<NextExperiment> next(const Planted& planted) const {
    return nextExperiment(data_, planted.evidence, *selection_, planted.robot, EncoderZeros::kKnown, 2);
  }

 private:
  FitData data_;
  std::optional<Selection> selection_;
};

double rangeOf(const std::vector<double>& q) {
  const auto [low, high] = std::ranges::minmax_element(q);
  return *high - *low;
}

TEST(NextExperiment, MovesTheJointWhoseModelIsInQuestion) {
  const Planted planted(1);
  for (const int joint : {1, 3}) {
    const double half_width = joint == 3 ? 5e-4 : 5e-3;
    const Undecided undecided(planted, "backlash", joint, {{half_width, 1.0}, {half_width, 0.0}});
    const auto next = undecided.next(planted);
    ASSERT_TRUE(next) << joint;
    EXPECT_NEAR(next->confusion_now, 0.5, 1e-9);
    EXPECT_LT(next->confusion_after, 0.05) << joint << ": " << next->motion;
    EXPECT_GT(rangeOf(next->q[static_cast<std::size_t>(joint - 1)]), 0.01) << joint << ": " << next->motion;
    ASSERT_EQ(next->distinguishes.size(), 1U);
    EXPECT_EQ(next->distinguishes.front().effect, "backlash");
    EXPECT_NE(sentenceOf(*next).find(next->motion), std::string::npos);
  }
}

/// A slip of the encoder in the recording does not happen again in the next one.
TEST(NextExperiment, CannotRepeatWhatHappenedOnce) {
  const Planted planted(1);
  const Undecided undecided(planted, "encoder_slip", 2, {{0.05, 6.0}, {0.05, 0.0}});
  const auto next = undecided.next(planted);
  ASSERT_TRUE(next);
  EXPECT_NEAR(next->confusion_after, next->confusion_now, 1e-3);
  EXPECT_NE(sentenceOf(*next).find("No motion"), std::string::npos);
}

TEST(NextExperiment, IsATrajectoryThatTheSimulatorTakes) {
  const Planted planted(1);
  const Undecided undecided(planted, "backlash", 2, {{5e-3, 1.0}, {5e-3, 0.0}});
  const auto next = undecided.next(planted);
  ASSERT_TRUE(next);
  const std::string file = (std::filesystem::path(testing::TempDir()) / "next-experiment.csv").string();
  base::writeTextFile(file, trajectoryText(*next));
  simulation::TrajectorySpec spec;
  spec.kind = simulation::TrajectoryKind::kRecorded;
  spec.recorded.file = file;
  const auto trajectory = simulation::makeTrajectory(spec, planted.robot, 1);
  EXPECT_NEAR(trajectory->duration(), next->t.back(), 1e-6);
  EXPECT_NEAR(trajectory->at(0.5 * next->t.back()).position[1], next->q[1][next->q[1].size() / 2], 1e-3);
}

}  // namespace
}  // namespace capstan::diagnosis
