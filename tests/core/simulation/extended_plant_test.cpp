// Robot files with effects in the plant, and in what encoders and cameras tell.
#include <gtest/gtest.h>

#include <cmath>
#include <variant>
#include <vector>

#include "core/base/error.h"
#include "core/robot/arm_dynamics.h"
#include "core/robot/chain/chain_model.h"
#include "core/robot/chain_dynamics.h"
#include "core/robot/transmission.h"
#include "core/simulation/plant.h"
#include "core/simulation/simulated_source.h"
#include "tests/core/simulation/simulated_robot.h"

namespace capstan::simulation {
namespace {

using Eigen::Vector3d;
using robot::Effect;

const Vector3d kPose{0.6, 1.6, 0.32};

robot::Description ravenWith(std::vector<Effect> effects) {
  robot::Description robot = raven();
  robot.effects = std::move(effects);
  return robot;
}

Vector3d pull(double t) {
  return {0.12 + 0.15 * std::sin(9.0 * t), 0.05 + 0.12 * std::cos(7.0 * t), 0.1 + 0.2 * std::sin(11.0 * t)};
}

std::vector<PlantState> play(const robot::Description& robot, const Truth& truth = {}, double seconds = 0.5) {
  Plant plant(robot, truth);
  plant.reset(robot::Transmission(raven()).motorFromJoint(kPose));
  std::vector<PlantState> states;
  for (int k = 0; k < static_cast<int>(std::lround(seconds * 1e3)); ++k) {
    plant.step(pull(1e-3 * k), 1e-3);
    states.push_back(plant.state());
  }
  return states;
}

double apart(const std::vector<PlantState>& a, const std::vector<PlantState>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, (a[i].q_link - b[i].q_link).cwiseAbs().maxCoeff());
  return most;
}

/// With effects that do nothing, the laws of the chain are the plant's own equations, whatever the truth.
TEST(ExtendedPlant, withNeutralEffectsIsThePlant) {
  Truth worn = defaultTruth();
  const robot::Description neutral = ravenWith({{"backlash", 2, {{"half_width", 0.0}}},
                                                {"cable_creep", 1, {{"share", 0.0}, {"time_constant", 1.0}}},
                                                {"inertia", 3, {{"added", 0.0}}}});
  for (const Truth& truth : {Truth{}, worn})
    EXPECT_LT(apart(play(neutral, truth), play(raven(), truth)), 1e-9);
}

/// An effect that the robot file could also have written down as another number.
TEST(ExtendedPlant, effectsOfNumbersAreThoseNumbers) {
  robot::Description written = raven();
  written.drives[0].link_radius *= 1.02;
  written.joints[1].homing += 0.01;
  written.coupling[2][0] += 0.003;
  written.joints[2].friction.viscous += 2.0;
  const robot::Description extended = ravenWith({{"pulley_radius", 1, {{"share", 0.02}}},
                                                 {"homing_offset", 2, {{"offset", 0.01}}},
                                                 {"cable_coupling", 3, {{"added", 0.003}, {"other", 1.0}}},
                                                 {"viscous_friction", 3, {{"added", 2.0}}}});
  EXPECT_LT(apart(play(extended), play(written)), 1e-9);
  EXPECT_GT(apart(play(extended), play(raven())), 1e-3);
}

TEST(ExtendedPlant, hysteresisAndStribeckAreTheTruthsOwn) {
  Truth truth;
  truth.joints[1].hysteresis = {2e5, 1e-4, 1.0, 0.5};
  truth.joints[0].stribeck = {0.8, 0.05};
  const robot::Description extended =
      ravenWith({{"cable_hysteresis", 2, {{"force", 20.0}, {"yield", 1e-4}}},
                 {"stribeck_friction", 1, {{"excess", 0.8}, {"speed", 0.05}}}});
  EXPECT_LT(apart(play(extended), play(raven(), truth)), 1e-9);
  EXPECT_GT(apart(play(extended), play(raven())), 1e-5);
}

/// Reaction and travel belong together: over a turn an eccentric capstan takes no work and gives none.
TEST(ExtendedPlant, anEccentricCapstanReactsByItsLever) {
  const robot::Description extended =
      ravenWith({{"capstan_eccentricity", 1, {{"sine", 3e-4}, {"cosine", -4e-4}}}});
  robot::Description free = extended;
  for (robot::Drive& drive : free.drives) drive.motor_friction = {0.0, 0.0, 1.0}, drive.cable_damping = 0.0;
  for (robot::Joint& joint : free.joints) joint.friction = {0.0, 0.0, 1.0};
  const robot::ChainModel model(free);
  const robot::ArmDynamics bodies(free);
  Truth fine;
  fine.substeps = 40;
  Plant plant(free, fine);
  PlantState state;
  state.q_link = kPose;
  state.q_motor = robot::Transmission(free).motorFromJoint(kPose);
  state.dq_motor = {8.0, -5.0, 3.0};
  plant.setState(state);
  const auto energy = [&] {
    const PlantState& x = plant.state();
    double sum = 0.5 * x.dq_link.dot(bodies.massMatrix<double>(x.q_link) * x.dq_link);
    const Vector3d travel = robot::Transmission(free).linkTravel(x.q_link);
    for (int i = 0; i < 3; ++i) {
      const robot::JointNumbers<double>& p = model.numbers.joints[i];
      const double phi = p.inverse_gear * x.q_motor[i];
      const double stretch = p.lever * x.q_motor[i] + p.eccentric_cosine * std::sin(phi) +
                             p.eccentric_sine * (std::cos(phi) - 1.0) - travel[i];
      sum += 0.5 * p.motor_inertia * x.dq_motor[i] * x.dq_motor[i] +
             2.0 * p.stiffness / p.exponent * (std::cosh(p.exponent * stretch) - 1.0);
    }
    return sum + robot::ChainDynamics(free).potentialEnergy(x.q_link);
  };
  const double first = energy();
  const double kinetic = 0.5 * 2.847e-4 * state.dq_motor.squaredNorm();
  double most = 0.0;
  for (int k = 0; k < 500; ++k) {
    plant.step(Vector3d::Zero(), 1e-3);
    most = std::max(most, std::abs(energy() - first));
  }
  EXPECT_LT(most, 1e-5 * kinetic);
}

/// Before the recording nothing has moved; long after its begin the cable's zero is another number of the
/// file. Joint 3, which is coupled to joint 2, moves the other way: C12 Δq_2 + Δq_3 = 0.
TEST(ExtendedPlant, aZeroThatHasSettledIsAHomingOffset) {
  robot::Description written = raven();
  const double coupled = -written.coupling[2][1] * 0.01;
  written.joints[1].homing += 0.01;
  written.joints[2].homing += coupled;
  const robot::Description drifting =
      ravenWith({{"zero_drift", 2, {{"drift", 0.01}, {"time_constant", 0.02}}}});
  const auto playFrom = [](double t, const robot::Description& robot, const Vector3d& q_link) {
    Plant plant(robot, Truth{});
    PlantState state;
    state.q_motor = robot::Transmission(raven()).motorFromJoint(kPose);
    state.q_link = q_link;
    state.t = t;
    plant.setState(state);
    std::vector<PlantState> states;
    for (int k = 0; k < 500; ++k) {
      plant.step(pull(1e-3 * k), 1e-3);
      states.push_back(plant.state());
    }
    return states;
  };
  EXPECT_LT(apart(playFrom(-2.0, drifting, kPose), playFrom(0.0, raven(), kPose)), 1e-9);
  const Vector3d further = kPose + Vector3d(0.0, 0.01, coupled);
  EXPECT_LT(apart(playFrom(2.0, drifting, further), playFrom(0.0, written, further)), 1e-9);
}

TEST(ExtendedPlant, anArmWithoutCablesIsRefused) {
  robot::Description rigid = raven();
  rigid.drive = robot::DriveType::kRigid;
  try {
    Plant plant(rigid, Truth{});
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().key, "drive");
  }
}

