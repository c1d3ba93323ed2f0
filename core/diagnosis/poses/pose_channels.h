#pragma once

#include <vector>

#include "core/diagnosis/poses/pose_fit.h"
#include "core/diagnosis/residuals/residual.h"
#include "core/diagnosis/residuals/variables.h"

/// Presents the observations of many trajectories as channels and variables of one recording. Each row is one
/// observation. The trajectories follow each other in time, with pauses of kApart.
namespace capstan::diagnosis {

inline constexpr double kApart = 1.0;  ///< pause between trajectories [s]

/// Standard deviation of the white noise of a residual for each axis [m]: the median of whiteNoise() over all
/// trajectories that are long enough. It includes the noise of the cameras and the jitter of the reference.
Eigen::Vector3d noiseOf(const PoseData& data, const Eigen::Matrix3Xd& e);

/// Channel of the tip along one axis of frame 0, with its noise.
ComparedChannel comparedChannel(int axis, const Eigen::Vector3d& noise);

/// Channel with the residual e of one axis.
Channel poseChannel(const PoseData& data, const Eigen::Matrix3Xd& e, int axis, const Eigen::Vector3d& noise);

/// Variables that a residual may depend on: position, velocity (difference over kSlope) and direction of
/// motion of the reference path along x, y and z, and time.
std::vector<Variable> poseVariables(const PoseData& data);
inline constexpr double kSlope = 0.06;     ///< time between the positions of a difference [s]
inline constexpr double kResting = 0.005;  ///< speed below which the tip counts as at rest [m/s]

}  // namespace capstan::diagnosis
