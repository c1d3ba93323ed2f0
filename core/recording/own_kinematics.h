#pragma once

#include "core/recording/measured_table.h"
#include "core/robot/description.h"

namespace capstan::recording {

/// Largest difference of q from the transmission kinematics of q_m in a table whose q is computed from q_m,
/// in deg or mm: rounding of the RAVEN-II's log is 1e-3, and joint encoders differ from kinematics by more,
/// as cables stretch.
inline constexpr double kSameAngle = 2e-3;
/// Least range of a joint at which that says something [deg or mm].
inline constexpr double kOwnMotion = 1.0;

/// True when the columns q are the transmission kinematics of q_m by `robot`, to kSameAngle in every row
/// of a table whose joints move: the robot computed them from its motors, and they are no measured truth.
bool isOwnKinematics(const MeasuredTable& table, const robot::Description& robot);

}  // namespace capstan::recording
