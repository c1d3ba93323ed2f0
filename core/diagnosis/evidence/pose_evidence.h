#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/table_files/read_columns.h"

namespace capstan::diagnosis {

/// One pose with its time stamp.
struct Pose {
  double t = 0.0;                                                ///< stamp on the clock of its source [s]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();            ///< [m]
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< identity where the table has none
  bool counts = true;                                            ///< false: an outlier
};

/// Observed, computed and commanded poses of one motion, each list with rising stamps.
struct PoseTrajectory {
  std::string name;           ///< "task 1, trajectory 22"
  std::vector<Pose> camera;   ///< tip poses that the cameras measured
  std::vector<Pose> robot;    ///< tip poses from the robot's forward kinematics
  std::vector<Pose> command;  ///< commanded tip poses
};

/// Counts of the rows of one list of poses (camera, robot or command), over all trajectories.
struct PoseCounts {
  std::size_t rows = 0;          ///< rows of the table
  std::size_t placeholders = 0;  ///< rows without a pose: identity poses and empty cells
  std::size_t repeats = 0;       ///< rows with the same stamp as the pose before
  std::size_t outliers = 0;
  std::size_t poses() const { return rows - placeholders - repeats; }
};

/// Recording of tip poses alone, without motor data.
struct PoseEvidence {
  std::string title;  ///< file name
  std::string file;
  std::vector<PoseTrajectory> trajectories;  ///< trajectories with at least two observations
  PoseCounts camera, robot, command;
  bool turns = false;                ///< true if the robot's or the commanded poses have orientations
  std::vector<std::string> notices;  ///< remarks for the user, one line each
};

/// Outlier limits of observations: a speed above that of any surgical robot's tip [m/s], and the scatter that
/// is allowed in addition [m].
inline constexpr double kFastestTip = 0.5, kStray = 1e-3;

/// True if the line is the header of a table of tip poses: it has the columns traj, t_cam_s and cam_x.
bool isPoseTable(std::string_view header_line);

/// Parses a table with the columns traj, t_cam_s, cam_x, cam_y, cam_z, and the same columns for robot or cmd
/// or both; optional are qx, qy, qz, qw of each, and task. Stamps are in seconds, on a clock per list.
/// Positions are in metres, all nominally in one frame. Rows of one trajectory are consecutive.
///
/// A pose with zero position and the rotation (0, 0, 0, ±1), or with an empty cell, is a placeholder. A pose
/// with the same stamp as the pose before is a repeat. Both are excluded and counted. Inliers are the longest
/// sequence of observations in which the tip moves at most kFastestTip × time + kStray between neighbours;
/// the other observations are outliers. Throws base::InputError with file, line, column, value and remedy if
/// a column is missing, if the norm of an orientation differs from 1 by more than 1 %, if stamps go back
/// within a trajectory, and if no trajectory has two observations and two poses to compare with.
PoseEvidence parsePoseEvidence(std::string_view text, const std::string& file);
/// parsePoseEvidence() of a file, and of columns that are in memory.
PoseEvidence readPoseEvidence(const std::filesystem::path& path);
PoseEvidence readPoseEvidence(const table_files::ColumnReader& columns, const std::string& file);

}  // namespace capstan::diagnosis
