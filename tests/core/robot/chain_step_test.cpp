// A row's step against an integration of its own: finer steps, the mass matrix of composite bodies at every
// stage, cables and motors by the transmission's matrices.
#include "core/robot/chain/chain_step.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "core/math/rk4.h"
#include "core/robot/chain_dynamics.h"
#include "core/robot/transmission.h"
#include "tests/core/robot/driven_chains.h"

namespace capstan::robot {
namespace {

using Eigen::VectorXd;

/// The nominal robot, optionally with a linear cable of `compliance` behind each motor of a rigid drive.
class Reference {
 public:
  Reference(const Description& robot, double compliance)
      : robot_(robot), dynamics_(robot), transmission_(robot), compliance_(compliance) {}

  /// x = [q dq (q_m dq_m)] over one row.
  VectorXd advance(const ChainInput& input, VectorXd x) const {
    constexpr int kSteps = 40;
    const double h = input.dt / kSteps;
    const auto slope = [&](double t, const VectorXd& at) { return derivative(input, t / input.dt, at); };
    for (int k = 0; k < kSteps; ++k) x = math::rk4Step(slope, k * h, x, h);
    return x;
  }

 private:
  static double smooth(const Friction& f, double v) {
    return f.coulomb * std::tanh(v / f.smoothing) + f.viscous * v;
  }

  VectorXd derivative(const ChainInput& input, double fraction, const VectorXd& x) const {
    const int n = robot_.size();
    const bool rigid = robot_.drive == DriveType::kRigid;
    const JointVector q = x.head(n), dq = x.segment(n, n);
    JointMatrix mass = dynamics_.massMatrix(q);
    JointVector gamma(n), load(n);
    VectorXd dx = VectorXd::Zero(x.size());
    const JointVector travel = transmission_.linkTravel(q), speed = transmission_.linkTravelRate(dq);
    for (int i = 0; i < n; ++i) {
      const Drive& drive = robot_.drives[static_cast<std::size_t>(i)];
      const double lever = transmission_.motorRadius()[i];
      load[i] = input.load[i] - smooth(robot_.joints[static_cast<std::size_t>(i)].friction, dq[i]);
      if (!rigid) {
        const double rate = (input.motor_end[i] - input.motor[i]) / input.dt;
        const double stretch = lever * (input.motor[i] + fraction * input.dt * rate) - travel[i];
        gamma[i] = drive.cable_stiffness * (std::exp(drive.cable_exponent * stretch) -
                                            std::exp(-drive.cable_exponent * stretch)) +
                   2.0 * drive.cable_damping * (lever * rate - speed[i]);
      } else if (compliance_ > 0.0) {
        const double q_m = x[2 * n + i], dq_m = x[3 * n + i], k = 1.0 / compliance_;
        gamma[i] = k * (lever * q_m - travel[i]) +
                   0.2 / lever * std::sqrt(k * drive.motor_inertia) * (lever * dq_m - speed[i]);
        dx[2 * n + i] = dq_m;
        dx[3 * n + i] =
            (input.torque[i] - smooth(drive.motor_friction, dq_m) - lever * gamma[i]) / drive.motor_inertia;
      } else {  // the motor turns with the joints: its inertia is theirs
        gamma[i] = (input.torque[i] - smooth(drive.motor_friction, speed[i] / lever)) / lever;
        const JointVector row =
            transmission_.linkRadius()[i] / lever * transmission_.coupling().row(i).transpose();
        mass += drive.motor_inertia * row * row.transpose();
      }
    }
    const JointVector torque = transmission_.jointTorque(gamma) + load - dynamics_.bias(q, dq);
    dx.head(n) = dq;
    dx.segment(n, n) = mass.llt().solve(torque);
    return dx;
  }

  Description robot_;
  ChainDynamics dynamics_;
  Transmission transmission_;
  double compliance_;
};

enum class Kind { kCable, kRigid, kCompliant };

class StepOf : public ::testing::TestWithParam<std::tuple<int, Kind>> {
 protected:
  static constexpr double kCompliance = 2e-5;
  StepOf() : random_(static_cast<std::uint64_t>(30 + std::get<0>(GetParam()))) {
    const Kind kind = std::get<1>(GetParam());
    robot_ = testing::drivenRobot(random_, std::get<0>(GetParam()),
                                  kind == Kind::kCable ? DriveType::kCable : DriveType::kRigid);
    extended_ = robot_;
    for (int j = 1; kind == Kind::kCompliant && j <= robot_.size(); ++j)
      extended_.effects.push_back({"cable_compliance", j, {{"compliance", kCompliance}}});
  }

