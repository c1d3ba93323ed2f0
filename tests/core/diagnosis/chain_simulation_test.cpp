// Simulations with the integration steps that a robot gets are as good as with many more.
#include "core/diagnosis/fit/chain_simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/diagnosis/evidence/read_evidence.h"
#include "core/diagnosis/fit/fit_model.h"
#include "core/diagnosis/hypotheses/joint_scales.h"
#include "core/diagnosis/selection/horizons.h"
#include "tests/core/diagnosis/planted_evidence.h"
#include "tests/support/folders.h"
#include "tests/support/planted/planted_case.h"

namespace capstan::diagnosis {
namespace {

constexpr int kJoint = 2;
constexpr double kMost = 0.2;  // error over noise, which adds 2 % to the RMS of a residual

/// The robot with cables that are so many times as stiff.
robot::Description stiffer(robot::Description robot, double times) {
  for (robot::Drive& drive : robot.drives) drive.cable_stiffness *= times;
  return robot;
}

/// RMS difference between the simulations with the robot's steps and with 80 per row, over the sensor's
/// noise, in the channel where this is largest.
double errorOverNoise(const ChainSimulation& simulation, const robot::ChainModel& model) {
  const Compared& compared = simulation.compared();
  Eigen::MatrixXd usual(compared.measured.size(), 1), fine = usual;
  simulation.simulate(std::vector<Robot>{{.model = &model}}, usual);
  simulation.simulate(std::vector<Robot>{{.model = &model, .steps = 80}}, fine);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(compared.channels.size())),
                  count = sum;
  for (Eigen::Index i = 0; i < usual.rows(); ++i) {
    const int channel = compared.channel[static_cast<std::size_t>(i)];
    sum[channel] += std::pow(usual(i, 0) - fine(i, 0), 2);
    count[channel] += 1.0;
  }
  EXPECT_TRUE(usual.allFinite() && fine.allFinite());
  EXPECT_GT(count.minCoeff(), 0.0);
  double most = 0.0;
  for (std::size_t c = 0; c < compared.channels.size(); ++c) {
    const auto k = static_cast<Eigen::Index>(c);
    most = std::max(most, std::sqrt(sum[k] / count[k]) / compared.channels[c].noise);
  }
  return most;
}

class StiffnessOf : public testing::TestWithParam<double> {};

TEST_P(StiffnessOf, CablesDoesNotMakeSimulationsLessAccurate) {
  const Planted planted(11, {}, 0, 4.0);
  const robot::Description robot = stiffer(planted.robot, GetParam());
  const ChainSimulation simulation(planted.evidence[0], robot, 0.0);
  const FitModel base(robot, jointScales(planted.evidence, robot));
  EXPECT_LT(errorOverNoise(simulation, robot::ChainModel(robot)), kMost);
  for (const Hypothesis& hypothesis : hypotheses()) {
    const std::vector<EffectStart> starts = hypothesis.starts(base.scales()[kJoint - 1], kJoint);
    if (hypothesis.facts->whole || !hypothesis.facts->cable || starts.empty()) continue;
    if (GetParam() > 1.0 && hypothesis.name() == "cable_hysteresis") continue;  // yields within micrometres
    const FitModel with = base.with(hypothesis, kJoint, starts[starts.size() / 2]);
    const Eigen::VectorXd u = with.clipped(Eigen::VectorXd::Constant(with.size(), 0.2));
    EXPECT_LT(errorOverNoise(simulation, with.chain(u)), kMost) << hypothesis.name();
  }
}

INSTANTIATE_TEST_SUITE_P(ChainSimulation, StiffnessOf, testing::Values(1.0, 30.0),
                         [](const auto& times) { return std::to_string(static_cast<int>(times.param)); });

TEST(ChainSimulation, StiffCablesNeedNoMoreSteps) {
  const Planted planted(11, {}, 0, 2.0);
  const ChainSimulation simulation(planted.evidence[0], planted.robot, 0.0);
  EXPECT_EQ(simulation.stepsFor(robot::ChainModel(stiffer(planted.robot, 30.0))),
            simulation.stepsFor(robot::ChainModel(planted.robot)));
}

/// A rigid arm whose encoders have counts of so many radians, in rows 2 ms apart.
struct RigidArm {
  robot::Description robot =
      robot::readDescription(test::sourceFile("tests/support/planted/data/rigid_arm.yaml"));
  std::vector<Evidence> evidence;

  explicit RigidArm(double count) {
    robot.drive = robot::DriveType::kRigid;
    test::DrawOptions options;
    options.robot = robot;
    options.rigid = true;
    options.effects = 0;
    options.textured = false;
    options.sensors.row_period = 2;
    options.sensors.turn_count = options.sensors.slide_count = count;
    options.duration = 6.0;
    evidence.push_back(evidenceOf(test::record(test::draw(31, options)).table, robot));
  }
};

TEST(ChainSimulation, RigidDrivesGetTheStepsThatTheirEncodersCanSee) {
  int before = 0;
  for (const double count : {1e-2, 1e-6}) {
    const RigidArm arm(count);
    const ChainSimulation simulation(arm.evidence[0], arm.robot, kHorizons[1]);
    const robot::ChainModel model(arm.robot);
    const int steps = simulation.stepsFor(model);
    EXPECT_GT(steps, before) << count;
    EXPECT_LE(steps, 4) << count;  // 0.5 ms
    before = steps;
  }
  const RigidArm arm(1e-3);
  const ChainSimulation simulation(arm.evidence[0], arm.robot, kHorizons[1]);
  EXPECT_LT(errorOverNoise(simulation, robot::ChainModel(arm.robot)), kMost);
}

}  // namespace
}  // namespace capstan::diagnosis