struct Heard {
  std::vector<tracking::MotorSample> motors;
  std::vector<Vector3d> joints;
  std::vector<tracking::TipSample> tips;
  std::vector<FrameTruth> frames;
};

Heard listen(const robot::Description& robot, double seconds = 1.0) {
  SimulatedOptions options = quietOptions(seconds);
  options.robot = robot;
  options.rig = testRig();
  options.images = false;
  SimulatedSource source(options);
  Heard heard;
  for (tracking::Sample sample; source.next(sample);) {
    if (const auto* motor = std::get_if<tracking::MotorSample>(&sample)) heard.motors.push_back(*motor);
    if (const auto* joint = std::get_if<tracking::JointSample>(&sample))
      heard.joints.push_back(joint->position);
    if (const auto* tip = std::get_if<tracking::TipSample>(&sample)) {
      heard.tips.push_back(*tip);
      heard.frames.push_back(source.frameTruth());
    }
  }
  return heard;
}

TEST(ExtendedSource, camerasTellWhatTheFileSays) {
  const robot::Description extended =
      ravenWith({{"camera_rotation", 0, {{"x", 0.02}, {"y", -0.01}, {"z", 0.03}}},
                 {"camera_offset", 0, {{"x", 1e-3}, {"y", -2e-3}, {"z", 3e-3}}},
                 {"camera_scale", 0, {{"share", 0.01}}},
                 {"camera_latency", 0, {{"delay", 0.02}}}});
  const Heard heard = listen(extended), plain = listen(raven());
  const robot::CameraNumbers camera = robot::ChainModel(extended).camera;
  ASSERT_GT(heard.tips.size(), 10U);
  for (std::size_t i = 0; i < std::min(heard.tips.size(), plain.tips.size()); ++i) {
    EXPECT_NEAR(heard.tips[i].t - heard.frames[i].t, 0.02, 1e-12);
    EXPECT_NEAR(plain.tips[i].t - plain.frames[i].t, 0.0, 1e-12);
    // The sphere's picture is not quite centred on its centre: tenths of a millimetre, alike in both.
    const Vector3d bias = plain.tips[i].position - plain.frames[i].tip;
    EXPECT_LT((heard.tips[i].position - bias - camera.measure(heard.frames[i].tip)).norm(), 1e-4);
    EXPECT_EQ(heard.frames[i].tip, plain.frames[i].tip);
  }
  for (std::size_t i = 0; i < heard.joints.size(); ++i) EXPECT_EQ(heard.joints[i], plain.joints[i]);
}

