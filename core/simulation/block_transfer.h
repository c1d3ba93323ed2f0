#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/robot/arm_kinematics.h"
#include "core/simulation/trajectory.h"

namespace capstan::simulation {

/// Pose of the peg board in frame 0: below the remote centre, in front of the cameras.
struct PegBoard {
  Eigen::Vector3d centre;   ///< centre of the surface [m]
  Eigen::Vector3d up;       ///< unit vector against gravity
  Eigen::Vector3d lateral;  ///< unit vector across the cameras' view
  Eigen::Vector3d depth;    ///< unit vector along the cameras' view

  /// Position of peg 0…11 on the surface [m]. Pegs 0…5 stand on one side, 6…11 on the other side, in two
  /// columns of three per side.
  Eigen::Vector3d peg(int index) const;
};

/// Peg board of `robot`. `on_board` [rad, rad, m]: joint positions with the tip on the middle of the board.
PegBoard pegBoard(const robot::Description& robot,
                  const Eigen::Vector3d& on_board = BlockTransferSpec{}.board);

/// The block-transfer task of the Fundamentals of Laparoscopic Surgery (FLS): each of six blocks is picked
/// from its peg, handed over in mid-air and placed on a peg of the other side; then all six are moved back.
/// The path has Cartesian minimum-jerk segments, slightly curved, pauses for grasping, handing over and
/// thinking, and 7–11 Hz tremor. Joints follow by inverse kinematics. Order, tempo, heights, pauses and
/// tremor are drawn from the seed. Below 80 s fewer blocks are moved, above 290 s the task is repeated.
/// Throws base::InputError when the arm does not reach the board.
class BlockTransfer final : public Trajectory {
 public:
  BlockTransfer(const BlockTransferSpec& spec, double duration, const robot::Description& robot,
                std::uint64_t seed);

  JointTarget at(double t) const override;
  double duration() const override { return duration_; }
  double nextInstant(double t) const override;
  int transfers() const { return transfers_; }

  /// Desired tip position [m] and velocity [m/s], frame 0.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> tipAt(double t) const;

 private:
  struct Segment {
    double start = 0.0, duration = 0.0;  // [s]
    Eigen::Vector3d from, to;            // [m]
    Eigen::Vector3d bow;                 // lateral deviation at half of the way [m]
  };
  struct Tone {
    double amplitude, frequency, phase;  // [m], [Hz], [rad]
  };
  class Planner;
  void requireReach() const;
  const Segment& segmentAt(double along) const;
  std::pair<double, double> pathTime(double t) const;

  double duration_;
  int transfers_ = 0;
  robot::ArmKinematics kinematics_;
  Eigen::Vector3d near_;
  std::vector<Segment> segments_;
  std::array<std::array<Tone, 3>, 3> tremor_;  // axis, tone
};

}  // namespace capstan::simulation
