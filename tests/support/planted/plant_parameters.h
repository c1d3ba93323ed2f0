#pragma once

#include "core/base/random.h"
#include "core/robot/description.h"
#include "tests/support/planted/effect.h"
#include "tests/support/planted/rigid_chain.h"

namespace capstan::test {

/// The robot of `nominal` after some years: cable stiffness and damping, joint and motor friction, masses
/// (with their inertias) each times a factor of its own between 0.7 and 1.4, centres of mass moved by up to
/// 15 % of their distance from the joint. Geometry and transmission stay.
robot::Description worn(const robot::Description& nominal, base::Random& random);

/// Numbers of one plant, joint by joint, units as in the robot file.
struct PlantParameters {
  explicit PlantParameters(const robot::Description& robot, bool rigid_drive);

  int size = 0;
  bool rigid = false;  ///< motor torque drives the joint directly
  int refinement = 1;  ///< times as many integration steps as stability asks for
  RigidChain chain;
  Joints gear{}, capstan{}, radius{}, homing{}, stiffness{}, damping{}, exponent{}, motor_inertia{};
  Joints motor_coulomb{}, motor_viscous{}, motor_smoothing{}, coulomb{}, viscous{}, smoothing{};
  Joints middle{}, half_range{};  ///< of the joint's limits
  Joints armature{};              ///< added to the diagonal of the mass matrix
  Joints actuator_gain{};         ///< torque that arrives over commanded torque
  Joints compliance{};            ///< of the cable of a rigid drive [m/N]; 0: rigid
  std::array<Joints, kMostJoints> coupling{};
};

/// Effects that are another number in the model of the robot file: link radius, coupling, zero, gravity,
/// bodies, inertia, gain, compliance. Others leave `parameters` as they are.
void plantInParameters(const Planted& planted, const robot::Description& nominal,
                       PlantParameters& parameters);

/// Cable stretch that the Coulomb friction of joint i alone makes [m]: the scale of what a cable shows.
double frictionStretch(const PlantParameters& parameters, int i);

}  // namespace capstan::test