TEST(ExtendedSource, aSlippedEncoderFallsBehindAndTheJointRunsAhead) {
  const double slip = 3.0;  // [rad] of the motor
  const robot::Description extended = ravenWith({{"encoder_slip", 1, {{"slip", slip}, {"time", 0.4}}}});
  const Heard heard = listen(extended, 1.5), plain = listen(raven(), 1.5);
  ASSERT_EQ(heard.joints.size(), plain.joints.size());
  for (std::size_t i = 0; i < 399; ++i) EXPECT_EQ(heard.joints[i], plain.joints[i]);
  // The controller follows the reading, so that the joint is off by what the reading lacks.
  const robot::Drive drive = raven().drives[0];
  const double expected = slip * drive.motor_capstan_radius / drive.gear_ratio / drive.link_radius;
  EXPECT_NEAR((heard.joints.back() - plain.joints.back())[0], expected, 0.1 * expected);
  EXPECT_NEAR(heard.motors.back().position[0], plain.motors.back().position[0], 0.1 * slip);
}

/// The controller holds the motors, so that the joint goes where its zero goes, to within what friction
/// stretches the cable.
TEST(ExtendedSource, aZeroThatDriftsTakesTheJointAlong) {
  const robot::Description extended =
      ravenWith({{"zero_drift", 2, {{"drift", 0.05}, {"time_constant", 0.5}}}});
  const Heard heard = listen(extended, 1.5), plain = listen(raven(), 1.5);
  ASSERT_EQ(heard.joints.size(), plain.joints.size());
  EXPECT_EQ(heard.joints.front(), plain.joints.front());
  for (const std::size_t i : {250U, 500U, 1000U, 1490U}) {
    const double by = 0.05 * (1.0 - std::exp(-1e-3 * static_cast<double>(i) / 0.5));
    EXPECT_NEAR((heard.joints[i] - plain.joints[i])[1], by, 2e-3) << i;
    EXPECT_NEAR(heard.motors[i].position[1], plain.motors[i].position[1], 0.2) << i;
  }
}

TEST(ExtendedSource, sameSeedSameBytes) {
  const robot::Description extended = ravenWith({{"backlash", 2, {{"half_width", 3e-4}}}});
  const Heard one = listen(extended), two = listen(extended);
  ASSERT_EQ(one.motors.size(), two.motors.size());
  for (std::size_t i = 0; i < one.motors.size(); ++i)
    EXPECT_EQ(one.motors[i].position, two.motors[i].position);
}

}  // namespace
}  // namespace capstan::simulation
