#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <string>

namespace capstan::testing {

/// Table of tip poses (recording::readPoseTable) with known errors: cameras have another frame and late
/// stamps, there is an error that is a smooth function of position and speed, and there are outliers and rows
/// without an observation.
struct SamplePoses {
  int trajectories = 20, rows = 60;  ///< trajectories, and rows of each at 100 Hz
  double clock_offset = 0.04;        ///< delay of observed behind commanded poses [s]
  double bias = 4e-3;                ///< amplitude of the smooth error [m]
  double noise = 3e-5;               ///< noise of observed positions, per axis [m]
  double turn_noise = 0.0;           ///< noise of observed rotations [rad]
  int outliers = 2;                  ///< rows per trajectory that jump by 6 cm; all rows of the last one
  int placeholders = 1;              ///< rows per trajectory without an observation
  bool command = true;               ///< true: commanded poses too; false: the robot's kinematics alone
  double unit = 1.0;                 ///< unit that positions are written in [m]
  std::uint64_t seed = 1;
  std::uint64_t noise_seed = 0;  ///< seed of the noise; 0: from `seed`
};

/// Transform from observed to commanded poses, without the smooth error.
Eigen::Isometry3d sampleOffset();

std::string samplePoseTable(const SamplePoses& sample = {});
void writeSamplePoses(const std::filesystem::path& path, const SamplePoses& sample = {});

}  // namespace capstan::testing
