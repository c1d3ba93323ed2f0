#include "core/simulation/plant.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "core/robot/transmission.h"
#include "tests/core/simulation/simulated_robot.h"

namespace capstan::simulation {
namespace {

using Vector3d = Eigen::Vector3d;

/// Motor torque of a lively movement at t [N·m].
Vector3d pull(double t) {
  return {0.12 + 0.15 * std::sin(9.0 * t), 0.05 + 0.12 * std::cos(7.0 * t), 0.1 + 0.2 * std::sin(11.0 * t)};
}

Vector3d motorsAt(const Vector3d& q) { return robot::Transmission(raven()).motorFromJoint(q); }
const Vector3d kPose{0.6, 1.6, 0.32};

std::vector<PlantState> play(const Truth& truth, double seconds) {
  Plant plant(raven(), truth);
  plant.reset(motorsAt(kPose));
  std::vector<PlantState> states;
  for (int k = 0; k < static_cast<int>(std::lround(seconds * 1e3)); ++k) {
    plant.step(pull(1e-3 * k), 1e-3);
    states.push_back(plant.state());
  }
  return states;
}

/// Largest difference of joint positions, [rad] and [m] alike.
double apart(const std::vector<PlantState>& a, const std::vector<PlantState>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, (a[i].q_link - b[i].q_link).cwiseAbs().maxCoeff());
  return largest;
}

/// Joint position at rest after `seconds` with the motors held at the pose by stiff PD control.
Vector3d heldAt(const Truth& truth, const Vector3d& target, double seconds = 1.0) {
  Plant plant(raven(), truth);
  const Vector3d q_motor = motorsAt(target);
  plant.reset(q_motor);
  for (int k = 0; k < static_cast<int>(seconds * 1e3); ++k)
    plant.step(20.0 * (q_motor - plant.state().q_motor) - 0.1 * plant.state().dq_motor, 1e-3);
  return plant.state().q_link;
}

/// The equations of the UKF paper (2–8) for a robot without any deviation from its robot file, written down
/// once more and compared with the plant step by step: mass matrix column by column from inverse dynamics,
/// every constant from the robot file, one scalar loop a joint.
class TextbookRobot {
 public:
  explicit TextbookRobot(const robot::Description& robot) : robot_(robot), body_(robot) {}

  using State = Eigen::Matrix<double, 12, 1>;  // q_m, dq_m, q, dq
  State rate(const State& x, const Vector3d& tau) const {
    const Vector3d q = x.segment<3>(6), dq = x.segment<3>(9), none = Vector3d::Zero();
    State dx;
    Vector3d torque = none;
    for (std::size_t i = 0; i < 3; ++i) {
      const robot::Drive& drive = robot_.drives[i];
      const auto row = static_cast<Eigen::Index>(i);
      double travel = 0.0, speed = 0.0;
      for (std::size_t j = 0; j < 3; ++j) {
        travel += drive.link_radius * robot_.coupling[i][j] * (q[Eigen::Index(j)] - robot_.joints[j].homing);
        speed += drive.link_radius * robot_.coupling[i][j] * dq[Eigen::Index(j)];
      }
      const double arm = drive.motor_capstan_radius / drive.gear_ratio;
      const double delta = arm * x[row] - travel, ddelta = arm * x[3 + row] - speed, a = drive.cable_exponent;
      const double gamma = drive.cable_stiffness * (std::exp(a * delta) - std::exp(-a * delta)) +
                           2.0 * drive.cable_damping * ddelta;
      const robot::Friction& f = drive.motor_friction;
      dx[row] = x[3 + row];
      dx[3 + row] = (tau[row] - f.coulomb * std::tanh(x[3 + row] / f.smoothing) - f.viscous * x[3 + row] -
                     arm * gamma) /
                    drive.motor_inertia;
      for (std::size_t j = 0; j < 3; ++j)
        torque[Eigen::Index(j)] += robot_.coupling[i][j] * drive.link_radius * gamma;
      const robot::Friction& g = robot_.joints[i].friction;
      torque[row] -= g.coulomb * std::tanh(dq[row] / g.smoothing) + g.viscous * dq[row];
    }
    const Vector3d bias = body_.inverse<double>(q, dq, none), weight = body_.inverse<double>(q, none, none);
    Eigen::Matrix3d mass;
    for (int j = 0; j < 3; ++j) mass.col(j) = body_.inverse<double>(q, none, Vector3d::Unit(j)) - weight;
    dx.segment<3>(6) = dq;
    dx.segment<3>(9) = mass.ldlt().solve(torque - bias);
    return dx;
  }

