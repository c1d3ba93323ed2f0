#pragma once

#include <Eigen/Core>
#include <array>

/// Facts about servo_robot.cpp that its tests share.
namespace capstan::testing {

inline constexpr std::array<const char*, 6> kServoNames = {"roll",      "yaw",   "wrist",
                                                           "insertion", "pitch", "jaw"};
/// Joints 1, 2, 3 among these, and where the robot's own positions differ from the robot file's.
inline constexpr std::array<std::size_t, 3> kServoPlaces = {1, 4, 3};
inline constexpr std::array<double, 3> kServoSigns = {1.0, -1.0, 1.0}, kServoOffsets = {0.1, 0.0, -0.02};
inline constexpr std::array<double, 3> kServoWrist = {0.7, -0.4, 0.3};  ///< roll, wrist, jaw
inline const Eigen::Vector3d kServoStart(0.3, 2.2, 0.54);               ///< near the hard stop

}  // namespace capstan::testing
