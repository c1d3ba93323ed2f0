#pragma once

#include "core/base/random.h"
#include "core/robot/description.h"
#include "tests/support/planted/effect.h"
#include "tests/support/planted/rigid_chain.h"

namespace capstan::test {

/// How far robots without a fault differ from their file, as a factor on what they usually differ.
struct Ageing {
  double wear = 1.0;     ///< on the spread of masses, friction, stiffness and damping
  double texture = 1.0;  ///< on the background texture
};

/// `nominal` after some years of use. Cable stiffness and damping, joint and motor friction, and masses with
/// their inertias are each multiplied by a random factor between 0.7 and 1.4, to the power of `wear`. Centres
/// of mass move by up to wear × 15 % of their distance from the joint. Geometry and transmission do not
/// change.
robot::Description worn(const robot::Description& nominal, base::Random& random, double wear = 1.0);

/// Parameters of one plant per joint, with units as in the robot file.
struct PlantParameters {
  explicit PlantParameters(const robot::Description& robot, bool rigid_drive);

  int size = 0;
  bool rigid = false;  ///< motor torque drives the joint directly
  int refinement = 1;  ///< factor on the number of integration steps that stability needs
  RigidChain chain;
  Joints gear{}, capstan{}, radius{}, homing{}, stiffness{}, damping{}, exponent{}, motor_inertia{};
  Joints motor_coulomb{}, motor_viscous{}, motor_smoothing{}, coulomb{}, viscous{}, smoothing{};
  Joints middle{}, half_range{};  ///< middle and half width of the range between the joint limits
  Joints armature{};              ///< added to the diagonal of the mass matrix
  Joints actuator_gain{};         ///< actual torque over commanded torque
  Joints compliance{};            ///< compliance of a rigid drive's cable [m/N]; 0: rigid
  std::array<Joints, kMostJoints> coupling{};
};

/// Applies an effect that changes a parameter of the robot model: link radius, coupling, zero, gravity,
/// bodies, inertia, gain or compliance. Other effects do not change `parameters`.
void plantInParameters(const Planted& planted, const robot::Description& nominal,
                       PlantParameters& parameters);

/// Cable stretch by the Coulomb friction of joint i alone [m], the typical scale of cable stretch.
double frictionStretch(const PlantParameters& parameters, int i);

}  // namespace capstan::test