  /// Largest distance from the reference at any row, of rows 1 / `parts` as long.
  double farthest(int parts) const {
    const ChainModel model(extended_);
    const bool compliant = std::get<1>(GetParam()) == Kind::kCompliant;
    const Reference reference(robot_, compliant ? kCompliance : 0.0);
    const testing::DrivenRows rows(model, 301);
    const JointVector q = rows.start(model);
    ChainState<double> state = stateAt(model, q, JointVector::Zero(robot_.size()));
    const int n = robot_.size(), finer = model.shape.rigid ? 1 : 2;
    const int steps = finer * testing::stableSteps(model, q);  // so that the error of the bodies dominates
    VectorXd x = VectorXd::Zero((compliant ? 4 : 2) * n);
    x.head(n) = q;
    for (int i = 0; compliant && i < n; ++i) x[2 * n + i] = state.motor[i];
    ChainStep<double> step(model.shape, model.numbers);
    double most = 0.0;
    for (std::size_t k = 0; k + 1 < rows.t.size(); ++k) {
      const ChainInput whole = rows.at(model.shape, k);
      x = reference.advance(whole, x);
      for (int part = 0; part < parts; ++part) {
        ChainInput input = whole;
        input.t += part * whole.dt / parts, input.dt /= parts;
        for (int i = 0; i < n; ++i) {
          const double way = (whole.motor_end[i] - whole.motor[i]) / parts;
          input.motor[i] += part * way, input.motor_end[i] = input.motor[i] + way;
        }
        step.advance(input, steps, state);
      }
      for (int i = 0; i < n; ++i) most = std::max(most, std::abs(state.q[i] - x[i]));
    }
    return most;
  }

