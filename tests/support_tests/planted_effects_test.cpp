// The planted effects one by one against closed forms, on a robot of one sliding joint.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/planted/effect_laws.h"
#include "tests/support_tests/planted_robots.h"

namespace capstan::test {
namespace {

constexpr double kStiffness = 1e4;  // 2 k a of the slider [N/m]

Planted planted(Effect effect, double magnitude, double signature = 1.0, double phase = 0.0) {
  Planted e;
  e.effect = effect;
  e.magnitude = magnitude;
  e.signature = signature;
  e.phase = phase;
  return e;
}

/// Where a load leaves the slider when its motor is held at 0.
double restUnder(double load, const std::vector<Planted>& effects, double seconds = 1.0) {
  const robot::Description robot = slider();
  PlantParameters p(robot, false);
  for (const Planted& e : effects) plantInParameters(e, robot, p);
  Plant plant(p, effects);
  PlantState s = plant.rest(Joints{});
  const Joints still{};
  PlantInput input;
  input.load[0] = load;
  input.motor = input.motor_end = input.motor_rate = input.motor_rate_end = &still;
  const int steps = plant.stepsFor(1e-3, Joints{});
  for (int k = 0; k < static_cast<int>(std::lround(seconds * 1e3)); ++k)
    plant.advance(s, k * 1e-3, 1e-3, steps, input);
  return s[kJoint][0];
}

TEST(PlantedEffects, TheCableGivesWayByLoadOverStiffness) {
  // 2 k sinh(a q) = load
  EXPECT_NEAR(restUnder(20.0, {}), std::asinh(20.0 / kStiffness), 1e-9);
}

TEST(PlantedEffects, BacklashAddsItsHalfWidth) {
  const auto play = planted(Effect::kBacklash, 7e-4);
  EXPECT_NEAR(restUnder(20.0, {play}), 7e-4 + std::asinh(20.0 / kStiffness), 1e-8);
  EXPECT_NEAR(restUnder(-20.0, {play}), -7e-4 - std::asinh(20.0 / kStiffness), 1e-8);
}

TEST(PlantedEffects, ASlackPairHasHalfTheStiffness) {
  // Without any pretension one cable alone bears the load: k (e^{a x} − 1) = load.
  EXPECT_NEAR(restUnder(20.0, {planted(Effect::kSlack, 1.0, 5e-3)}), std::log1p(20.0 / (0.5 * kStiffness)),
              1e-8);
  // With a pretension stretch of 5 mm both stay taut, a little stiffer than without: 2 k e^{a x0} sinh(a x).
  EXPECT_NEAR(law::cablePair(5e3, 1.0, 20.0, 5e-3, 2e-3, 0.1), 1e4 * std::exp(5e-3) * std::sinh(2e-3) + 4.0,
              1e-9);
  // Too long by 1 mm each: a gap, then one cable.
  EXPECT_EQ(law::cablePair(5e3, 1.0, 20.0, -1e-3, 0.9e-3, 0.0), 0.0);
  EXPECT_NEAR(law::cablePair(5e3, 1.0, 20.0, -1e-3, 3e-3, 0.0), 5e3 * std::expm1(2e-3), 1e-9);
}

TEST(PlantedEffects, StiffeningIsCubic) {
  const double beta = 4e4, x = restUnder(60.0, {planted(Effect::kCableStiffening, beta)});
  EXPECT_NEAR(kStiffness * (std::sinh(x) + beta * x * x * x), 60.0, 1e-6);
  EXPECT_LT(x, 0.006);
}

TEST(PlantedEffects, ALongerCableIsSofter) {
  // Near +0.002 of a range of ±0.5 the free length is 1 + 0.5 · 0.004 of that in the middle.
  const double x = restUnder(20.0, {planted(Effect::kPositionStiffness, 0.5)});
  EXPECT_NEAR(kStiffness * std::sinh(x) / (1.0 + 0.5 * x / 0.5), 20.0, 1e-6);
}

TEST(PlantedEffects, CreepEndsAtItsShareOfTheStretch) {
  const auto creep = planted(Effect::kCableCreep, 0.4, 0.1);
  const double elastic = std::asinh(20.0 / kStiffness);
  EXPECT_NEAR(restUnder(20.0, {creep}, 3.0), 1.4 * elastic, 1e-8);
  // One time constant later, the cable's own settling (60 ms/1.4 of creep) aside, about 1 − 1/e of it is
  // there.
  const double early = restUnder(20.0, {creep}, 0.1);
  EXPECT_GT(early, 0.95 * elastic);
  EXPECT_LT(early, 1.35 * elastic);
}

TEST(PlantedEffects, BoucWenEndsAtItsYieldAndComesBackAnotherWay) {
  const double yield = 1e-4;
  double z = 0.0, there = 0.0;
  const int steps = 20000;
  const double way = 10.0 * yield / steps;
  for (int k = 0; k < steps; ++k) {
    z += law::boucWenRate(z, 1.0, yield) * way;
    if (k == steps / 10) there = z;
  }
  EXPECT_NEAR(z, yield * (1.0 - std::exp(-10.0)), 1e-3 * yield);  // loading: z = y (1 − e^{−x/y})
  EXPECT_NEAR(there, yield * (1.0 - std::exp(-1.0)), 1e-3 * yield);
  for (int k = 0; k < steps / 10; ++k) z += law::boucWenRate(z, -1.0, yield) * way;
  EXPECT_NEAR(z, 0.0, 2e-3 * yield);  // unloading is straight: dz = dx
}

/// The motor is held: the joint goes where its zero goes, behind it as mass, damper and friction say. Of
/// k (z − x) + 2 b (dz − dx) − F_v dx = m d²x with z = c (1 − e^{s t}), s = −1/T, that is x = c (1 − H(s)
/// e^{s t}), H(s) = (k + 2 b s) / (k + (2 b + F_v) s + m s²).
TEST(PlantedEffects, AZeroSettlesExponentially) {
  const auto drift = planted(Effect::kZeroDrift, 3e-3, 0.5);
  const double s = -2.0;
  const double behind = (kStiffness + 40.0 * s) / (kStiffness + 340.0 * s + 2.0 * s * s);
  for (const double t : {0.5, 1.0, 8.0})
    EXPECT_NEAR(restUnder(0.0, {drift}, t), 3e-3 * (1.0 - behind * std::exp(s * t)), 1e-8) << t;
  EXPECT_EQ(law::settledZero(3e-3, -0.1, 0.5), 0.0);
  const double h = 1e-6;
  EXPECT_NEAR((law::settledZero(2.0, 0.3 + h, 0.5) - law::settledZero(2.0, 0.3 - h, 0.5)) / (2.0 * h),
              law::settlingZero(2.0, 0.3, 0.5), 1e-8);
}

/// Slope of the joint's velocity at rest position and velocity v, without anything else moving.
double acceleration(const std::vector<Planted>& effects, double q, double v, double t = 0.0) {
  robot::Description robot = slider();
  robot.joints[0].friction = {6.0, 0.0, 0.01};
  PlantParameters p(robot, false);
  for (const Planted& e : effects) plantInParameters(e, robot, p);
  Plant plant(p, effects);
  PlantState s{};
  s[kJoint][0] = q;
  s[kMotor] = plant.motorsAt(s[kJoint]);
  s[kJointRate][0] = v;
  s[kMotorRate][0] = v * 10.0 / 0.01;
  return plant.slope(s, t, {})[kJointRate][0];
}

TEST(PlantedEffects, FrictionOfEveryKind) {
  const double mass = 2.0, coulomb = 6.0;
  EXPECT_NEAR(acceleration({}, 0.1, 0.5), -coulomb / mass, 1e-9);
  const auto asymmetric = planted(Effect::kAsymmetricFriction, 0.2);
  EXPECT_NEAR(acceleration({asymmetric}, 0.1, 0.5), -1.2 * coulomb / mass, 1e-9);
  EXPECT_NEAR(acceleration({asymmetric}, 0.1, -0.5), 0.8 * coulomb / mass, 1e-9);
  const auto stribeck = planted(Effect::kStribeckFriction, 1.5, 0.2);
  EXPECT_NEAR(acceleration({stribeck}, 0.1, 0.2), -coulomb / mass * (1.0 + 1.5 / std::numbers::e), 1e-9);
  EXPECT_NEAR(acceleration({planted(Effect::kViscousFriction, 30.0)}, 0.1, -0.5), (coulomb + 15.0) / mass,
              1e-9);
  const auto position = planted(Effect::kPositionFriction, 0.5, 0.4);
  EXPECT_NEAR(acceleration({position}, 0.1, 0.5), -1.5 * coulomb / mass, 1e-9);
  EXPECT_NEAR(acceleration({position}, -0.1, 0.5), -0.5 * coulomb / mass, 1e-9);
}

TEST(PlantedEffects, LoadFrictionIsAShareOfTheCablesPull) {
  const robot::Description robot = slider();
  const auto friction = planted(Effect::kLoadFriction, 0.25);
  PlantParameters p(robot, false);
  Plant with(p, {friction}), without(p, {});
  PlantState s{};
  s[kMotor][0] = 2.0;  // stretch 2 mm
  s[kJointRate][0] = -0.4;
  s[kMotorRate][0] = -400.0;
  const double pull = kStiffness * std::sinh(2e-3);
  EXPECT_NEAR(with.slope(s, 0.0, {})[kJointRate][0] - without.slope(s, 0.0, {})[kJointRate][0],
              0.25 * pull / 2.0, 1e-9);
}

TEST(PlantedEffects, WhatActsFromOutside) {
  const double mass = 2.0;
  EXPECT_NEAR(acceleration({planted(Effect::kNonlinearSpring, 8.0)}, 0.25, 0.0), -8.0 * 0.125 / mass, 1e-9);
  EXPECT_NEAR(acceleration({planted(Effect::kExternalVibration, 3.0, 5.0, 0.0)}, 0.0, 0.0, 0.05), 3.0 / mass,
              1e-9);
  EXPECT_NEAR(acceleration({planted(Effect::kJointDetent, 3.0, 0.4, 0.0)}, 0.1, 0.0), 3.0 / mass, 1e-9);
}

TEST(PlantedEffects, InertiaAndPayloadSlowTheSameForce) {
  EXPECT_NEAR(acceleration({planted(Effect::kInertia, 1.0)}, 0.1, 0.5), -6.0 / 3.0, 1e-9);
  EXPECT_NEAR(acceleration({planted(Effect::kPayload, 4.0)}, 0.1, 0.5), -6.0 / 6.0, 1e-9);
}

TEST(PlantedEffects, TheTransmissionGoesAnotherWay) {
  const robot::Description robot = raven();
  const Joints q{0.4, 1.1, 0.3};
  const auto motors = [&](Effect effect, int joint, double magnitude, int other = 0) {
    Planted e = planted(effect, magnitude);
    e.joint = joint;
    e.other = other;
    PlantParameters p(robot, false);
    plantInParameters(e, robot, p);
    return Plant(p, {e}).motorsAt(q);
  };
  const Joints plain = motors(Effect::kPulleyRadius, 1, 0.0);
  EXPECT_NEAR(motors(Effect::kPulleyRadius, 1, 0.05)[1], 1.05 * plain[1], 1e-9);
  const double ratio2 = robot.drives[2].gear_ratio / robot.drives[2].motor_capstan_radius;
  EXPECT_NEAR(motors(Effect::kCableCoupling, 2, 0.01, 1)[2] - plain[2],
              0.01 * (q[1] - robot.joints[1].homing) * ratio2, 1e-9);
  EXPECT_NEAR(motors(Effect::kHomingOffset, 2, 0.002)[2] - plain[2], -0.002 * ratio2, 1e-9);
}

TEST(PlantedEffects, TheLeverOfAnEccentricCapstanIsTheSlopeOfItsTravel) {
  // A motor turning at constant speed against a joint that stands: the cable's damper sees the lever.
  const robot::Description robot = slider();
  const auto off = planted(Effect::kCapstanEccentricity, 2e-4, 1.0, 0.7);
  Plant plant(PlantParameters(robot, false), {off});
  const auto pull = [&](double q_m, double rate) {
    PlantState s{};
    s[kMotor][0] = q_m;
    s[kMotorRate][0] = rate;
    return 2.0 * plant.slope(s, 0.0, {})[kJointRate][0];
  };
  const auto travel = [&](double q_m) { return std::asinh(pull(q_m, 0.0) / kStiffness); };
  for (const double q_m : {-3.0, 0.0, 4.0, 11.0}) {
    EXPECT_NEAR(travel(q_m), 1e-3 * q_m + 2e-4 * (std::sin(0.1 * q_m + 0.7) - std::sin(0.7)), 1e-9);
    const double slope = (travel(q_m + 1e-3) - travel(q_m - 1e-3)) / 2e-3;
    EXPECT_NEAR((pull(q_m, 1.0) - pull(q_m, 0.0)) / 40.0, slope, 1e-7);
  }
}

TEST(PlantedEffects, ATiltTurnsGravityByItsAngle) {
  const robot::Description robot = raven();
  PlantParameters p(robot, false);
  Planted tilt = planted(Effect::kGravityTilt, 0.1);
  tilt.axis = Eigen::Vector3d::UnitZ();
  plantInParameters(tilt, robot, p);
  EXPECT_NEAR((p.chain.gravity() - 9.81 * Eigen::Vector3d(-std::cos(0.1), -std::sin(0.1), 0.0)).norm(), 0.0,
              1e-12);
}

TEST(PlantedEffects, ARigidDriveWithAHiddenCableIsATwoMassResonator) {
  // Free, undamped but for the cable's own: motor 5 kg, carriage 90 kg, k = 1/C: omega² = k (1/5 + 1/90).
  robot::Description robot = rigidRobot("rigid_axis");
  robot.joints[0].friction = {0.0, 0.0, 0.01};
  PlantParameters p(robot, true);
  const auto cable = planted(Effect::kCableCompliance, 1e-6);
  plantInParameters(cable, robot, p);
  Plant plant(p, {cable});
  PlantState s = plant.rest(Joints{0.25});
  s[kJoint][0] += 1e-3;
  const double omega = std::sqrt(1e6 * (1.0 / 5.0 + 1.0 / 90.0));
  const double decay = 0.5 * 0.2 * std::sqrt(1e6 * 5.0) * (1.0 / 5.0 + 1.0 / 90.0);
  const double damped = std::sqrt(omega * omega - decay * decay), half = std::numbers::pi / damped;
  plant.advance(s, 0.0, half, 200, {});
  const double stretch = s[kMotor][0] - s[kJoint][0];
  EXPECT_NEAR(stretch, 1e-3 * std::exp(-decay * half), 1e-7);
}

TEST(PlantedEffects, AnActuatorsGainScalesItsTorque) {
  robot::Description robot = rigidRobot("rigid_axis");
  PlantParameters p(robot, true);
  plantInParameters(planted(Effect::kActuatorGain, -0.2), robot, p);
  Plant plant(p, {});
  PlantInput input;
  input.torque[0] = 190.0;
  EXPECT_NEAR(plant.slope(plant.rest(Joints{0.25}), 0.0, input)[kJointRate][0], 0.8 * 190.0 / 95.0, 1e-12);
}

}  // namespace
}  // namespace capstan::test