 private:
  robot::Description robot_;
  robot::ArmDynamics body_;
};

TEST(Plant, MatchedAgreesWithAnIndependentIntegrationAtAFinerStep) {
  const TextbookRobot textbook(raven());
  const std::vector<PlantState> plant = play(Truth{}, 0.25);
  TextbookRobot::State x = TextbookRobot::State::Zero();
  x.segment<3>(0) = motorsAt(kPose);
  x.segment<3>(6) = kPose;
  constexpr int kSteps = 200;  // of 5 µs a millisecond
  const double h = 1e-3 / kSteps;
  double joints = 0.0, motors = 0.0;
  for (std::size_t k = 0; k < plant.size(); ++k) {
    const Vector3d tau = pull(1e-3 * static_cast<double>(k));
    for (int i = 0; i < kSteps; ++i) {
      const auto k1 = textbook.rate(x, tau), k2 = textbook.rate(x + 0.5 * h * k1, tau);
      const auto k3 = textbook.rate(x + 0.5 * h * k2, tau), k4 = textbook.rate(x + h * k3, tau);
      x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    joints = std::max(joints, (x.segment<3>(6) - plant[k].q_link).cwiseAbs().maxCoeff());
    motors = std::max(motors, (x.segment<3>(0) - plant[k].q_motor).cwiseAbs().maxCoeff());
  }
  RecordProperty("joints", std::to_string(1e9 * joints) + "e-9");
  EXPECT_GT((plant.back().q_link - kPose).norm(), 0.01);  // it did move
  EXPECT_LT(joints, 1e-7);
  EXPECT_LT(motors, 1e-6);
}

TEST(Plant, HalvingTheStepChangesNothingThatMatters) {
  Truth fine = defaultTruth(), finer = defaultTruth();
  fine.substeps = 20;
  finer.substeps = 80;
  const auto used = play(defaultTruth(), 1.0), half = play(fine, 1.0), reference = play(finer, 1.0);
  RecordProperty("used_by_half", std::to_string(1e9 * apart(used, half)) + "e-9");
  EXPECT_LT(apart(used, half), 1e-6);
  EXPECT_LT(apart(half, reference), 0.5 * apart(used, reference));
}

TEST(Plant, RestsWhereUnstretchedCablesPutIt) {
  Plant plant(raven(), Truth{});
  plant.reset(motorsAt(kPose));
  EXPECT_LT((plant.state().q_link - kPose).norm(), 1e-12);
  EXPECT_LT(plant.cableForce().norm(), 1e-6);
}

TEST(Plant, SmallerPulleyTurnsTheJointFurther) {
  Truth truth;
  truth.joints[0].link_radius = 0.059;
  Plant plant(raven(), truth);
  plant.reset(motorsAt(kPose));
  const double nominal = raven().drives[0].link_radius;
  EXPECT_NEAR(plant.state().q_link[0], kPose[0] * nominal / 0.059, 1e-12);
}

TEST(Plant, AgedCablesSagFurtherUnderGravity) {
  Truth soft;
  for (JointTruth& joint : soft.joints) joint.stiffness_factor = 0.5;
  const Vector3d stiff_sag = heldAt(Truth{}, kPose) - kPose, soft_sag = heldAt(soft, kPose) - kPose;
  EXPECT_GT(stiff_sag.cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_GT(std::abs(soft_sag[2]), 1.3 * std::abs(stiff_sag[2]));
}

TEST(Plant, WeakerDampingRingsLonger) {
  const auto ringing = [](double factor) {
    Truth truth;
    for (JointTruth& joint : truth.joints) joint.damping_factor = factor;
    robot::Description smooth = raven();
    for (robot::Joint& joint : smooth.joints) joint.friction.coulomb = 0.0;
    Plant plant(smooth, truth);
    PlantState state;
    state.q_motor = motorsAt(kPose);
    state.q_link = kPose + Vector3d(0.0, 0.01, 0.0);
    plant.setState(state);
    double travelled = 0.0, last = state.q_link[1];
    for (int k = 0; k < 60; ++k) {
      plant.step(Vector3d::Zero(), 1e-3);
      travelled += std::abs(plant.state().q_link[1] - last);
      last = plant.state().q_link[1];
    }
    return travelled;
  };
  EXPECT_GT(ringing(0.05), 1.2 * ringing(1.0));
}

TEST(Plant, HysteresisStaysWithinItsYieldAndDissipates) {
  Truth truth;
  truth.joints[1].hysteresis = {40e3, 1e-4, 1.0, 0.5};
  Plant plant(raven(), truth);
  plant.reset(motorsAt(kPose));
  double work = 0.0, largest = 0.0;
  const robot::Transmission transmission(raven());
  const auto stretch = [&](const PlantState& s) {
    return transmission.motorTravel(s.q_motor)[1] - transmission.linkTravel(s.q_link)[1];
  };
  for (int k = 0; k < 4000; ++k) {  // two whole periods
    const PlantState before = plant.state();
    plant.step({0.1, 0.5 * std::sin(3.14159265 * 1e-3 * k), 0.1}, 1e-3);
    const PlantState& after = plant.state();
    work += 40e3 * 0.5 * (before.hysteresis[1] + after.hysteresis[1]) * (stretch(after) - stretch(before));
    largest = std::max(largest, std::abs(after.hysteresis[1]));
  }
  EXPECT_LE(largest, 1e-4);
  EXPECT_GT(largest, 1e-6);
  EXPECT_GT(work, 0.0);
  EXPECT_EQ(plant.state().hysteresis[0], 0.0);
  EXPECT_GT(apart(play(truth, 0.5), play(Truth{}, 0.5)), 1e-6);
}

TEST(Plant, StribeckFrictionHoldsASlowJointBack) {
  Truth sticky;
  sticky.joints[2].stribeck = {2.0, 0.01};
  const auto slide = [](const Truth& truth) {  // the insertion falls by its weight through a freed drive
    Plant plant(raven(), truth);
    plant.reset(motorsAt(kPose));
    for (int k = 0; k < 300; ++k) plant.step({0.1, 0.05, 0.0}, 1e-3);
    return std::abs(plant.state().q_link[2] - kPose[2]);
  };
  EXPECT_GT(slide(Truth{}), 0.0);
  EXPECT_LT(slide(sticky), slide(Truth{}));
}

TEST(Plant, TorqueIsCutAtTheLimit) {
  Truth weak;
  weak.joints[0].torque_limit_factor = 0.1;
  const Plant nominal(raven(), Truth{});
  Plant plant(raven(), weak), limited(raven(), weak);
  EXPECT_NEAR(plant.torqueLimit()[0], 0.1 * nominal.torqueLimit()[0], 1e-15);
  plant.reset(motorsAt(kPose));
  limited.reset(motorsAt(kPose));
  for (int k = 0; k < 100; ++k) {
    plant.step({5.0, 0.0, 0.0}, 1e-3);
    limited.step({plant.torqueLimit()[0], 0.0, 0.0}, 1e-3);
  }
  EXPECT_EQ(plant.state().q_motor, limited.state().q_motor);
}

}  // namespace
}  // namespace capstan::simulation
