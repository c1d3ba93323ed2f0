// Bodies and numbers of a chain as the kernels have them, against the dynamics by composite bodies.
#include "core/robot/chain/chain_bodies.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "core/base/error.h"
#include "core/robot/chain/chain_state.h"
#include "core/robot/chain_dynamics.h"
#include "core/robot/fold_effects.h"
#include "core/robot/transmission.h"
#include "tests/core/robot/driven_chains.h"

namespace capstan::robot {
namespace {

struct Bodies {
  JointMatrix mass;
  JointVector bias;
};

Bodies bodiesOf(const ChainModel& model, const JointVector& q, const JointVector& dq) {
  const int n = model.shape.joints;
  ChainBodies<double> bodies;
  chainBodies<double>(model.shape, model.numbers, q.data(), dq.data(), bodies);
  Bodies result{JointMatrix(n, n), JointVector(n)};
  for (int i = 0; i < n; ++i) {
    result.bias[i] = bodies.bias[i];
    for (int j = 0; j < n; ++j) result.mass(i, j) = bodies.mass[i][j];
  }
  return result;
}

void expectBodiesOf(const ChainModel& model, const Description& robot, base::Random& random) {
  const ChainDynamics dynamics(robot);
  for (int k = 0; k < 20; ++k) {
    JointVector q(robot.size()), dq(robot.size());
    for (int i = 0; i < robot.size(); ++i)
      q[i] = random.uniform(-2.0, 2.0), dq[i] = random.uniform(-2.0, 2.0);
    const Bodies bodies = bodiesOf(model, q, dq);
    const JointMatrix mass = dynamics.massMatrix(q);
    const JointVector bias = dynamics.bias(q, dq);
    EXPECT_LT((bodies.mass - mass).norm(), 1e-12 * mass.norm());
    EXPECT_LT((bodies.bias - bias).norm(), 1e-12 * (1.0 + bias.norm()));
    EXPECT_EQ(bodies.mass, JointMatrix(bodies.mass.transpose()));
  }
}

class ChainOf : public ::testing::TestWithParam<int> {
 protected:
  base::Random random_{static_cast<std::uint64_t>(100 + GetParam())};
};
INSTANTIATE_TEST_SUITE_P(Joints, ChainOf, ::testing::Range(1, 8));

TEST_P(ChainOf, massAndBiasAreThoseOfCompositeBodies) {
  for (const DriveType drive : {DriveType::kCable, DriveType::kRigid}) {
    const Description robot = testing::drivenRobot(random_, GetParam(), drive);
    expectBodiesOf(ChainModel(robot), robot, random_);
  }
}

TEST_P(ChainOf, factorsSolve) {
  const ChainModel model(testing::drivenRobot(random_, GetParam()));
  const int n = GetParam();
  const JointVector zero = JointVector::Zero(n);
  JointVector b(n);
  for (double& x : b) x = random_.uniform(-1.0, 1.0);
  ChainBodies<double> bodies;
  chainBodies<double>(model.shape, model.numbers, zero.data(), zero.data(), bodies);
  const JointVector expected = bodiesOf(model, zero, zero).mass.llt().solve(b);
  factorise<double>(n, bodies.mass);
  solve<double>(n, bodies.mass, b.data());
  EXPECT_LT((b - expected).norm(), 1e-10 * expected.norm());
}

TEST_P(ChainOf, motorsPlaceTheJoints) {
  const Description robot = testing::drivenRobot(random_, GetParam());
  JointVector q_m(GetParam());
  for (double& x : q_m) x = random_.uniform(-100.0, 100.0);
  const JointVector expected = Transmission(robot).jointFromMotor(q_m);
  EXPECT_LT((jointsFromMotors(ChainModel(robot), q_m) - expected).norm(), 1e-12 * expected.norm());
}

TEST(ChainBodies, ravenIsItself) {
  for (const char* side : {"left", "right"}) {
    base::Random random(7);
    const Description robot = testing::raven(side);
    expectBodiesOf(ChainModel(robot), robot, random);
  }
}

TEST(ChainNumbers, aPayloadIsAPointMassAtTheMarker) {
  base::Random random(8);
  const Description robot = testing::drivenRobot(random, 4);
  ChainModel model(robot);
  model.add({"payload", 0, {{"mass", 0.7}}});
  JointVector q(4), dq(4);
  for (int i = 0; i < 4; ++i) q[i] = random.uniform(-1.0, 1.0), dq[i] = random.uniform(-1.0, 1.0);
  const ChainDynamics before(robot);
  const Bodies bodies = bodiesOf(model, q, dq);
  // Kinetic energy and gravity by the marker's motion.
  const Chain chain(robot);
  const Eigen::Vector3d speed = chain.markerJacobian(q).bottomRows<3>() * dq;
  EXPECT_NEAR(0.5 * dq.dot(bodies.mass * dq), before.kineticEnergy(q, dq) + 0.35 * speed.squaredNorm(),
              1e-12);
  const JointVector still = JointVector::Zero(4);
  const JointVector weight =
      before.bias(q, still) - chain.markerJacobian(q).bottomRows<3>().transpose() * (0.7 * robot.gravity);
  EXPECT_LT((bodiesOf(model, q, still).bias - weight).norm(), 1e-12 * weight.norm());
}

TEST(ChainNumbers, aTiltTurnsGravityAlone) {
  base::Random random(9);
  Description robot = testing::drivenRobot(random, 3);
  ChainModel model(robot);
  model.add({"gravity_tilt", 0, {{"x", 0.0}, {"y", 0.0}, {"z", 0.3}}});
  const Eigen::Vector3d g = robot.gravity;
  robot.gravity = {std::cos(0.3) * g[0] - std::sin(0.3) * g[1], std::sin(0.3) * g[0] + std::cos(0.3) * g[1],
                   g[2]};
  expectBodiesOf(model, robot, random);
}

TEST(ChainNumbers, aMotorsZeroMovesItsOwnCableAlone) {
  base::Random random(11);
  Description robot = testing::drivenRobot(random, 3);
  const ChainModel before(robot);
  robot.effects = {{"homing_offset", 2, {{"offset", 0.02}, {"at_motor", 1.0}}},
                   {"cable_coupling", 3, {{"added", 0.3}, {"other", 2.0}}}};
  ChainModel after(robot);
  std::swap(robot.effects[0], robot.effects[1]);  // the order in a file does not matter
  const ChainModel swapped(robot);
  const JointVector q = JointVector::Constant(3, 0.1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(after.numbers.joints[i].homing, swapped.numbers.joints[i].homing);
    ChainModel coupled = before;
    coupled.add({"cable_coupling", 3, {{"added", 0.3}, {"other", 2.0}}});
    const double moved = stretchAt(after, i, 0.0, q) - stretchAt(coupled, i, 0.0, q);
    const double lever = before.numbers.joints[i].link_radius * before.numbers.coupling[i][i];
    EXPECT_NEAR(moved, i == 1 ? lever * 0.02 : 0.0, 1e-15) << i;
  }
  const Description folded = foldEffects(robot);
  EXPECT_TRUE(folded.effects.empty());
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_DOUBLE_EQ(folded.joints[i].homing, after.numbers.joints[static_cast<int>(i)].homing);
}

TEST(ChainNumbers, effectsGoWhereTheyBelong) {
  base::Random random(10);
  const Description robot = testing::drivenRobot(random, 3);
  const JointNumbers<double> was = ChainModel(robot).numbers.joints[1];
  Description extended = robot;
  extended.effects = {{"pulley_radius", 2, {{"share", 0.1}}},
                      {"homing_offset", 2, {{"offset", 0.02}}},
                      {"cable_coupling", 2, {{"added", 0.3}, {"other", 3.0}}},
                      {"cable_compliance", 2, {{"compliance", 1e-5}}},
                      {"slack", 2, {{"pretension", 1e-3}}},
                      {"cable_creep", 2, {{"share", 0.4}, {"time_constant", 5.0}}},
                      {"position_friction", 2, {{"sine", 0.1}, {"cosine", 0.2}, {"period", 0.5}}},
                      {"inertia", 2, {{"added", 0.01}}},
                      {"sensor_sign", 2, {{"present", 1.0}}}};
  const ChainModel model(extended);
  const JointNumbers<double>& is = model.numbers.joints[1];
  EXPECT_DOUBLE_EQ(is.link_radius, 1.1 * was.link_radius);
  EXPECT_DOUBLE_EQ(is.homing, was.homing + 0.02);
  EXPECT_DOUBLE_EQ(model.numbers.coupling[1][2], robot.coupling[1][2] + 0.3);
  // Two springs behind each other: 1 / (2 k a) + c.
  EXPECT_NEAR(1.0 / (2.0 * is.stiffness * is.exponent), 1.0 / (2.0 * was.stiffness * was.exponent) + 1e-5,
              1e-18);
  EXPECT_EQ(is.pretension, 1e-3);
  EXPECT_DOUBLE_EQ(is.creep_rate, 0.2);
  EXPECT_DOUBLE_EQ(is.wave_number, 4.0 * 3.14159265358979323846);
  EXPECT_EQ(is.armature, 0.01);
  EXPECT_EQ(is.load_sign, 1.0);
  constexpr unsigned kOwn = kLawExponential;  // of this robot's cables
  EXPECT_EQ(model.shape.laws[1] & ~kOwn, static_cast<unsigned>(kLawSlack | kLawCreep | kLawWave));
  EXPECT_EQ(model.shape.laws[0] & ~kOwn, 0U);
  EXPECT_EQ(model.numbers.joints[0].stiffness, ChainModel(robot).numbers.joints[0].stiffness);
  const JointVector q = JointVector::Zero(3);
  EXPECT_NEAR(massMatrix(model, q)(1, 1), massMatrix(ChainModel(robot), q)(1, 1) + 0.01, 1e-14);
}

TEST(ChainNumbers, camerasTellASimilarity) {
  ChainModel model(testing::raven());
  model.add({"camera_rotation", 0, {{"x", 0.0}, {"y", 0.2}, {"z", 0.0}}});
  model.add({"camera_offset", 0, {{"x", 1e-3}, {"y", 2e-3}, {"z", 3e-3}}});
  model.add({"camera_scale", 0, {{"share", 0.01}}});
  model.add({"camera_latency", 0, {{"delay", 0.03}}});
  const Eigen::Vector3d told = model.camera.measure({0.1, 0.2, 0.3});
  EXPECT_NEAR(told[0], 1.01 * (std::cos(0.2) * 0.1 + std::sin(0.2) * 0.3) + 1e-3, 1e-15);
  EXPECT_NEAR(told[1], 1.01 * 0.2 + 2e-3, 1e-15);
  EXPECT_NEAR(told[2], 1.01 * (std::cos(0.2) * 0.3 - std::sin(0.2) * 0.1) + 3e-3, 1e-15);
  EXPECT_EQ(model.camera.delay, 0.03);
}

TEST(ChainNumbers, whatItCannotHaveIsRefused) {
  ChainModel model(testing::raven());
  EXPECT_THROW(model.add({"rust", 1, {}}), base::InputError);
  EXPECT_THROW(model.add({"backlash", 4, {{"half_width", 1e-4}}}), base::InputError);
  EXPECT_THROW(model.add({"backlash", 0, {{"half_width", 1e-4}}}), base::InputError);
  EXPECT_THROW(model.add({"backlash", 1, {{"width", 1e-4}}}), base::InputError);
  EXPECT_THROW(model.add({"cable_coupling", 1, {{"added", 0.1}, {"other", 9.0}}}), base::InputError);
}

}  // namespace
}  // namespace capstan::robot
