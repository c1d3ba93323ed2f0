#include <gtest/gtest.h>

#include <cmath>

#include "core/base/units.h"
#include "core/robot/transmission.h"
#include "tests/core/simulation/simulated_robot.h"

namespace capstan::simulation {
namespace {

struct Errors {
  Eigen::Vector3d kinematic = Eigen::Vector3d::Zero();  ///< RMS of transmission kinematics minus encoders
  Eigen::Vector3d tracking = Eigen::Vector3d::Zero();   ///< RMS of desired minus transmission kinematics
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();     ///< largest
};

Errors errorsOf(const SimulatedOptions& options) {
  SimulatedSource source(options);
  const robot::Transmission transmission(options.robot);
  const auto path = makeTrajectory(options.trajectory, options.robot, options.seed);
  Errors sum;
  Eigen::Vector3d kinematic = Eigen::Vector3d::Zero();
  int n = 0;
  tracking::Sample sample;
  while (source.next(sample)) {
    if (const auto* motor = std::get_if<tracking::MotorSample>(&sample)) {
      kinematic = transmission.jointFromMotor(motor->position);
      sum.torque = sum.torque.cwiseMax(motor->torque.cwiseAbs());
      sum.tracking += (path->at(motor->t - 0.25).position - kinematic).cwiseAbs2();
    } else if (const auto* joint = std::get_if<tracking::JointSample>(&sample)) {
      sum.kinematic += (kinematic - joint->position).cwiseAbs2();
      ++n;
    }
  }
  sum.kinematic = (sum.kinematic / n).cwiseSqrt();
  sum.tracking = (sum.tracking / n).cwiseSqrt();
  return sum;
}

TEST(ClosedLoop, DefaultTruthsKinematicErrorIsTheShoulderPulley) {
  SimulatedOptions options = quietOptions(60.0);
  const Errors matched = errorsOf(options);
  options.truth = defaultTruth();
  const Errors real = errorsOf(options);
  std::printf(
      "kinematic RMS, 60 s block transfer: default %.3f deg %.3f deg %.3f mm, matched %.4f deg %.4f deg %.4f "
      "mm\n",
      base::toDegrees(real.kinematic[0]), base::toDegrees(real.kinematic[1]), 1e3 * real.kinematic[2],
      base::toDegrees(matched.kinematic[0]), base::toDegrees(matched.kinematic[1]),
      1e3 * matched.kinematic[2]);
  EXPECT_GT(base::toDegrees(real.kinematic[0]), 1.5);
  EXPECT_LT(base::toDegrees(real.kinematic[0]), 4.0);
  EXPECT_GT(real.kinematic[0], 4.0 * real.kinematic[1]);
  for (int i = 0; i < 3; ++i) EXPECT_GT(real.kinematic[i], 1.5 * matched.kinematic[i]);

  Truth no_pulley = defaultTruth();
  no_pulley.joints[0].link_radius.reset();
  options.truth = no_pulley;
  EXPECT_LT(errorsOf(options).kinematic[0], 0.05 * real.kinematic[0]);
}

TEST(ClosedLoop, MotorsFollowThePathWithinATenthOfADegree) {
  SimulatedOptions options = quietOptions(20.0);
  options.truth = defaultTruth();
  options.trajectory.kind = TrajectoryKind::kSinusoid;
  const Errors errors = errorsOf(options);
  EXPECT_LT(base::toDegrees(errors.tracking[0]), 0.15);
  EXPECT_LT(base::toDegrees(errors.tracking[1]), 0.15);
  EXPECT_LT(errors.tracking[2], 3e-4);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT(errors.torque[static_cast<Eigen::Index>(i)], options.robot.drives[i].motor_torque_limit);
}

TEST(ClosedLoop, GainsFeedForwardAndTorqueLimitsShowInTheTrackingError) {
  SimulatedOptions options = quietOptions(10.0);
  options.trajectory.kind = TrajectoryKind::kSinusoid;
  const Errors nominal = errorsOf(options);

  SimulatedOptions soft = options;
  soft.truth.controller.stiffness = 0.3;
  EXPECT_GT(errorsOf(soft).tracking[0], 2.0 * nominal.tracking[0]);
  SimulatedOptions fed = options;
  fed.truth.controller.friction_feedforward = 1.0;
  EXPECT_LT(errorsOf(fed).tracking[0], 0.9 * nominal.tracking[0]);
  SimulatedOptions weak = options;
  weak.truth.joints[2].torque_limit_factor = 0.15;
  EXPECT_GT(errorsOf(weak).tracking[2], 5.0 * nominal.tracking[2]);
}

TEST(ClosedLoop, EncodersRoundToTheirCounts) {
  SimulatedOptions options = quietOptions(1.0);
  options.truth = defaultTruth();
  SimulatedSource source(options);
  tracking::Sample sample;
  const double motor_step = 2.0 * std::acos(-1.0) / 4000.0, joint_step = 2.0 * std::acos(-1.0) / 80000.0;
  while (source.next(sample)) {
    if (const auto* motor = std::get_if<tracking::MotorSample>(&sample)) {
      const double counts = motor->position[0] / motor_step;
      ASSERT_NEAR(counts, std::round(counts), 1e-6);
    } else if (const auto* joint = std::get_if<tracking::JointSample>(&sample)) {
      ASSERT_NEAR(joint->position[1] / joint_step, std::round(joint->position[1] / joint_step), 1e-6);
      ASSERT_NEAR(joint->position[2] / 5e-6, std::round(joint->position[2] / 5e-6), 1e-6);
    }
  }
}

TEST(ClosedLoop, EncoderVelocityIsTheDerivativeOfThePosition) {
  for (const bool real : {false, true}) {
    SimulatedOptions options = quietOptions(8.0);
    options.trajectory.kind = TrajectoryKind::kSinusoid;
    options.truth.encoders.motor_quantised = real;
    SimulatedSource source(options);
    tracking::Sample sample;
    Eigen::Vector3d integral = Eigen::Vector3d::Zero(), first = integral, last = integral, worst = integral;
    while (source.next(sample)) {
      const auto* motor = std::get_if<tracking::MotorSample>(&sample);
      if (motor == nullptr) continue;
      if (motor->t == 0.0) first = motor->position;
      integral += 1e-3 * motor->velocity;
      last = motor->position - first;
      worst = worst.cwiseMax((last - integral).cwiseAbs());
    }
    EXPECT_LT(worst.maxCoeff(), 1.0) << "real " << real;  // [rad] of hundreds: the filter's lag of 2 ms
  }
}

}  // namespace
}  // namespace capstan::simulation
