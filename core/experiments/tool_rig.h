#pragma once

#include <optional>
#include <vector>

#include "core/learning/model/command_correction.h"
#include "core/simulation/pose_camera.h"
#include "core/simulation/tool_robot.h"

namespace capstan::experiments {

/// A simulated arm under motion capture, seen from outside: it takes commands and gives the poses of cameras,
/// commands and nominal kinematics.
class ToolRig {
 public:
  /// Throws base::InputError as ToolRobot.
  ToolRig(const robot::Description& nominal, const simulation::ToolTruth& truth,
          const robot::JointVector& start, std::uint64_t seed);

  /// Records all poses into `motion` from now on; null: nowhere.
  void recordTo(learning::RawMotion* motion) { recording_ = motion; }

  /// Sends the commands of `path` at their times, interpolated between waypoints. Returns false, without
  /// motion, when the path is out of reach.
  bool follow(const std::vector<learning::CorrectedWaypoint>& path);
  void rest(double seconds);
  /// Moves the jaws at constant rate to `opening` [rad].
  void moveJaws(double opening, double seconds);
  /// Holds still for `seconds` and returns the median of the observed poses; nothing when none was observed.
  std::optional<Eigen::Isometry3d> look(double seconds);

  /// Test whether a command is reachable with the present opening of the jaws.
  learning::Reachable reachable() const;
  double time() const { return robot_.time(); }  ///< [s]
  const Eigen::Isometry3d& commanded() const { return robot_.commanded(); }
  const simulation::ToolRobot& robot() const { return robot_; }
  const simulation::PoseCamera& camera() const { return camera_; }
  int refused() const { return refused_; }  ///< number of refused commands

 private:
  void tick(const Eigen::Isometry3d& command);
  void write(learning::StreamKind stream, double t, const Eigen::Isometry3d& pose);

  simulation::ToolRobot robot_;
  simulation::PoseCamera camera_;
  double opening_;
  int refused_ = 0;
  learning::RawMotion* recording_ = nullptr;
  std::vector<Eigen::Isometry3d>* observing_ = nullptr;
};

}  // namespace capstan::experiments
