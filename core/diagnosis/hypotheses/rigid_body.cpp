#include "core/diagnosis/hypotheses/library.h"

namespace capstan::diagnosis::library {
namespace {

/// For rigid drives: a cable drive shows it as a stretch that a homing offset makes as well.
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
                  .title = "Robot that stands tilted",
                  .what = "The base is not mounted as the robot file says, so that gravity pulls in another "
                          "direction of frame 0.",
                  .equation = "G(q) of gravity R g_0, R the rotation by the vector (x, y, z) in frame 0",
                  .source = "Craig, Introduction to Robotics: Mechanics and Control (1989): gravity as an "
                            "acceleration of the base in the Newton–Euler recursion",
                  .changes =
                      "Rigid body: the direction of gravity in frame 0, for all joints at once. A rotation "
                      "about gravity itself changes nothing.",
                  .signature =
                      "By the pose, in all joints that bear weight, the same in both directions of motion "
                      "and at rest: the difference of the two gravity torques, through the cables.",
                  .experiment =
                      "Rests in many poses of all joints, heavy links stretched out; measure the base with "
                      "a spirit level.",
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
                      "The arm carries an instrument or weight that the robot file does not know, or lacks "
                      "one that it has.",
                  .equation =
                      "M(q), C(q, dq), G(q) of the chain whose last link carries a point mass at the marker",
                  .source =
                      "Atkeson, An and Hollerbach, Estimation of inertial parameters of manipulator loads "
                      "and links, International Journal of Robotics Research 5 (1986)",
                  .changes = "Rigid body: mass, centre of mass and inertia of the last link.",
                  .signature =
                      "By the pose, as a heavier arm has it, the more the further it reaches out, and with "
                      "acceleration: in all joints that lift the tip.",
                  .experiment =
                      "Rests with the arm stretched out and drawn in, then fast motion of the whole arm.",
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
                  .what = "The joint is harder or easier to accelerate than its links account for: a rotor "
                          "behind a gear, a counterweight or a pulley that the robot file lacks.",
                  .equation =
                      "(M(q) + added at the joint's place of the diagonal) ddq + C(q, dq) dq + G(q) = Γ",
                  .source =
                      "Siciliano, Sciavicco, Villani and Oriolo, Robotics: Modelling, Planning and Control "
                      "(2009), inertia of rotors behind gears",
                  .changes = "Rigid body: a constant on the diagonal of the mass matrix; gravity stays.",
                  .signature =
                      "In proportion to the joint's acceleration, nothing at constant speed and at rest.",
                  .experiment = "Fast starts and stops, or a sine as high in frequency as the drive allows.",
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
                      "The torque constant, the amplifier's gain or the gear ratio is not the nominal one, "
                      "so that the torque at the joint is a multiple of the one recorded.",
                  .equation = "M(q) ddq + C(q, dq) dq + G(q) + F(dq) = (1 + share) τ + τ_ext",
                  .source =
                      "Gautier and Briot, Global identification of joint drive gains and dynamic parameters "
                      "of robots, Journal of Dynamic Systems, Measurement, and Control 136 (2014)",
                  .changes =
                      "Rigid body: the torque that drives this joint is multiplied by 1 + share; gravity "
                      "and measured loads are not.",
                  .signature =
                      "In proportion to the motor torque. It shows only beside known weights or loads: "
                      "otherwise inertia and friction take it up.",
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
                  .title = "Constant torque that the model does not know",
                  .what = "The current amplifier or its sensor has an offset, a hose or a cable to the motor "
                          "pulls, "
                          "or a spring balances weight: something pushes the joint one way, moving or not.",
                  .equation = "M(q) ddq + C(q, dq) dq + G(q) + F(dq) = τ + offset + τ_ext",
                  .source = "Janot, Gautier and Brunot, Data set and reference models of EMPS, Workshop on "
                            "nonlinear "
                            "system identification benchmarks (2019), offset of the drive",
                  .changes = "Rigid body: a constant torque or force is added at this joint.",
                  .signature = "The same push in every position and direction, so that the simulation drifts "
                               "away one way; "
                               "at rest it shows as much as in motion.",
                  .experiment =
                      "Let the joint rest unheld in several places, then move slowly and evenly both ways.",
              },
          .neutral = {0.0},
          .grid = torqueOffsetStarts,
      },
  };
}

}  // namespace capstan::diagnosis::library
