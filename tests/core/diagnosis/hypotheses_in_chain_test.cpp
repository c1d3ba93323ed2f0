// What hypotheses tell about their numbers holds in the chain that is simulated: neutral ones change nothing,
// and every number of a start changes the motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/diagnosis/hypotheses/hypothesis.h"
#include "core/robot/chain/chain_model.h"
#include "core/robot/chain/chain_state.h"
#include "core/robot/chain/chain_step.h"
#include "tests/core/diagnosis/data_folder.h"

namespace capstan::diagnosis {
namespace {

constexpr int kRows = 400;
constexpr double kStep = 1e-3;
constexpr int kJoint = 2;  ///< of the RAVEN-II, the elbow

robot::Effect effectOf(const Hypothesis& hypothesis, const std::vector<double>& values) {
  robot::Effect effect{std::string(hypothesis.name()), hypothesis.facts->whole ? 0 : kJoint, {}};
  for (std::size_t i = 0; i < values.size(); ++i)
    effect.values.push_back({std::string(hypothesis.facts->parameters[i].name), values[i]});
  return effect;
}

/// Drives that shake the arm, and a load whose sign the sensor does not tell.
robot::ChainInput inputAt(int row, const robot::ChainModel& model) {
  robot::ChainInput input;
  input.t = kStep * row, input.dt = kStep;
  for (int j = 0; j < model.shape.joints; ++j) {
    const robot::JointNumbers<double>& p = model.numbers.joints[j];
    const double amplitude = 0.03 * p.link_radius / (model.shape.inverse_half_range[j] * p.lever);
    const auto motor = [&](double t) { return amplitude * std::sin((20.0 + 3.0 * j) * t); };
    input.motor[j] = motor(input.t), input.motor_end[j] = motor(input.t + kStep);
    input.torque[j] = 0.4 * std::sin(20.0 * input.t);
    input.signed_load[j] = std::sin(30.0 * input.t);
    input.load[j] = std::abs(input.signed_load[j]);
  }
  return input;
}

/// The joints' motion, what the cameras tell of one point, and when.
std::vector<double> seen(const robot::ChainModel& model) {
  const int n = model.shape.joints;
  robot::JointVector q(n);
  for (int j = 0; j < n; ++j) q[j] = model.numbers.joints[j].homing;
  const int steps = 1 + static_cast<int>(kStep * robot::chainOscillation(model, q) / 0.7);
  robot::ChainState<double> state = robot::stateAt(model, q, robot::JointVector::Zero(n));
  robot::ChainStep<double> step(model.shape, model.numbers);
  std::vector<double> result;
  for (int row = 0; row < kRows; ++row) {
    step.advance(inputAt(row, model), steps, state);
    for (int j = 0; j < n; ++j) result.push_back(state.q[j]);
  }
  const Eigen::Vector3d point = model.camera.measure({0.1, -0.2, 0.3});
  result.insert(result.end(), point.begin(), point.end());
  result.push_back(model.camera.delay);
  return result;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

JointScales scalesOf(bool rigid) {
  const robot::Description robot = raven();
  const robot::Joint& joint = robot.joints[kJoint - 1];
  const robot::Drive& drive = robot.drives[kJoint - 1];
  JointScales scales;
  scales.range = joint.limit_high - joint.limit_low;
  scales.speed = joint.max_speed;
  scales.coulomb = joint.friction.coulomb;
  scales.inertia = 0.05;
  scales.radius = drive.link_radius;
  scales.capstan = drive.motor_capstan_radius;
  scales.gear = drive.gear_ratio;
  scales.stiffness = rigid ? 0.0 : 2.0 * drive.cable_stiffness * drive.cable_exponent;
  scales.stretch = 3.0 * scales.coulomb / scales.radius / std::max(scales.stiffness, 1e4);
  scales.duration = kRows * kStep;
  scales.joints = robot.size();
  return scales;
}

robot::ChainModel ravenDriven(bool rigid) {
  robot::Description robot = raven();
  robot.drive = rigid ? robot::DriveType::kRigid : robot::DriveType::kCable;
  return robot::ChainModel(robot);
}

std::vector<double> seenWith(const Hypothesis& hypothesis, const std::vector<double>& values, bool rigid) {
  robot::ChainModel model = ravenDriven(rigid);
  model.add(effectOf(hypothesis, values));
  return seen(model);
}

class HypothesesInChain : public testing::TestWithParam<bool> {
 protected:
  bool rigid() const { return GetParam(); }
  bool concerns(const Hypothesis& hypothesis) const {
    return rigid() ? hypothesis.facts->rigid : hypothesis.facts->cable;
  }
};

TEST_P(HypothesesInChain, NeutralNumbersChangeNothing) {
  const std::vector<double> nominal = seen(ravenDriven(rigid()));
  double low = 10.0, high = -10.0;
  for (std::size_t row = 0; row < kRows; ++row) {
    low = std::min(low, nominal[3 * row + kJoint - 1]);
    high = std::max(high, nominal[3 * row + kJoint - 1]);
  }
  ASSERT_GT(high - low, 0.01) << "the arm moves";
  for (const Hypothesis& hypothesis : hypotheses()) {
    if (!concerns(hypothesis)) continue;
    if (rigid() && hypothesis.name() == "cable_compliance") continue;  // a spring has to give
    EXPECT_LT(farthest(seenWith(hypothesis, hypothesis.neutral, rigid()), nominal), 1e-8)
        << hypothesis.name();
  }
}

/// A scale away from the start on all numbers, half of one more on each.
TEST_P(HypothesesInChain, EveryNumberChangesTheMotion) {
  const std::vector<double> nominal = seen(ravenDriven(rigid()));
  for (const Hypothesis& hypothesis : hypotheses()) {
    if (!concerns(hypothesis)) continue;
    SCOPED_TRACE(hypothesis.name());
    const auto starts = hypothesis.starts(scalesOf(rigid()), hypothesis.facts->whole ? 0 : kJoint);
    ASSERT_FALSE(starts.empty());
    const EffectStart& start = starts[starts.size() / 2];
    std::vector<double> values = start.value;
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += start.scale[i];
    const std::vector<double> with = seenWith(hypothesis, values, rigid());
    EXPECT_TRUE(std::ranges::all_of(with, [](double x) { return std::isfinite(x); }));
    EXPECT_GT(farthest(with, nominal), 1e-6);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (start.scale[i] == 0.0) continue;
      std::vector<double> moved = values;
      moved[i] += 0.5 * start.scale[i];
      EXPECT_GT(farthest(seenWith(hypothesis, moved, rigid()), with), 1e-7)
          << hypothesis.facts->parameters[i].name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Drives, HypothesesInChain, testing::Values(false, true),
                         [](const auto& drive) { return drive.param ? "Rigid" : "Cable"; });

}  // namespace
}  // namespace capstan::diagnosis
