#pragma once

#include <vector>

#include "core/diagnosis/poses/pose_fit.h"
#include "core/diagnosis/residuals/residual.h"
#include "core/diagnosis/residuals/variables.h"

/// Observations of many trajectories as channels and variables of one recording: a row an observation,
/// trajectories one behind the other with kApart between them.
namespace capstan::diagnosis {

inline constexpr double kApart = 1.0;  ///< [s]

/// Standard deviation, axis by axis, of what differs from observation to observation in a residual
/// (whiteNoise within each trajectory, the median of those long enough). It has the cameras' noise and the
/// reference's jitter in it [m].
Eigen::Vector3d noiseOf(const PoseData& data, const Eigen::Matrix3Xd& e);

ComparedChannel comparedChannel(int axis, const Eigen::Vector3d& noise);

/// Residual e of one axis.
Channel poseChannel(const PoseData& data, const Eigen::Matrix3Xd& e, int axis, const Eigen::Vector3d& noise);

/// Position, velocity (over kSlope) and direction of motion along each axis of the commanded path, and
/// time.
std::vector<Variable> poseVariables(const PoseData& data);
inline constexpr double kSlope = 0.06;     ///< [s]
inline constexpr double kResting = 0.005;  ///< slower than this a tip rests [m/s]

}  // namespace capstan::diagnosis
