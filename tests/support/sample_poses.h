#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <string>

namespace capstan::testing {

/// A table of tip poses (recording::readPoseTable) whose flaws are known: cameras in a frame of their own and
/// late, an error that goes smoothly with place and speed, observations that jump, rows without an
/// observation.
struct SamplePoses {
  int trajectories = 20, rows = 60;  ///< of each trajectory, at 100 Hz
  double clock_offset = 0.04;        ///< of what is seen behind what is told [s]
  double bias = 4e-3;                ///< of the smooth error [m]
  double noise = 3e-5;               ///< of what is seen, each axis [m]
  double turn_noise = 0.0;           ///< likewise, of the rotation [rad]
  int outliers = 2;                  ///< rows of each trajectory that jump by 6 cm; all of the last one
  int placeholders = 1;              ///< rows of each trajectory without an observation
  bool command = true;               ///< false: the robot's kinematics alone
  double unit = 1.0;                 ///< that positions are written in [m]
  std::uint64_t seed = 1;
  std::uint64_t noise_seed = 0;  ///< 0: of `seed`; others: the same paths with other noise
};

/// What takes what is seen to what is told, but for the smooth error.
Eigen::Isometry3d sampleOffset();

std::string samplePoseTable(const SamplePoses& sample = {});
void writeSamplePoses(const std::filesystem::path& path, const SamplePoses& sample = {});

}  // namespace capstan::testing
