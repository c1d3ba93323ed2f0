#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace capstan::diagnosis {

/// Where something was at an instant of its own clock.
struct Pose {
  double t = 0.0;                                                ///< stamp [s]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();            ///< [m]
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< identity where the table has none
  bool counts = true;                                            ///< false: an outlier
};

/// One motion, each list with rising stamps.
struct PoseTrajectory {
  std::string name;           ///< "task 1, trajectory 22"
  std::vector<Pose> camera;   ///< what cameras saw of the tip
  std::vector<Pose> robot;    ///< the robot's forward kinematics
  std::vector<Pose> command;  ///< what it was commanded
};

/// What the table had of one list of poses, over all trajectories.
struct PoseCounts {
  std::size_t rows = 0;          ///< of the table
  std::size_t placeholders = 0;  ///< identity poses and empty cells, which say that there is no pose
  std::size_t repeats = 0;       ///< rows that carry the last pose again, by their stamp
  std::size_t outliers = 0;
  std::size_t poses() const { return rows - placeholders - repeats; }
};

/// A table of tip poses without motor data.
struct PoseEvidence {
  std::string title;  ///< file name
  std::string file;
  std::vector<PoseTrajectory> trajectories;  ///< those with two observations at least
  PoseCounts camera, robot, command;
  bool turns = false;                ///< are there orientations of the robot?
  std::vector<std::string> notices;  ///< for the user, a line each
};

/// Faster than any tip of a surgical robot [m/s], and what an observation may stray beside it [m].
inline constexpr double kFastestTip = 0.5, kStray = 1e-3;

/// Is this the first line of such a table? It has traj, t_cam_s and cam_x.
bool isPoseTable(std::string_view header_line);

/// Parses a table with columns traj, t_cam_s, cam_x, cam_y, cam_z and the same of robot or cmd (or both),
/// with qx, qy, qz, qw of each where known, and task; stamps in seconds, each list's own clock; metres;
/// positions of all in one frame as far as anybody knew. Rows of one trajectory stand together.
///
/// A pose of zeros with a rotation of (0, 0, 0, ±1), and a pose with an empty cell, is a placeholder; a stamp
/// that is the one before's is a repeat. Both are excluded and counted. Outliers among the observations are
/// those beyond the largest set that a tip could have passed through: from one to the next at most
/// kFastestTip and kStray. base::InputError naming file, line, column, value and remedy: a column that is
/// missing, an orientation that is none (norm not 1 within 1 %), stamps that go back within a trajectory, no
/// trajectory with two observations and two poses to compare with.
PoseEvidence parsePoseEvidence(std::string_view text, const std::string& file);
PoseEvidence readPoseEvidence(const std::filesystem::path& path);

}  // namespace capstan::diagnosis
