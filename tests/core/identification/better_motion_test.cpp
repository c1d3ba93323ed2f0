// A better motion is proposed where a parameter is weak, and brings what it predicts.
#include "core/identification/better_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/identification/batch.h"
#include "core/identification/model_error.h"
#include "core/simulation/trajectory.h"
#include "tests/core/identification/matched_recording.h"

namespace capstan::identification {
namespace {

using test::matchedRecording;
using test::softRaven;
using ::testing::HasSubstr;

/// Estimates as before any recording: everything has its prior's sigma.
std::vector<Estimate> unknown(const ParameterSet& set) {
  std::vector<Estimate> estimates;
  for (const Parameter& parameter : set.all())
    estimates.push_back({parameter, 0.0, parameter.prior_sigma, false, {}});
  return estimates;
}

/// What an arm that is the filter's model would record of `motion`.
IdentificationData driven(const SinusoidMotion& motion, const robot::Description& truth,
                          const robot::Description& nominal) {
  return matchedRecording(
      truth, nominal, {.duration = motion.duration, .motion = [motion](double t) { return motion.at(t); }});
}

TEST(BetterMotion, CandidatesKeepTheLimitsOfTheSimulatedRobot) {
  const auto robot = softRaven();
  const auto motions = candidateMotions(robot);
  ASSERT_GE(motions.size(), 6U);
  for (const SinusoidMotion& motion : motions) {
    simulation::TrajectorySpec spec;
    spec.kind = simulation::TrajectoryKind::kSinusoid;
    spec.duration = motion.duration;
    spec.sinusoid = {motion.centre, motion.amplitude, motion.frequency};
    const auto trajectory = simulation::makeTrajectory(spec, robot, 1);  // throws beyond a limit or a speed
    for (double t = 0.0; t <= motion.duration; t += 0.37)
      EXPECT_LT((trajectory->at(t).position - motion.at(t)).cwiseAbs().maxCoeff(), 0.02) << t;
    EXPECT_GT(motion.amplitude(0), 0.02);
  }
}

TEST(BetterMotion, OfAnArmAtRestMakesEveryWeakParameterKnownAsPredicted) {
  const auto robot = softRaven();
  const ParameterSet set(robot, "r_l,k_e2,k_e3,b_e2,b_e3");
  const auto still = matchedRecording(robot, robot, {.duration = 40.0, .moves = false});
  base::Progress progress;
  const auto proposal = proposeMotion(still, set, unknown(set), {}, progress);
  ASSERT_TRUE(proposal);
  EXPECT_EQ(proposal->weak.size(), static_cast<std::size_t>(set.size()));
  EXPECT_THAT(proposal->words, HasSubstr("predicted change of σ is: r_l1"));
  for (std::size_t i = 0; i < proposal->now.size(); ++i) EXPECT_LT(proposal->then[i], proposal->now[i]);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(proposal->then[i], 0.5 * proposal->now[i]) << "a radius";

  // The same motion driven by an arm with other constants: the batch method's σ is what was predicted.
  auto truth = robot;
  truth.drives[1].cable_damping *= 1.3;
  truth.drives[0].link_radius *= 1.01;
  const auto moved = driven(proposal->motion, truth, robot);
  const BatchReport found = identifyBatch(moved, set, {});
  ASSERT_EQ(found.end, BatchEnd::kConverged);
  for (int i = 0; i < set.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_LT(found.estimates[at].sigma, 2.0 * proposal->then[at]) << set[i].name();
    EXPECT_GT(found.estimates[at].sigma, proposal->then[at] / 2.0) << set[i].name();
  }
}

TEST(BetterMotion, NothingIsProposedWhereNothingIsWeak) {
  const auto robot = softRaven();
  const ParameterSet set(robot, "r_l1");
  auto estimates = unknown(set);
  estimates[0].seen = true;
  estimates[0].sigma = 0.5 * set[0].goal;
  base::Progress progress;
  EXPECT_FALSE(
      proposeMotion(matchedRecording(robot, robot, {.duration = 20.0}), set, estimates, {}, progress));
  EXPECT_TRUE(weakOf(estimates).empty());
  estimates[0].sigma = 2.0 * set[0].goal;
  EXPECT_EQ(weakOf(estimates), std::vector<int>{0}) << "seen, but not to its goal";
  progress.cancel();
  EXPECT_FALSE(
      proposeMotion(matchedRecording(robot, robot, {.duration = 20.0}), set, estimates, {}, progress));
}

/// The noise of the cameras is all that remains with the true parameters.
TEST(ModelError, FallsToTheNoiseOfTheCameras) {
  const auto nominal = softRaven();
  auto truth = nominal;
  truth.drives[0].link_radius *= 0.95;
  const ParameterSet set(nominal, "r_l1,b_e2");
  const auto data = matchedRecording(truth, nominal, {.duration = 30.0});
  std::vector<Estimate> estimates = unknown(set);
  estimates[0].log = std::log(0.95);
  estimates[0].seen = true;
  estimates[1].log = 1.0;  // not seen: it must not be used
  const auto error = modelErrorOf(data, set, estimates);
  ASSERT_TRUE(error);
  EXPECT_GT(error->observations, 300);
  double noise = 0.0;
  for (const auto& seen : data.cameras)
    noise += seen.q_covariance(0, 0) / static_cast<double>(data.cameras.size());
  EXPECT_NEAR(error->after(0), std::sqrt(noise), 0.1 * std::sqrt(noise));
  // Joint 1 is at 0.6 ± 0.5 rad from homing 0 by the nominal radius; 1 / 0.95 of that in truth.
  EXPECT_NEAR(error->before(0), (1.0 / 0.95 - 1.0) * std::sqrt(0.6 * 0.6 + 0.125), 0.2 * error->before(0));
  EXPECT_LT(error->after(1), error->before(1)) << "joint 2 is coupled to joint 1";
}

TEST(RobotChange, HasTheNameOfItsParameter) {
  EXPECT_EQ((RobotChange{"drives[0].link_radius", 1, 2, 0}.name()), "r_l1");
  EXPECT_EQ((RobotChange{"drives[2].cable_stiffness", 1, 2, 0}.name()), "k_e3");
  EXPECT_EQ((RobotChange{"drives[1].cable_damping", 1, 2, 0}.name()), "b_e2");
  EXPECT_EQ((RobotChange{"joints[1].friction.coulomb", 1, 2, 0}.name()), "f_c2");
  EXPECT_EQ((RobotChange{"drives[1].motor_inertia", 1, 2, 0}.name()), "");
  EXPECT_EQ((RobotChange{"drives[0].link_radius", 1, 2, 0}.parameter()->unit()), "mm");
  // Every parameter changes the number that its name says.
  const auto robot = softRaven();
  const ParameterSet set(robot, "all");
  for (int i = 0; i < set.size(); ++i) {
    ParameterSet::Logs logs = ParameterSet::Logs::Zero(set.size());
    logs(i) = 0.1;
    const auto changes = differences(robot, set.robot(logs));
    ASSERT_EQ(changes.size(), 1U) << set[i].name();
    EXPECT_EQ(changes[0].name(), set[i].name());
  }
}

}  // namespace
}  // namespace capstan::identification
