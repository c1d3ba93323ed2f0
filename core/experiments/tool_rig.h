#pragma once

#include <optional>
#include <vector>

#include "core/learning/model/command_correction.h"
#include "core/simulation/pose_camera.h"
#include "core/simulation/tool_robot.h"

namespace capstan::experiments {

/// A simulated arm under motion capture, as someone works with it who knows neither: commands go in, poses of
/// cameras, commands and nominal kinematics come out.
class ToolRig {
 public:
  /// base::InputError as ToolRobot.
  ToolRig(const robot::Description& nominal, const simulation::ToolTruth& truth,
          const robot::JointVector& start, std::uint64_t seed);

  /// Whatever happens from now on is written there; null: nowhere.
  void recordTo(learning::RawMotion* motion) { recording_ = motion; }

  /// Asks for the path's commands at its times, between waypoints for what lies between. A path that is out
  /// of reach is not begun: false.
  bool follow(const std::vector<learning::CorrectedWaypoint>& path);
  void rest(double seconds);
  /// Opens or closes the jaws evenly to `opening` [rad].
  void moveJaws(double opening, double seconds);
  /// Holds still and returns the median of the poses that cameras observed meanwhile. Nothing:
  /// they saw none.
  std::optional<Eigen::Isometry3d> look(double seconds);

  /// Of commands with the jaws as they are now.
  learning::Reachable reachable() const;
  double time() const { return robot_.time(); }  ///< [s]
  const Eigen::Isometry3d& commanded() const { return robot_.commanded(); }
  const simulation::ToolRobot& robot() const { return robot_; }
  const simulation::PoseCamera& camera() const { return camera_; }
  int refused() const { return refused_; }  ///< commands that the robot did not take

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
