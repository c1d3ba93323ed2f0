#pragma once

#include <Eigen/Core>

#include "core/simulation/trajectory.h"

namespace capstan::simulation {

enum class MotionCommand { kRun, kHold, kHardStop };

/// Desired joints over time: a trajectory, interrupted by commands. Holding slows time along the path down to
/// a halt within half a second, so that the path is never left; the hard stop is then a quintic away and
/// back.
class Commander {
 public:
  Commander(const Trajectory& trajectory, const Eigen::Vector3d& hard_stop);

  void command(MotionCommand command) { command_ = command; }
  /// The target `dt` [s] after the last.
  JointTarget step(double dt);
  JointTarget target() const;

  bool finished() const;    ///< at the end of the trajectory, and not away from it
  bool atHardStop() const;  ///< for at least a third of a second
  double pathTime() const { return path_time_; }

 private:
  enum class Excursion { kNone, kAway, kThere, kBack };
  void stepExcursion(double dt);
  void begin(Excursion excursion, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

  const Trajectory& trajectory_;
  Eigen::Vector3d hard_stop_;
  MotionCommand command_ = MotionCommand::kRun;
  double path_time_ = 0.0;
  double rate_ = 0.0;  // of path time by time
  Excursion excursion_ = Excursion::kNone;
  double elapsed_ = 0.0, length_ = 0.0;  // of the excursion's present part [s]
  Eigen::Vector3d from_, to_;
};

}  // namespace capstan::simulation
