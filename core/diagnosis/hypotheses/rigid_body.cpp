#include "core/diagnosis/hypotheses/library.h"

namespace capstan::diagnosis::library {
namespace {

/// Starts for rigid drives. A cable drive cannot distinguish a torque offset from a homing offset.
Starts torqueOffsetStarts(const JointScales& s, int) {
  const double friction = s.coulomb > 0.0 ? s.coulomb : s.viscous * s.speed;
  return usable({{{0.0}, {0.5 * friction}}});
}

}  // namespace

std::vector<Hypothesis> rigidBodyHypotheses() {
  return {
      {
          .facts = &factsOf("gravity_tilt"),
          .place = Place::kRigidBody,
          .words =
              {
                  .title = "Tilted robot base",
                  .what = "The base is not mounted as the robot file says, so that gravity pulls in another "
                          "direction of frame 0.",
                  .equation = "G(q) of gravity R g_0, R the rotation by the vector (x, y, z) in frame 0",
                  .source = "Craig, Introduction to Robotics: Mechanics and Control (1989): gravity as an "
                            "acceleration of the base in the Newton–Euler recursion",
                  .changes =
                      "Rigid body: the direction of gravity in frame 0 changes, for all joints at once. A "
                      "rotation about gravity itself has no effect.",
                  .signature =
                      "The residual depends on the pose, in all joints that carry weight, and is the same "
                      "in both directions of motion and at rest. It is the difference of the two gravity "
                      "torques, as stretch of the cables.",
                  .experiment =
                      "Rest in many poses of all joints, with heavy links stretched out; measure the base "
                      "with a spirit level.",
              },
          .neutral = {0.0, 0.0, 0.0},
          .grid =
              [](const JointScales&, int) {
                return Starts{{{0.0, 0.0, 0.0}, {0.15, 0.15, 0.15}}};
              },
          .size = [](const std::vector<double>& v) { return amplitude(v, 3); },
      },
      {
          .facts = &factsOf("payload"),
          .place = Place::kRigidBody,
          .words =
              {
                  .title = "Payload at the tip",
                  .what =
                      "The arm carries an instrument or weight that is not in the robot file, or lacks one "
                      "that is.",
                  .equation =
                      "M(q), C(q, dq), G(q) of the chain whose last link carries a point mass at the marker",
                  .source =
                      "Atkeson, An and Hollerbach, Estimation of inertial parameters of manipulator loads "
                      "and links, International Journal of Robotics Research 5 (1986)",
                  .changes = "Rigid body: mass, centre of mass and inertia of the last link change.",
                  .signature =
                      "In all joints that lift the tip, the residual depends on the pose like the weight of "
                      "a heavier arm, more the farther the arm reaches out, and on acceleration.",
                  .experiment = "Rest with the arm stretched out and drawn in; then move the whole arm fast.",
              },
          .neutral = {0.0},
          .grid =
              [](const JointScales&, int) {
                return Starts{{{0.0}, {0.3}}};
              },
      },
      {
          .facts = &factsOf("inertia"),
          .place = Place::kRigidBody,
          .words =
              {
                  .title = "Inertia other than the model's",
                  .what =
                      "The joint is harder or easier to accelerate than its links explain: the robot file "
                      "lacks a rotor behind a gear, a counterweight or a pulley.",
                  .equation =
                      "(M(q) + added at the joint's place of the diagonal) ddq + C(q, dq) dq + G(q) = Γ",
                  .source =
                      "Siciliano, Sciavicco, Villani and Oriolo, Robotics: Modelling, Planning and Control "
                      "(2009), inertia of rotors behind gears",
                  .changes =
                      "Rigid body: a constant is added to the diagonal of the mass matrix; gravity does not "
                      "change.",
                  .signature =
                      "The residual is proportional to the joint's acceleration, and zero at constant speed "
                      "and at rest.",
                  .experiment =
                      "Start and stop fast, or follow a sine of the highest frequency that the drive allows.",
              },
          .neutral = {0.0},
          .grid =
              [](const JointScales& s, int) {
                return usable({{{0.0}, {s.inertia}}});
              },
      },
      {
          .facts = &factsOf("actuator_gain"),
          .place = Place::kRigidBody,
          .words =
              {
                  .title = "Motor that gives more or less than commanded",
                  .what =
                      "The torque constant, the amplifier's gain or the gear ratio differs from its nominal "
                      "value, so that the torque at the joint is a multiple of the recorded torque.",
                  .equation = "M(q) ddq + C(q, dq) dq + G(q) + F(dq) = (1 + share) τ + τ_ext",
                  .source =
                      "Gautier and Briot, Global identification of joint drive gains and dynamic parameters "
                      "of robots, Journal of Dynamic Systems, Measurement, and Control 136 (2014)",
                  .changes =
                      "Rigid body: the torque that drives this joint is multiplied by 1 + share; gravity "
                      "and measured loads are not.",
                  .signature =
                      "The residual is proportional to the motor torque. It can be distinguished only with "
                      "known weights or loads; otherwise inertia and friction explain it.",
                  .experiment = "Move with and without a known load or payload; hold known weights at rest.",
              },
          .neutral = {0.0},
          .grid =
              [](const JointScales&, int) {
                return Starts{{{0.0}, {0.2}}};
              },
      },
      {
          .facts = &factsOf("torque_offset"),
          .place = Place::kRigidBody,
          .words =
              {
                  .title = "Constant torque that is not in the model",
                  .what =
                      "The joint is pushed one way, moving or not: the current amplifier or its sensor has "
                      "an offset, a hose or motor cable pulls, or a spring balances weight.",
                  .equation = "M(q) ddq + C(q, dq) dq + G(q) + F(dq) = τ + offset + τ_ext",
                  .source = "Janot, Gautier and Brunot, Data set and reference models of EMPS, Workshop on "
                            "nonlinear "
                            "system identification benchmarks (2019), offset of the drive",
                  .changes = "Rigid body: a constant torque or force is added at this joint.",
                  .signature =
                      "The push is the same in every position and direction, so that the simulation drifts "
                      "away one way, at rest as much as in motion.",
                  .experiment =
                      "Let the joint rest without being held at several positions, then move slowly and "
                      "evenly both ways.",
              },
          .neutral = {0.0},
          .grid = torqueOffsetStarts,
      },
  };
}

}  // namespace capstan::diagnosis::library
