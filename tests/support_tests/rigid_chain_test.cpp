// Rigid bodies of the planted robot against the library's, an independent table, and first principles.
#include "tests/support/planted/rigid_chain.h"
#include "tests/support/folders.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <map>

#include "core/base/random.h"
#include "core/base/yaml.h"
#include "core/robot/chain_dynamics.h"
#include "core/table_files/csv.h"
#include "tests/core/robot/robot_files.h"
#include "tests/support_tests/planted_robots.h"

namespace capstan::test {
namespace {

Joints randomJoints(base::Random& random, int n, double size) {
  Joints x{};
  for (int i = 0; i < n; ++i) x[i] = random.uniform(-size, size);
  return x;
}

robot::JointVector vectorOf(const Joints& x, int n) {
  robot::JointVector v(n);
  for (int i = 0; i < n; ++i) v(i) = x[i];
  return v;
}

TEST(RigidChain, AgreesWithTheLibraryForEveryNumberOfJoints) {
  base::Random random(3);
  for (int n = 1; n <= 7; ++n)
    for (int trial = 0; trial < 20; ++trial) {
      const robot::Description robot = robot::testing::randomRobot(random, n);
      const robot::ChainDynamics library(robot);
      RigidChain chain(robot);
      const Joints q = randomJoints(random, n, 2.0), dq = randomJoints(random, n, 3.0),
                   ddq = randomJoints(random, n, 9.0);
      chain.pose(q);
      const robot::JointVector desired = library.inverse(vectorOf(q, n), vectorOf(dq, n), vectorOf(ddq, n));
      const robot::JointMatrix mass = library.massMatrix(vectorOf(q, n));
      const Joints tau = chain.inverse(dq, ddq);
      const RigidChain::Matrix m = chain.massMatrix();
      for (int i = 0; i < n; ++i) {
        EXPECT_NEAR(tau[i], desired(i), 1e-10 * (1.0 + desired.norm()));
        for (int j = 0; j < n; ++j) EXPECT_NEAR(m[i][j], mass(i, j), 1e-11 * (1.0 + mass.norm()));
      }
      const double energy =
          library.kineticEnergy(vectorOf(q, n), vectorOf(dq, n)) + library.potentialEnergy(vectorOf(q, n));
      EXPECT_NEAR(chain.energy(dq), energy, 1e-10 * (1.0 + std::abs(energy)));
    }
}

TEST(RigidChain, AgreesWithTheIndependentTable) {
  const auto path = sharedFile("raven2-check.csv");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  std::map<std::string, std::vector<double>> table;
  table_files::parseCsv(base::readTextFile(path), path.string(),
                        [&](std::string_view name, std::size_t) { return &table[std::string(name)]; });
  const robot::Description robot = raven();
  RigidChain chain(robot);
  ASSERT_EQ(table["q1"].size(), 200U);
  for (std::size_t k = 0; k < table["q1"].size(); ++k) {
    Joints q{}, dq{}, ddq{};
    for (int i = 0; i < 3; ++i) {
      const std::string joint = std::to_string(i + 1);
      q[i] = table["q" + joint][k];
      dq[i] = table["dq" + joint][k];
      ddq[i] = table["ddq" + joint][k];
    }
    chain.pose(q);
    const Joints tau = chain.inverse(dq, ddq);
    const RigidChain::Matrix mass = chain.massMatrix();
    const Eigen::Vector3d tip = chain.point(robot.marker);
    for (int i = 0; i < 3; ++i) {
      const std::string joint = std::to_string(i + 1);
      EXPECT_NEAR(tau[i], table["tau" + joint][k], 1e-9);
      EXPECT_NEAR(tip(i), table[std::string("tip_") + "xyz"[i]][k], 1e-9);
      for (int j = i; j < 3; ++j)
        EXPECT_NEAR(mass[i][j], table["M" + joint + std::to_string(j + 1)][k], 1e-9);
    }
  }
}

/// A point mass m at p adds m JᵀJ to the mass matrix and −m gᵀJ to gravity's torque, J = dp/dq by
/// differences.
TEST(RigidChain, APointMassActsThroughThePointsJacobian) {
  const robot::Description robot = raven();
  RigidChain bare(robot), loaded(robot);
  const double m = 0.31;
  const Eigen::Vector3d at(0.02, -0.03, -0.4);
  loaded.addPointMass(2, m, at);
  const Joints q{0.8, 1.4, 0.35};
  Eigen::Matrix3d jacobian;
  for (int j = 0; j < 3; ++j) {
    const double h = 1e-6;
    Joints up = q, down = q;
    up[j] += h;
    down[j] -= h;
    bare.pose(up);
    const Eigen::Vector3d ahead = bare.point(at);
    bare.pose(down);
    jacobian.col(j) = (ahead - bare.point(at)) / (2.0 * h);
  }
  bare.pose(q);
  loaded.pose(q);
  const Eigen::Matrix3d added = m * jacobian.transpose() * jacobian;
  const Eigen::Vector3d weight = -m * jacobian.transpose() * robot.gravity;
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(loaded.bias(Joints{})[i] - bare.bias(Joints{})[i], weight(i), 1e-8);
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(loaded.massMatrix()[i][j] - bare.massMatrix()[i][j], added(i, j), 1e-8);
  }
}

TEST(RigidChain, SolvesSymmetricSystems) {
  base::Random random(5);
  for (int n = 1; n <= 7; ++n) {
    const Eigen::MatrixXd root =
        Eigen::MatrixXd::NullaryExpr(n, n, [&] { return random.uniform(-1.0, 1.0); });
    const Eigen::MatrixXd a = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
    RigidChain::Matrix matrix{};
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) matrix[i][j] = a(i, j);
    const Joints b = randomJoints(random, n, 1.0), x = solveSymmetric(matrix, b, n);
    const Eigen::VectorXd desired = a.llt().solve(Eigen::VectorXd(vectorOf(b, n)));
    for (int i = 0; i < n; ++i) EXPECT_NEAR(x[i], desired(i), 1e-9 * (1.0 + desired.norm()));
  }
}

}  // namespace
}  // namespace capstan::test
