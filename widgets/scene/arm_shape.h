#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/robot/description.h"

namespace capstan::widgets {

/// A tube along a polyline in frame 0…3 of the arm [m].
struct Tube {
  int frame = 0;
  std::vector<Eigen::Vector3d> path;
  double radius = 0.0;
};

/// Shape of a three-joint remote-centre arm. Links 1 and 2 are arcs about the remote centre from joint axis
/// to joint axis, on the side of their centres of mass in the robot file. Link 3 moves along a rail and
/// carries the shaft through the remote centre. Cables run from the motors at the base over one pulley per
/// joint (radius r_l of the revolute joints).
struct ArmShape {
  std::vector<Tube> links;
  std::array<std::vector<Tube>, 3> cables;
  std::vector<Tube> shaft;
  Eigen::Vector3d marker = Eigen::Vector3d::Zero();  ///< position in frame 3 [m]
  double marker_radius = 0.0;
};

ArmShape shapeOf(const robot::Description& robot);

/// Bounding box of the positions that the tip can reach, from a grid over the joint limits: lowest and
/// highest corner in frame 0 [m].
std::array<Eigen::Vector3d, 2> reachOf(const robot::Description& robot);

}  // namespace capstan::widgets
