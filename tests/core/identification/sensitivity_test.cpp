// Derivatives of the prediction: automatic (batch) and over sigma points (dual filter), each against plain
// differences.
#include <gtest/gtest.h>

#include <cmath>

#include "core/identification/link_kernel.h"
#include "core/identification/output_error.h"
#include "core/identification/parameter_filter.h"
#include "tests/core/identification/matched_recording.h"

namespace capstan::identification {
namespace {

using test::matchedRecording;
using test::softRaven;

TEST(Sensitivity, AutomaticDerivativesAreThoseOfThePrediction) {
  const auto robot = softRaven();
  const auto data = matchedRecording(robot, robot, {.duration = 7.0});
  const ParameterSet set(robot, "all");
  const Shooting shooting(data, set, {.segment = 1.0, .warm_up = 5.0});
  ASSERT_GT(shooting.used().size(), 50U);
  ParameterSet::Logs logs = ParameterSet::Logs::Constant(set.size(), 0.02);
  std::vector<ArmPrediction> exact, plus, minus;
  shooting.predict(logs, true, exact);
  constexpr double kStep = 1e-4;
  for (int i = 0; i < set.size(); ++i) {
    ParameterSet::Logs up = logs, down = logs;
    up(i) += kStep;
    down(i) -= kStep;
    shooting.predict(up, false, plus);
    shooting.predict(down, false, minus);
    double error = 0.0, size = 0.0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
      const Eigen::Vector3d difference = (plus[k].q - minus[k].q) / (2.0 * kStep);
      error = std::max(error, (difference - exact[k].q_by_log.col(i)).cwiseAbs().maxCoeff());
      size = std::max(size, difference.cwiseAbs().maxCoeff());
    }
    EXPECT_GT(size, 1e-7) << set[i].name();
    EXPECT_LT(error, 1e-5 * size + 1e-10) << set[i].name();
  }
}

TEST(Sensitivity, InstructionSetsAgree) {
  const ParameterSet set(softRaven(), "all");
  const tracking::CableArmConstants c = set.constants(ParameterSet::Logs::Zero(set.size()));
  TangentOrder all, few;
  for (int i = 0; i < set.size(); ++i) {
    all.index[static_cast<int>(set[i].quantity)][set[i].joint] = i;
    if (set[i].joint == 1) few.index[static_cast<int>(set[i].quantity)][1] = few.count++;
  }
  all.count = set.size();
  const auto run = [&](math::InstructionSet isa, const TangentOrder& order) {
    LinkTangents x;
    const double q[] = {0.6, 1.7, 0.36};
    for (int i = 0; i < 3; ++i) x.value[i] = q[i];
    MotorStep motor{};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        motor.travel[i] += c.link_radius[i] * c.coupling[i][j] * (q[j] - c.homing[j]);
      motor.rate[i] = 0.3 * c.link_radius[i];
    }
    const double dt = 0.02;
    advanceLinkKernel(isa)(c, order, motor, dt, 100, x);
    return x;
  };
  const LinkTangents base = run(math::InstructionSet::kBaseline, all);
  for (const auto isa : math::kInstructionSets) {
    if (!math::isAvailable(isa)) continue;
    const LinkTangents same = run(isa, all), bare = run(isa, {}), eight = run(isa, few);
    for (int row = 0; row < 6; ++row) {
      EXPECT_NEAR(same.value[row], base.value[row], 1e-12);
      EXPECT_NEAR(bare.value[row], base.value[row], 1e-12) << "the value does not depend on its derivatives";
      for (int i = 0, k = 0; i < set.size(); ++i) {
        EXPECT_NEAR(same.by_log[row][i], base.by_log[row][i], 1e-10);
        if (set[i].joint == 1) {
          EXPECT_NEAR(eight.by_log[row][k++], base.by_log[row][i], 1e-10);
        }
      }
    }
  }
}

