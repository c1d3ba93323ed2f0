#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/simulation/trajectory.h"

namespace capstan::simulation {

enum class MotionCommand { kRun, kHold, kHardStop, kMotion };

/// Desired joints over time: a trajectory that commands can interrupt. kHold slows the time along the path to
/// a halt within half a second, so the arm stays on the path. kHardStop halts likewise, then moves to the
/// hard stop on a quintic; the next command moves back on a quintic. kMotion halts, moves to the start of
/// another motion on a quintic, follows it to its end, and moves back; another command ends it within half a
/// second.
class Commander {
 public:
  Commander(const Trajectory& trajectory, const Eigen::Vector3d& hard_stop);

  void command(MotionCommand command) {
    command_ = command;
    motion_done_ = motion_done_ && command == MotionCommand::kMotion;
  }
  /// Motion of kMotion, from rest to rest. Replaces one that is followed already.
  void setMotion(std::shared_ptr<const Trajectory> motion) { next_ = std::move(motion); }
  /// Advances by `dt` [s] and returns the new target.
  JointTarget step(double dt);
  JointTarget target() const;

  bool finished() const;    ///< true at the end of the trajectory, while running and on the path
  bool atHardStop() const;  ///< true after a third of a second at the hard stop
  /// True when the motion has come to its end, until the next command.
  bool motionDone() const { return motion_done_; }
  double pathTime() const { return path_time_; }  ///< time along the path [s]

 private:
  enum class Excursion { kNone, kAway, kThere, kBack, kToMotion, kMotion };
  void stepExcursion(double dt);
  void stepMotion(double dt);
  void begin(Excursion excursion, const Eigen::Vector3d& from, const Eigen::Vector3d& to);

  const Trajectory& trajectory_;
  Eigen::Vector3d hard_stop_;
  MotionCommand command_ = MotionCommand::kRun;
  double path_time_ = 0.0;
  double rate_ = 0.0;  // path time per time [s/s]
  Excursion excursion_ = Excursion::kNone;
  double elapsed_ = 0.0, length_ = 0.0;  // time in the present part of the excursion, and its duration [s]
  Eigen::Vector3d from_, to_;
  std::shared_ptr<const Trajectory> motion_, next_;  // followed now, and to be followed
  double motion_time_ = 0.0, motion_rate_ = 0.0;     // along motion_
  bool motion_done_ = false;
};

}  // namespace capstan::simulation
