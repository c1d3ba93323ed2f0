#pragma once

#include <array>
#include <optional>

#include "core/learning/poses/pose_motion.h"
#include "core/learning/poses/rigid_offset.h"

namespace capstan::learning {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Windows of a state's motion history [s].
inline constexpr std::array kSpans = {0.1, 0.4, 1.6};

/// Mean velocity over each of kSpans.
using Drift = std::array<Vector6d, kSpans.size()>;
inline Drift atRest() {
  Drift drift;
  drift.fill(Vector6d::Zero());
  return drift;
}

/// An observed state and the commanded pose at that instant (GPR paper, section III: x_o = (p, ṗ) and p_c).
struct State {
  std::size_t motion = 0;  ///< place among the motions
  std::size_t row = 0;     ///< line of the camera's row
  double t = 0.0;          ///< of the camera's clock [s]
  PosePair pair;
  Vector6d velocity = Vector6d::Zero();  ///< of the observed pose, [m/s], then [rad/s] in its own frame
  /// Mean velocities of the last kSpans, likewise: cables that stick remember where they came from. Before
  /// the motion's first observation it stood still.
  Drift drift = atRest();
  /// Observation-noise inflation in learning: variance added to the common noise, of each output of a
  /// correction (PoseFeatures::correction): of the position [m²], then of the rotation [rad²].
  Vector6d extra_variance = Vector6d::Zero();
};

/// Of each state the place of its motion among those that have states; a motion's states stand together.
std::vector<std::size_t> motionPlaces(const std::vector<State>& states);

/// The observed and commanded pose of each.
std::vector<PosePair> pairsOf(const std::vector<State>& states);

/// A stream's pose at a time, between the two stamps around it: positions interpolated linearly, rotations
/// along the shorter arc. Nothing before the first, after the last or in a gap longer than kLongestGap.
std::optional<Eigen::Isometry3d> poseAt(const std::vector<StampedPose>& stream, double t);
inline constexpr double kLongestGap = 0.1;  ///< [s]

/// Every observation with its velocity (five-point stencil on the camera's own stamps), how it moved before,
/// and the pose of the commanded stream at t − clock_offset. Observations without such a pose are excluded.
std::vector<State> statesOf(const std::vector<PoseMotion>& motions, StreamKind reference,
                            double clock_offset);

/// States of a desired or observed path: poses, velocities and histories, without commanded poses.
std::vector<State> statesAlong(const std::vector<StampedPose>& path);

struct ClockOffsetOptions {
  double earliest = -0.1, latest = 0.4;  ///< [s]
  double step = 0.01;                    ///< of the first search [s]
};

struct ClockOffsetReport {
  double clock_offset = 0.0;          ///< of observations behind commands [s]
  double sigma = 0.0;                 ///< its standard deviation, from motion to motion by the jackknife [s]
  std::vector<double> tried, misfit;  ///< of the first search: RMS of the difference of speeds [m/s]
};

/// Offset of both clocks plus the robot's delay behind its command, by speeds, which no rigid offset
/// changes: least mean of |‖v_observed(t)‖ − ‖v_commanded(t − offset)‖|, robust against observations that
/// jump (differences beyond kJump count as that). A grid search first, then a parabola through the three grid points
/// around the minimum. All offsets are compared on the same observations: those with a commanded pose at each of them.
ClockOffsetReport clockOffsetBetween(const std::vector<PoseMotion>& motions, StreamKind reference,
                                     const ClockOffsetOptions& options = {});
inline constexpr double kJump = 0.05;  ///< [m/s]

}  // namespace capstan::learning
