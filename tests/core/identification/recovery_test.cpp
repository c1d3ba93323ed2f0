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
constexpr ModelDoubt kNoDoubt = {.friction_share = 0.0};

TEST(Recovery, BatchFindsWhatTheRecordingHolds) {
  const auto truth = softRaven(), nominal = wrongBy(truth);
  CameraPose pose;
  pose.turn = {0.008, -0.006, 0.004};
  pose.shift = {0.001, -0.002, 0.0015};
  pose.delay = 0.003;
  const auto data = matchedRecording(truth, nominal, {.duration = 60.0, .pose = pose});
  const ParameterSet set(nominal, kAsked);
  const BatchReport report = identifyBatch(data, set, {.doubt = kNoDoubt});
  ASSERT_EQ(report.end, BatchEnd::kConverged);
  EXPECT_NEAR(report.residual_after, 1.0, 0.05);
  const double wrong[] = {1.05, 1.8, 0.6, 1.5};
  for (int i = 0; i < set.size(); ++i) {
    const Estimate& found = report.estimates[static_cast<std::size_t>(i)];
    EXPECT_TRUE(found.seen) << found.advice;
    EXPECT_LT(std::abs(found.log + std::log(wrong[i])), 4.0 * found.sigma) << found.parameter.name();
    EXPECT_LT(found.sigma, i == 0 ? 0.002 : 0.05) << found.parameter.name();
  }
  EXPECT_LT((report.camera.turn - pose.turn).cwiseQuotient(report.camera_sigma.turn).cwiseAbs().maxCoeff(),
            4.0);
  EXPECT_LT(std::abs(report.camera.delay - pose.delay), 4.0 * report.camera_sigma.delay);
}

TEST(Recovery, DualFilterFindsTheSame) {
  const auto truth = softRaven(), nominal = wrongBy(truth);
  const auto data = matchedRecording(truth, nominal, {.duration = 60.0});
  const ParameterSet set(nominal, kAsked);
  int points = 0;
  const DualUkfReport report =
      identifyDualUkf(data, set, {.doubt = kNoDoubt}, nullptr, [&](const TracePoint&) { ++points; });
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
    const BatchReport report = identifyBatch(data, set, {.shooting = {.warm_up = 3.0}, .doubt = kNoDoubt});
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
      const ModelDoubt doubt{.friction_share = share};
      const Estimate found = batch ? identifyBatch(data, set, {.doubt = doubt}).estimates[0]
                                   : identifyDualUkf(data, set, {.doubt = doubt}).estimates[0];
      variance.push_back(found.sigma * found.sigma);
      value.push_back(found.log);
    }
    EXPECT_EQ(value[0], value[2]) << batch;
    EXPECT_GT(variance[1], variance[0]);
    EXPECT_NEAR((variance[2] - variance[1]) / (variance[1] - variance[0]), 4.0, 1e-6) << batch;
  }
}

TEST(Recovery, AnArmAtRestSaysThatNothingCanBeSeen) {
  const auto robot = softRaven();
  const auto data = matchedRecording(robot, robot, {.duration = 15.0, .moves = false});
  const ParameterSet set(robot, "b_e2,r_l1");
  for (const auto& estimates : {identifyBatch(data, set).estimates, identifyDualUkf(data, set).estimates})
    for (const Estimate& estimate : estimates) {
      EXPECT_FALSE(estimate.seen) << estimate.parameter.name();
      EXPECT_NE(estimate.advice.find("move"), std::string::npos) << estimate.advice;
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
