#pragma once

#include "core/base/random.h"
#include "core/robot/description.h"

namespace capstan::test {

/// Robot of `joints` joints (1 to 7) that no file describes, with a cable drive: geometry, bodies, friction,
/// drives, coupling, limits and gravity are random. Four of five joints are revolute. Coulomb friction
/// stretches each cable as far as 0.3–3 mrad or 0.03–0.3 mm at the joint, and each cable is damped with a
/// ratio of 0.2–1.
robot::Description randomCableRobot(int joints, base::Random& random);
/// The same with revolute joints that motor torque drives without cables.
robot::Description randomRigidRobot(int joints, base::Random& random);

}  // namespace capstan::test