TEST(Sensitivity, PiecesGiveWhatTheWholeGives) {
  const auto robot = softRaven();
  const auto data = matchedRecording(robot, robot, {.duration = 20.0});
  const ParameterSet set(robot, "k_e");
  const Shooting whole(data, set, {.segment = 100.0, .warm_up = 10.0, .threads = 1});
  const Shooting pieces(data, set, {.segment = 2.0, .warm_up = 10.0, .threads = 2});
  std::vector<ArmPrediction> one, many;
  const ParameterSet::Logs zero = ParameterSet::Logs::Zero(3);
  whole.predict(zero, false, one);
  pieces.predict(zero, false, many);
  ASSERT_EQ(one.size(), many.size());
  for (std::size_t k = 0; k < one.size(); ++k)
    EXPECT_LT((one[k].q - many[k].q).cwiseAbs().maxCoeff(), 1e-6) << "the arm forgets its start";
}

TEST(Sensitivity, ResidualsOfTheTruthAreTheNoise) {
  const auto robot = softRaven();
  const auto data = matchedRecording(robot, robot, {.duration = 30.0});
  const ParameterSet set(robot, "k_e");
  OutputError error(data, set, {}, {});
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
  error.evaluate(Eigen::VectorXd::Zero(error.unknowns()), residuals, &jacobian);
  const double n = static_cast<double>(residuals.size());
  EXPECT_NEAR(residuals.squaredNorm() / n, 1.0, 4.0 * std::sqrt(2.0 / n));
  constexpr double kStep = 1e-5;
  for (int i = 0; i < error.unknowns(); ++i) {
    Eigen::VectorXd up = Eigen::VectorXd::Zero(error.unknowns()), down = up, high, low;
    up(i) = kStep;
    down(i) = -kStep;
    error.evaluate(up, high, nullptr);
    error.evaluate(down, low, nullptr);
    const Eigen::VectorXd difference = (high - low) / (2.0 * kStep);
    EXPECT_LT((difference - jacobian.col(i)).norm(), 1e-4 * difference.norm() + 1e-6) << i;
  }
}

/// Φ carried from interval to interval is that of the whole run.
TEST(Sensitivity, TheFilterCarriesItAcrossIntervals) {
  const auto robot = softRaven();
  const auto data = matchedRecording(robot, robot, {.duration = 6.0});
  ParameterOptions narrow;
  narrow.prior_sigma.setConstant(1e-3);  // sigma points near the centre: differences, not spreads
  const ParameterSet set(robot, "k_e2,b_e2,f_c3", narrow);
  const robot::ArmKinematics arm(robot);
  ParameterFilter filter(set, arm, {}, centreOf(data));
  const tracking::CableArmModel model(robot);
  const auto run = [&](const ParameterSet::Logs& logs) {
    tracking::CableArmModel varied(set.robot(logs));
    auto x = tracking::CableArmModel::State::Zero().eval();
    x << 0.6, 0.0, 1.6, 0.0, 0.35, 0.0;
    for (std::size_t i = 0; i + 1 < data.motors.size(); ++i) {
      const Eigen::Vector3d speed = (data.motors.position[i + 1] - data.motors.position[i]) / 1e-3;
      x = varied.propagateOne(x,
                              tracking::CableArmModel::interval({data.motors.position[i], speed},
                                                                {data.motors.position[i + 1], speed}),
                              1e-3);
    }
    return x;
  };
  tracking::CableArmModel::State x;
  x << 0.6, 0.0, 1.6, 0.0, 0.35, 0.0;
  MotorInterval interval;
  for (std::size_t i = 0; i + 1 < data.motors.size(); ++i) {
    const Eigen::Vector3d speed = (data.motors.position[i + 1] - data.motors.position[i]) / 1e-3;
    interval.steps.push_back({tracking::CableArmModel::interval({data.motors.position[i], speed},
                                                                {data.motors.position[i + 1], speed}),
                              1e-3});
    if (interval.steps.size() < 66 && i + 2 < data.motors.size()) continue;
    filter.propagate(x, interval);
    for (const auto& step : interval.steps) x = model.propagateOne(x, step.drive, step.dt);
    interval.steps.clear();
  }
  constexpr double kStep = 1e-3;
  for (int i = 0; i < 3; ++i) {
    ParameterSet::Logs up = ParameterSet::Logs::Zero(3), down = up;
    up(i) = kStep;
    down(i) = -kStep;
    const tracking::CableArmModel::State difference = (run(up) - run(down)) / (2.0 * kStep);
    const tracking::CableArmModel::State carried = filter.sensitivity().col(i);
    EXPECT_LT((carried - difference).norm(), 0.01 * difference.norm()) << set[i].name();
  }
}

}  // namespace
}  // namespace capstan::identification
