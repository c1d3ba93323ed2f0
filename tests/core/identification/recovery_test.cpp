// Known truth in, known truth out: both methods on recordings of the model itself, and on the simulated
// robot.
#include <gtest/gtest.h>

#include <cmath>

#include "core/identification/batch.h"
#include "core/identification/dual_ukf.h"
#include "core/simulation/simulated_source.h"
#include "core/simulation/simulation_request.h"
#include "tests/core/identification/matched_recording.h"

namespace capstan::identification {
namespace {

using test::matchedRecording;
using test::softRaven;

robot::Description wrongBy(robot::Description robot) {
  robot.drives[0].link_radius *= 1.05;
  robot.drives[1].cable_stiffness *= 1.8;
  robot.drives[2].cable_stiffness *= 0.6;
  robot.drives[1].cable_damping *= 1.5;
  return robot;
}

const char* const kAsked = "r_l1,k_e2,k_e3,b_e2";
/// Recordings of the filter's own model hold no force that it does not know.
constexpr ModelDiscrepancy kNoDoubt = {.friction_share = 0.0};

TEST(Recovery, BatchFindsWhatTheRecordingHolds) {
  const auto truth = softRaven(), nominal = wrongBy(truth);
  CameraPose pose;
  pose.rotation = {0.008, -0.006, 0.004};
  pose.shift = {0.001, -0.002, 0.0015};
  pose.delay = 0.003;
  const auto data = matchedRecording(truth, nominal, {.duration = 60.0, .pose = pose});
  const ParameterSet set(nominal, kAsked);
  const BatchReport report = identifyBatch(data, set, {.discrepancy = kNoDoubt});
  ASSERT_EQ(report.end, BatchEnd::kConverged);
  EXPECT_NEAR(report.residual_after, 1.0, 0.05);
  const double wrong[] = {1.05, 1.8, 0.6, 1.5};
  for (int i = 0; i < set.size(); ++i) {
    const Estimate& found = report.estimates[static_cast<std::size_t>(i)];
    EXPECT_TRUE(found.seen) << found.advice;
    EXPECT_LT(std::abs(found.log + std::log(wrong[i])), 4.0 * found.sigma) << found.parameter.name();
    EXPECT_LT(found.sigma, i == 0 ? 0.002 : 0.05) << found.parameter.name();
  }
  EXPECT_LT((report.camera.rotation - pose.rotation)
                .cwiseQuotient(report.camera_sigma.rotation)
                .cwiseAbs()
                .maxCoeff(),
            4.0);
  EXPECT_LT(std::abs(report.camera.delay - pose.delay), 4.0 * report.camera_sigma.delay);
}

TEST(Recovery, DualFilterFindsTheSame) {
  const auto truth = softRaven(), nominal = wrongBy(truth);
  const auto data = matchedRecording(truth, nominal, {.duration = 60.0});
  const ParameterSet set(nominal, kAsked);
  int points = 0;
  const DualUkfReport report =
      identifyDualUkf(data, set, {.discrepancy = kNoDoubt}, nullptr, [&](const TracePoint&) { ++points; });
  ASSERT_EQ(report.end, DualUkfEnd::kRecordingEnded);
  EXPECT_EQ(points, static_cast<int>(report.trace.size()));
  EXPECT_NEAR(report.nis, 1.0, 0.35);
  const double wrong[] = {1.05, 1.8, 0.6, 1.5};
  for (int i = 0; i < set.size(); ++i) {
    const Estimate& found = report.estimates[static_cast<std::size_t>(i)];
    EXPECT_TRUE(found.seen) << found.advice;
    EXPECT_LT(std::abs(found.log + std::log(wrong[i])), 4.0 * found.sigma) << found.parameter.name();
    EXPECT_LT(found.sigma, i == 0 ? 0.004 : 0.1) << found.parameter.name();
  }
}

TEST(Recovery, StandardDeviationsAreHonestOverManyRecordings) {
  const auto robot = softRaven();
  const ParameterSet set(robot, "k_e2,f_c2");
  double squares = 0.0;
  constexpr int kRuns = 12;
  for (int run = 0; run < kRuns; ++run) {
    const auto data =
        matchedRecording(robot, robot, {.duration = 20.0, .seed = 100U + static_cast<unsigned>(run)});
    const BatchReport report =
        identifyBatch(data, set, {.shooting = {.warm_up = 3.0}, .discrepancy = kNoDoubt});
    for (const Estimate& found : report.estimates) squares += std::pow(found.log / found.sigma, 2);
  }
  // 24 squares; the two of a run are correlated: between the 0.1 % and 99.9 % points of chi-square with 12.
  EXPECT_GT(squares / 2.0, 2.2);
  EXPECT_LT(squares / 2.0, 32.9);
}

/// What an unknown force adds to a variance grows with its square, and moves no estimate.
TEST(Recovery, ForcesThatNoModelKnowsWidenTheIntervals) {
  const auto truth = softRaven();
  const auto data = matchedRecording(truth, truth, {.duration = 30.0});
  const ParameterSet set(truth, "k_e2");
  for (const bool batch : {true, false}) {
    std::vector<double> variance, value;
    for (const double share : {0.5, 1.0, 2.0}) {
      const ModelDiscrepancy discrepancy{.friction_share = share};
      const Estimate found = batch ? identifyBatch(data, set, {.discrepancy = discrepancy}).estimates[0]
                                   : identifyDualUkf(data, set, {.discrepancy = discrepancy}).estimates[0];
      variance.push_back(found.sigma * found.sigma);
      value.push_back(found.log);
    }
    EXPECT_EQ(value[0], value[2]) << batch;
    EXPECT_GT(variance[1], variance[0]);
    EXPECT_NEAR((variance[2] - variance[1]) / (variance[1] - variance[0]), 4.0, 1e-6) << batch;
  }
}

/// Each is warmed up by itself: together they say what one long recording would.
TEST(Recovery, ManyShortRecordingsAreAsGoodAsALongOne) {
  const auto truth = softRaven(), nominal = wrongBy(truth);
  auto data = matchedRecording(truth, nominal, {.duration = 20.0, .seed = 11});
  for (const std::uint64_t seed : {12U, 13U})
    append(data, matchedRecording(truth, nominal, {.duration = 20.0, .seed = seed}));
  const ParameterSet set(nominal, kAsked);
  const Shooting shooting(data, set);
  EXPECT_GT(shooting.used().size(), data.openCount() / 2);
  int joins = 0;
  for (std::size_t k = 1; k < shooting.used().size(); ++k) joins += shooting.continues(k) ? 0 : 1;
  EXPECT_EQ(joins, 2);
  const BatchReport report = identifyBatch(data, set, {.discrepancy = kNoDoubt}),
                    one = identifyBatch(matchedRecording(truth, nominal, {.duration = 20.0}), set,
                                        {.discrepancy = kNoDoubt});
  ASSERT_EQ(report.end, BatchEnd::kConverged);
  const double wrong[] = {1.05, 1.8, 0.6, 1.5};
  for (int i = 0; i < set.size(); ++i) {
    const Estimate& found = report.estimates[static_cast<std::size_t>(i)];
    EXPECT_TRUE(found.seen) << found.advice;
    EXPECT_LT(std::abs(found.log + std::log(wrong[i])), 4.0 * found.sigma) << found.parameter.name();
    const double of_one = one.estimates[static_cast<std::size_t>(i)].sigma;
    EXPECT_LT(found.sigma, 0.8 * of_one) << found.parameter.name() << ": more of a motion does not say less";
  }
}

/// What is stated decides, not what noise alone would allow; and the words do not blame a bystander.
TEST(Recovery, SeenMeansByTheStatedSigma) {
  const auto truth = softRaven();
  const auto data = matchedRecording(truth, truth, {.duration = 30.0});
  const ParameterSet set(truth, "k_e2");
  const BatchReport sure = identifyBatch(data, set, {.discrepancy = kNoDoubt});
  const double by_one = identifyBatch(data, set, {.discrepancy = {.friction_share = 1.0}}).estimates[0].sigma;
  const double share = 0.7 * set[0].prior_sigma / by_one;  // beyond kSeenShare, within the prior
  const BatchReport low_confidence = identifyBatch(data, set, {.discrepancy = {.friction_share = share}});
  EXPECT_TRUE(sure.estimates[0].seen);
  EXPECT_EQ(sure.estimates[0].advice, "");
  EXPECT_TRUE(low_confidence.before.parameters[0].seen) << "by noise alone";
  EXPECT_GT(low_confidence.estimates[0].sigma, kSeenShare * set[0].prior_sigma);
  EXPECT_FALSE(low_confidence.estimates[0].seen);
  EXPECT_NE(low_confidence.estimates[0].advice.find("Friction and hysteresis"), std::string::npos)
      << low_confidence.estimates[0].advice;
  EXPECT_EQ(identifiedRobot(set, low_confidence.estimates).drives[1].cable_stiffness,
            truth.drives[1].cable_stiffness);
}

/// A recording may begin at any time of the clock.
TEST(Recovery, TheClocksOriginDoesNotMatter) {
  const auto robot = softRaven();
  auto data = matchedRecording(robot, wrongBy(robot), {.duration = 20.0});
  const ParameterSet set(data.robot, kAsked);
  const DualUkfReport early = identifyDualUkf(data, set);
  for (double& t : data.motors.t) t += 8192.0;  // a power of two: times stay as exact as they are
  for (CameraObservation& seen : data.cameras) seen.t += 8192.0;
  const DualUkfReport late = identifyDualUkf(data, set);
  for (std::size_t i = 0; i < early.estimates.size(); ++i) {
    EXPECT_NEAR(late.estimates[i].log, early.estimates[i].log, 1e-6);
    EXPECT_NEAR(late.estimates[i].sigma, early.estimates[i].sigma, 1e-6);
  }
}

/// Half a spring and half a damper in the cable of joint 2, which the model does not have, one standard
/// deviation of ModelDiscrepancy strong: noise alone would be too sure of the damping.
TEST(Recovery, HysteresisOfACableIsInTheIntervals) {
  simulation::SimulationRequest request;
  request.trajectory = "fls";
  request.duration = 60.0;
  request.images = false;
  auto options = simulation::optionsOf(request);
  options.truth = simulation::Truth{};
  options.truth.cameras.pixel_sigma = 0.01;  // it is not noise that hides the damping
  const robot::Drive& drive = options.robot.drives[1];
  constexpr double kYield = 5e-5;
  const double force =
      ModelDiscrepancy{}.friction_share * options.robot.joints[1].friction.coulomb / drive.link_radius;
  options.truth.joints[1].hysteresis = {.stiffness = force / kYield, .yield = kYield};
  simulation::SimulatedSource source(options);
  const IdentificationData data = collect(source);
  const ParameterSet set(data.robot, "r_l,k_e2,b_e2,f_c2");
  const BatchReport report = identifyBatch(data, set);
  const Estimate& found = report.estimates[4];
  ASSERT_EQ(found.parameter.name(), "b_e2");
  EXPECT_GT(std::abs(found.log), 1.96 * report.before.parameters[4].sigma) << "noise alone explains it";
  EXPECT_LT(std::abs(found.log), 1.96 * found.sigma) << found.log << " ± " << found.sigma;
  EXPECT_LT(found.sigma, 0.5) << "wide enough to hold anything";
}

TEST(Recovery, AnArmAtRestSaysThatNothingCanBeSeen) {
  const auto robot = softRaven();
  const auto data = matchedRecording(robot, robot, {.duration = 15.0, .moves = false});
  const ParameterSet set(robot, "b_e2,r_l1");
  for (const auto& estimates : {identifyBatch(data, set).estimates, identifyDualUkf(data, set).estimates})
    for (const Estimate& estimate : estimates) {
      EXPECT_FALSE(estimate.seen) << estimate.parameter.name();
      EXPECT_NE(estimate.advice.find("Move"), std::string::npos) << estimate.advice;
    }
}

TEST(Recovery, NothingSeenNothingSaid) {
  const auto robot = softRaven();
  auto data = matchedRecording(robot, robot, {.duration = 8.0});
  data.cameras.clear();
  const ParameterSet set(robot, "r_l1");
  EXPECT_EQ(identifyDualUkf(data, set).end, DualUkfEnd::kNoData);
  const BatchReport report = identifyBatch(data, set);
  EXPECT_EQ(report.end, BatchEnd::kNoData);
  ASSERT_EQ(report.estimates.size(), 1U);
  EXPECT_FALSE(report.estimates[0].seen);
}

TEST(Recovery, CancellingEndsBoth) {
  const auto robot = softRaven();
  const auto data = matchedRecording(robot, robot, {.duration = 15.0});
  const ParameterSet set(robot, "r_l1");
  base::Progress progress;
  progress.cancel();
  EXPECT_EQ(identifyDualUkf(data, set, {}, &progress).end, DualUkfEnd::kCancelled);
  EXPECT_EQ(identifyBatch(data, set, {}, &progress).end, BatchEnd::kCancelled);
}

/// The richer plant, tips without pictures: experiment A of the UKF paper in short.
TEST(Recovery, PulleyOfTheSimulatedRobot) {
  simulation::SimulationRequest request;
  request.trajectory = "sinusoid";
  request.duration = 60.0;
  request.images = false;
  simulation::SimulatedSource source(simulation::optionsOf(request));
  const IdentificationData data = collect(source);
  const ParameterSet set(data.robot, "r_l1");
  const DualUkfReport dual = identifyDualUkf(data, set);
  EXPECT_NEAR(dual.estimates[0].value(), 0.059, 0.003 * 0.059);
  EXPECT_TRUE(dual.convergence[0].settled);
  EXPECT_LT(std::abs(dual.estimates[0].log - std::log(59.0 / 63.095)), 4.0 * dual.estimates[0].sigma);
}

}  // namespace
}  // namespace capstan::identification
