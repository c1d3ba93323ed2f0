#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/robot/description.h"

namespace capstan::widgets {

/// A tube along a polyline, fixed to frame 0…3 of the arm. Metres.
struct Tube {
  int frame = 0;
  std::vector<Eigen::Vector3d> path;
  double radius = 0.0;
};

/// What is drawn of a three-joint remote-centre arm. Links 1 and 2 are arcs about the remote centre, from
/// joint axis to joint axis, on the side on which the robot file has their centres of mass; the third moves
/// along a rail and carries the shaft through the remote centre. Cables run from the motors at the base over
/// one pulley a joint (radius r_l of the revolute joints).
struct ArmShape {
  std::vector<Tube> links;
  std::array<std::vector<Tube>, 3> cables;
  std::vector<Tube> shaft;
  Eigen::Vector3d marker = Eigen::Vector3d::Zero();  ///< frame 3
  double marker_radius = 0.0;
};

ArmShape shapeOf(const robot::Description& robot);

/// The box that the tip can reach, from a grid over the joint limits: lowest and highest corner, frame 0 [m].
std::array<Eigen::Vector3d, 2> reachOf(const robot::Description& robot);

}  // namespace capstan::widgets