  base::Random random_{0};
  Description robot_, extended_;
};

INSTANTIATE_TEST_SUITE_P(Chains, StepOf,
                         ::testing::Combine(::testing::Values(1, 2, 3, 5, 7),
                                            ::testing::Values(Kind::kCable, Kind::kRigid, Kind::kCompliant)));

/// What is left is of first order in the row's length, for bodies stand still over a row: 0.3 s of lively
/// motion stay within 1e-5 times the joints' number squared, half of that with rows half as long.
TEST_P(StepOf, isTheMotionOfTheSameRobotElsewhere) {
  const double whole = farthest(1), half = farthest(2);
  fmt::print("largest distance {:.2e}, with half rows {:.2e} [rad or m]\n", whole, half);
  EXPECT_LT(whole, 1e-5 * robot_.size() * robot_.size());
  EXPECT_LT(half, 1e-9 + whole / 1.8);
}

JointVector jointsOf(const ChainState<double>& state, int n) {
  return Eigen::Map<const VectorXd>(state.q, n);
}

TEST(ChainStep, motorsAtRestOnlyTakeEnergyAway) {
  base::Random random(41);
  for (int n = 1; n <= 7; n += 2) {
    const Description robot = testing::drivenRobot(random, n);
    const ChainModel model(robot);
    const ChainDynamics dynamics(robot);
    const Transmission transmission(robot);
    const auto energy = [&](const ChainState<double>& state) {
      const JointVector q = jointsOf(state, n), dq = Eigen::Map<const VectorXd>(state.dq, n);
      double elastic = 0.0;
      const JointVector stretch = -transmission.linkTravel(q);
      for (int i = 0; i < n; ++i) {
        const Drive& cable = robot.drives[static_cast<std::size_t>(i)];
        elastic += 2.0 * cable.cable_stiffness / cable.cable_exponent *
                   (std::cosh(cable.cable_exponent * stretch[i]) - 1.0);
      }
      return dynamics.kineticEnergy(q, dq) + dynamics.potentialEnergy(q) + elastic;
    };
    ChainInput still;
    still.dt = 1e-3;
    JointVector q(n);
    for (int i = 0; i < n; ++i) q[i] = transmission.homing()[i] + random.uniform(-0.1, 0.1);
    ChainState<double> state = stateAt(model, q, JointVector::Zero(n));
    ChainStep<double> step(model.shape, model.numbers);
    const double first = energy(state);
    double before = first;
    const int steps = 4 * testing::stableSteps(model, q);  // of second order
    for (int k = 0; k < 2000; ++k) {
      step.advance(still, steps, state);
      const double now = energy(state);
      EXPECT_LT(now, before + 1e-5 * std::abs(first)) << n << " joints, row " << k;
      before = now;
    }
    EXPECT_LT(before, first);
  }
}

/// Largest magnitude of an eigenvalue of the chain linearised at rest.
double fastestMode(const ChainModel& model, const JointVector& q, const ChainInput& input) {
  const int n = model.shape.joints;
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  jacobian.topRightCorner(n, n).setIdentity();
  ChainStep<double> step(model.shape, model.numbers);
  const ChainState<double> rest = stateAt(model, q, JointVector::Zero(n));
  constexpr double kStep = 1e-6;
  for (int column = 0; column < 2 * n; ++column)
    for (const double sign : {1.0, -1.0}) {
      ChainState<double> moved = rest;
      (column < n ? moved.q[column] : moved.dq[column - n]) += sign * kStep;
      step.look(input, moved);
      jacobian.col(column).tail(n) +=
          sign / (2.0 * kStep) * Eigen::Map<const VectorXd>(step.acceleration(), n);
    }
  return Eigen::EigenSolver<Eigen::MatrixXd>(jacobian, false).eigenvalues().cwiseAbs().maxCoeff();
}

TEST(ChainStep, noModeIsFasterThanTheRate) {
  base::Random random(42);
  double slowest = 1.0;
  for (int n = 1; n <= 7; ++n)
    for (int k = 0; k < 20; ++k) {
      const Description robot = testing::drivenRobot(random, n);
      const ChainModel model(robot);
      const JointVector q = Transmission(robot).homing();
      ChainInput still;
      still.dt = 1e-9;
      const double fastest = fastestMode(model, q, still), rate = chainRate(model, q);
      EXPECT_LT(fastest, 1.02 * rate);  // gravity
      slowest = std::min(slowest, fastest / rate);
    }
  fmt::print("the fastest mode is down to {:.2f} of the rate\n", slowest);
  EXPECT_GT(slowest, 0.2);  // so that steps are not needlessly short
}

TEST(ChainStep, aRunawayEndsAtTheBox) {
  base::Random random(43);
  const ChainModel model(testing::drivenRobot(random, 3, DriveType::kRigid));
  ChainState<double> state = stateAt(model, JointVector::Zero(3), JointVector::Zero(3));
  ChainInput thrust;
  thrust.dt = 1e-3;
  for (double& torque : thrust.torque) torque = 1e9;
  ChainStep<double> step(model.shape, model.numbers);
  for (int k = 0; k < 2000; ++k) step.advance(thrust, 1, state);
  bool at_face = false;
  for (int i = 0; i < 3; ++i) {
    const double from = std::abs(state.q[i] - model.shape.middle[i]);
    EXPECT_LE(from, model.shape.farthest[i] * (1.0 + 1e-12));
    EXPECT_LE(std::abs(state.dq[i]), model.shape.fastest[i]);
    at_face |= from > 0.999 * model.shape.farthest[i];
  }
  EXPECT_TRUE(at_face);
}

/// Accelerations at rest at the stop, `t` after the begin of the recording, with unstretched nominal cables.
JointVector accelerationsAt(double t, const Description& robot, const Effect& effect, const JointVector& q) {
  Description extended = robot;
  extended.effects = {effect};
  const ChainModel model(extended);
  ChainInput input;
  input.t = t, input.dt = 1e-6;
  ChainStep<double> step(model.shape, model.numbers);
  step.look(input, stateAt(model, q, JointVector::Zero(robot.size())));
  return Eigen::Map<const VectorXd>(step.acceleration(), robot.size());
}

JointVector accelerationsAt(double t, const Description& robot, const Effect& effect) {
  return accelerationsAt(t, robot, effect, Transmission(robot).homing());
}

/// With cables coupled: whatever the time, cable 2 is as if the robot had been homed where cable 2 alone is
/// shifted, A Δq_hs = (0, A_22 by, 0), and its damper feels how fast it moves on.
TEST(ChainStep, aZeroThatDriftsShiftsItsCableAlone) {
  base::Random random(45);
  Description robot = testing::drivenRobot(random, 3);
  for (Drive& drive : robot.drives) drive.cable_damping = 0.0;
  const Effect drift{"zero_drift", 2, {{"drift", 1e-3}, {"time_constant", 4.0}}};
  const JointVector none = accelerationsAt(1.0, robot, {"inertia", 2, {{"added", 0.0}}});
  for (const double t : {0.0, 1.0, 4.0, 400.0}) {
    const double by = 1e-3 * (1.0 - std::exp(-t / 4.0));
    Description shifted = robot;
    Eigen::Matrix3d coupling;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        coupling(i, j) = robot.coupling[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    const Eigen::Vector3d moved = coupling.inverse().col(1) * (coupling(1, 1) * by);
    for (std::size_t j = 0; j < 3; ++j) shifted.joints[j].homing += moved[static_cast<Eigen::Index>(j)];
    const JointVector expected =
        accelerationsAt(t, shifted, {"inertia", 2, {{"added", 0.0}}}, Transmission(robot).homing());
    EXPECT_LT((accelerationsAt(t, robot, drift) - expected).norm(), 1e-6 * expected.norm()) << t;
    EXPECT_EQ((expected - none).norm() > 0.1, t > 0.0) << t;
  }
  const Effect fast{"zero_drift", 2, {{"drift", 1e-3}, {"time_constant", 0.01}}};
  const JointVector undamped = accelerationsAt(0.0, robot, fast);
  robot.drives[1].cable_damping = 50.0;  // 2 b r_l dq_hs/dt, by r_l: a torque at joint 2 and what is coupled
  const Drive& drive = robot.drives[1];
  JointVector lever(3);
  for (int j = 0; j < 3; ++j) lever[j] = drive.link_radius * robot.coupling[1][static_cast<std::size_t>(j)];
  const JointVector pushed = massMatrix(ChainModel(robot), Transmission(robot).homing())
                                 .ldlt()
                                 .solve(lever * (2.0 * 50.0 * lever[1] * 1e-3 / 0.01));
  EXPECT_LT((accelerationsAt(0.0, robot, fast) - undamped - pushed).norm(), 1e-3 * pushed.norm());
}

TEST(ChainStep, aSensorThatTellsMagnitudeIsGivenItsSigns) {
  base::Random random(44);
  Description robot = testing::drivenRobot(random, 2);
  robot.effects = {{"sensor_sign", 1, {{"present", 1.0}}}};
  const ChainModel model(robot);
  const JointVector q = Transmission(robot).homing();
  ChainInput input;
  input.dt = 1e-3;
  const auto accelerations = [&](double load, double told) {
    input.load[0] = load, input.signed_load[0] = told;
    ChainStep<double> step(model.shape, model.numbers);
    step.look(input, stateAt(model, q, JointVector::Zero(2)));
    return JointVector(Eigen::Map<const VectorXd>(step.acceleration(), 2));
  };
  const JointVector none = accelerations(0.0, 0.0), pushed = accelerations(2.0, -2.0);
  const JointVector expected = -2.0 * massMatrix(model, q).inverse().col(0);
  EXPECT_LT((pushed - none - expected).norm(), 1e-9 * expected.norm());
  robot.effects.front().values.front().value = -1.0;  // the first load pushed the other way
  const ChainModel other(robot);
  ChainStep<double> step(other.shape, other.numbers);
  input.load[0] = 2.0, input.signed_load[0] = 2.0;
  step.look(input, stateAt(other, q, JointVector::Zero(2)));
  const JointVector turned = Eigen::Map<const VectorXd>(step.acceleration(), 2);
  EXPECT_LT((turned - none - expected).norm(), 1e-9 * expected.norm());
}

}  // namespace
}  // namespace capstan::robot
