// Chains of one to seven joints against Orocos KDL and against the laws of mechanics.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <vector>

#include "core/robot/chain_dynamics.h"
#include "tests/core/robot/kdl_chain.h"
#include "tests/core/robot/robot_files.h"

namespace capstan::robot {
namespace {

using testing::kdlArray;

class RandomChains : public ::testing::TestWithParam<int> {
 protected:
  JointVector randomJoints(double size) {
    JointVector v(GetParam());
    for (double& x : v) x = random_.uniform(-size, size);
    return v;
  }
  base::Random random_{static_cast<std::uint64_t>(GetParam())};
};

INSTANTIATE_TEST_SUITE_P(Joints, RandomChains, ::testing::Range(1, 8));

TEST_P(RandomChains, agreeWithKdl) {
  for (int k = 0; k < 20; ++k) {
    const Description robot = testing::randomRobot(random_, GetParam());
    const KDL::Chain kdl = testing::kdlChain(robot);
    const auto n = static_cast<unsigned>(GetParam());
    const KDL::Vector gravity = testing::kdlVector(robot.gravity);
    const JointVector q = randomJoints(2.0), dq = randomJoints(2.0), ddq = randomJoints(2.0);

    KDL::Frame frame;
    KDL::ChainFkSolverPos_recursive(kdl).JntToCart(kdlArray(q), frame);
    const Eigen::Isometry3d pose = Chain(robot).linkPose(GetParam(), q);
    for (int row = 0; row < 3; ++row) {
      EXPECT_NEAR(pose.translation()[row], frame.p(row), 1e-12);
      for (int column = 0; column < 3; ++column)
        EXPECT_NEAR(pose.linear()(row, column), frame.M(row, column), 1e-12);
    }

    const ChainDynamics dynamics(robot);
    KDL::JntArray tau(n);
    KDL::ChainIdSolver_RNE(kdl, gravity)
        .CartToJnt(kdlArray(q), kdlArray(dq), kdlArray(ddq), KDL::Wrenches(n, KDL::Wrench::Zero()), tau);
    EXPECT_LT((dynamics.inverse(q, dq, ddq) - tau.data).norm(), 1e-11 * (1.0 + tau.data.norm()));
    KDL::JntSpaceInertiaMatrix mass(n);
    KDL::ChainDynParam(kdl, gravity).JntToMass(kdlArray(q), mass);
    EXPECT_LT((dynamics.massMatrix(q) - mass.data).norm(), 1e-11 * (1.0 + mass.data.norm()));
  }
}

TEST_P(RandomChains, massMatrixIsInverseDynamicsOfUnitAccelerations) {
  const ChainDynamics dynamics(testing::randomRobot(random_, GetParam()));
  const JointVector q = randomJoints(2.0), dq = randomJoints(2.0);
  const JointMatrix mass = dynamics.massMatrix(q);
  for (int i = 0; i < GetParam(); ++i) {
    const JointVector unit = JointVector::Unit(GetParam(), i);
    EXPECT_LT((dynamics.inverse(q, dq, unit) - dynamics.bias(q, dq) - mass.col(i)).norm(), 1e-11);
  }
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(mass).eigenvalues().minCoeff(), 0.0);
  EXPECT_NEAR(0.5 * dq.dot(mass * dq), dynamics.kineticEnergy(q, dq), 1e-11);
}

TEST_P(RandomChains, forwardUndoesInverse) {
  const ChainDynamics dynamics(testing::randomRobot(random_, GetParam()));
  for (int k = 0; k < 20; ++k) {
    const JointVector q = randomJoints(2.0), dq = randomJoints(2.0), ddq = randomJoints(5.0);
    EXPECT_LT((dynamics.forward(q, dq, dynamics.inverse(q, dq, ddq)) - ddq).norm(), 1e-8);
  }
}

TEST_P(RandomChains, energyGrowsByTheWorkOfTheJoints) {
  const ChainDynamics dynamics(testing::randomRobot(random_, GetParam()));
  const JointVector q = randomJoints(2.0), dq = randomJoints(2.0), ddq = randomJoints(2.0);
  constexpr double kStep = 1e-5;
  const auto energyAt = [&](double t) {
    const JointVector position = q + t * dq + 0.5 * t * t * ddq;
    const JointVector velocity = dq + t * ddq;
    return dynamics.kineticEnergy(position, velocity) + dynamics.potentialEnergy(position);
  };
  const double power = (energyAt(kStep) - energyAt(-kStep)) / (2.0 * kStep);
  EXPECT_NEAR(power, dynamics.inverse(q, dq, ddq).dot(dq), 1e-6 * (1.0 + std::abs(power)));
}

TEST_P(RandomChains, jacobianIsTheDerivativeOfTheMarker) {
  const Chain chain(testing::randomRobot(random_, GetParam()));
  const JointVector q = randomJoints(2.0);
  const JointJacobian jacobian = chain.markerJacobian(q);
  constexpr double kStep = 1e-5;
  for (int i = 0; i < GetParam(); ++i) {
    const JointVector h = kStep * JointVector::Unit(GetParam(), i);
    const Eigen::Vector3d slope = (chain.marker(q + h) - chain.marker(q - h)) / (2.0 * kStep);
    EXPECT_LT((jacobian.col(i).tail<3>() - slope).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace capstan::robot
