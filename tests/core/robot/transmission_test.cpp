#include "core/robot/transmission.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/core/robot/robot_files.h"

namespace capstan::robot {
namespace {

using Eigen::Vector3d;

class RavenTransmission : public ::testing::Test {
 protected:
  Transmission transmission_{testing::raven()};
  base::Random random_{11};
};

TEST_F(RavenTransmission, hardStopIsMotorZero) {
  const Vector3d stop(0.0, 137.5 * std::numbers::pi / 180.0, 0.562);
  EXPECT_EQ(Vector3d(transmission_.jointFromMotor(Vector3d::Zero())), stop);
  EXPECT_EQ(Vector3d(transmission_.homing()), stop);
  EXPECT_EQ(Vector3d(transmission_.motorFromJoint(stop)), Vector3d::Zero());
}

TEST_F(RavenTransmission, bothWaysAreInverse) {
  for (int k = 0; k < 1000; ++k) {
    const Vector3d q_m = testing::randomVector(random_, 500.0);
    const Vector3d dq_m = testing::randomVector(random_, 500.0);
    EXPECT_LT((transmission_.motorFromJoint(transmission_.jointFromMotor(q_m)) - q_m).norm(), 1e-11);
    EXPECT_LT(
        (transmission_.motorVelocityFromJoint(transmission_.jointVelocityFromMotor(dq_m)) - dq_m).norm(),
        1e-11);
    EXPECT_LT(
        (transmission_.motorTravel(q_m) - transmission_.linkTravel(transmission_.jointFromMotor(q_m))).norm(),
        1e-15);
  }
}

TEST_F(RavenTransmission, couplingByForwardSubstitution) {
  // s_l = r_l ∘ A (q − q_hs) solved row by row; the numbers are the published constants.
  const double c01 = 0.14545, c02 = 0.0077973826, c12 = 0.008077387;
  const Vector3d q_m(80.0, -90.0, -480.0);
  const Vector3d s_m = 5.675e-3 / 12.25 * q_m;
  const double x1 = s_m[0] / 0.063095;
  const double x2 = s_m[1] / 0.056298 - c01 * x1;
  const double x3 = s_m[2] - c02 * x1 - c12 * x2;
  const Vector3d stop(0.0, 137.5 * std::numbers::pi / 180.0, 0.562);
  EXPECT_LT((transmission_.jointFromMotor(q_m) - stop - Vector3d(x1, x2, x3)).norm(), 1e-14);
}

TEST_F(RavenTransmission, forcesAndTravelsDoTheSameWork) {
  for (int k = 0; k < 100; ++k) {
    const Vector3d force = testing::randomVector(random_, 50.0);
    const Vector3d dq = testing::randomVector(random_, 3.0);
    EXPECT_NEAR(transmission_.jointTorque(force).dot(dq), force.dot(transmission_.linkTravelRate(dq)), 1e-12);
    EXPECT_NEAR(transmission_.motorReaction(force).dot(dq), force.dot(transmission_.motorTravel(dq)), 1e-12);
  }
}

TEST(Transmission, takesOneToSevenJoints) {
  base::Random random(13);
  for (int n = 1; n <= kMaxJoints; ++n) {
    Description robot = testing::randomRobot(random, n);
    for (int i = 0; i < n; ++i) {
      Drive drive;
      drive.gear_ratio = random.uniform(5.0, 20.0);
      drive.motor_capstan_radius = random.uniform(4e-3, 8e-3);
      drive.link_radius = random.uniform(0.03, 0.1);
      robot.drives.push_back(drive);
      std::vector<double> row(static_cast<std::size_t>(n), 0.0);
      for (int j = 0; j <= i; ++j)
        row[static_cast<std::size_t>(j)] = j == i ? 1.0 : random.uniform(-0.3, 0.3);
      robot.coupling.push_back(row);
    }
    const Transmission transmission(robot);
    const JointVector q_m = 100.0 * JointVector::Ones(n);
    EXPECT_LT((transmission.motorFromJoint(transmission.jointFromMotor(q_m)) - q_m).norm(), 1e-10);
  }
}

}  // namespace
}  // namespace capstan::robot
