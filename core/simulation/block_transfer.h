#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/robot/arm_kinematics.h"
#include "core/simulation/trajectory.h"

namespace capstan::simulation {

/// Where the peg board stands: below the remote centre, in front of the cameras. Frame 0.
struct PegBoard {
  Eigen::Vector3d centre;   ///< of its surface [m]
  Eigen::Vector3d up;       ///< against gravity, unit
  Eigen::Vector3d lateral;  ///< across the cameras' view, unit
  Eigen::Vector3d depth;    ///< along the cameras' view, unit

  /// Place of peg 0…11 on the surface; 0…5 stand on one side, 6…11 on the other. Two columns of three a side.
  Eigen::Vector3d peg(int index) const;
};

/// `on_board`: joints that put the tip on its middle.
PegBoard pegBoard(const robot::Description& robot,
                  const Eigen::Vector3d& on_board = BlockTransferSpec{}.board);

/// The block-transfer task of the Fundamentals of Laparoscopic Surgery: each of six blocks is picked from its
/// peg, handed over in mid-air and placed on a peg of the other side; then all six go back. Cartesian
/// minimum-jerk segments, slightly bowed, with pauses for grasping, handing over and thinking, and 7–11 Hz
/// tremor; joints by inverse kinematics. Order, tempo, heights, pauses and tremor are drawn from the seed.
/// Below 80 s fewer blocks are moved, above 290 s the task is repeated. Throws base::InputError when the arm
/// does not reach the board.
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
    Eigen::Vector3d bow;                 // sideways excursion at half way [m]
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
