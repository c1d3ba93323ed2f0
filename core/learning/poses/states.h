#pragma once

#include <array>
#include <optional>

#include "core/learning/poses/pose_motion.h"
#include "core/learning/poses/rigid_offset.h"

namespace capstan::learning {

using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Lengths of the windows of a state's motion history [s].
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
  std::size_t motion = 0;  ///< index of the motion
  std::size_t row = 0;     ///< line of the camera's row in the file
  double t = 0.0;          ///< time on the camera's clock [s]
  PosePair pair;
  /// Velocity of the observed pose [m/s], then its rotation rate in its own frame [rad/s].
  Vector6d velocity = Vector6d::Zero();
  /// Mean velocities over the last kSpans, in the same units. They are features because cables with stiction
  /// depend on the previous motion. Before its first observation a motion is assumed to be at rest.
  Drift drift = atRest();
  /// Observation-noise inflation in learning: variance added to the common noise of each output of a
  /// correction (PoseFeatures::correction), for the position [m²], then for the rotation [rad²].
  Vector6d extra_variance = Vector6d::Zero();
};

/// Index of each state's motion among the motions with states. States of a motion are contiguous.
std::vector<std::size_t> motionPlaces(const std::vector<State>& states);

/// Observed and commanded pose of each state.
std::vector<PosePair> pairsOf(const std::vector<State>& states);

/// Pose of a stream at time t [s], interpolated between the two stamps around t: positions linearly,
/// rotations along the shorter arc. Nothing before the first stamp, after the last one, or in a gap longer
/// than kLongestGap.
std::optional<Eigen::Isometry3d> poseAt(const std::vector<StampedPose>& stream, double t);
inline constexpr double kLongestGap = 0.1;  ///< [s]

/// States of all observations: velocity (five-point stencil on the camera's own stamps), motion history, and
/// the pose of the stream `reference` at t − clock_offset. Observations without such a pose are excluded.
std::vector<State> statesOf(const std::vector<PoseMotion>& motions, StreamKind reference,
                            double clock_offset);

/// States of a desired or observed path: poses, velocities and motion histories, without commanded poses.
std::vector<State> statesAlong(const std::vector<StampedPose>& path);

struct ClockOffsetReport {
  double clock_offset = 0.0;  ///< delay of observations behind commands [s]
  double sigma = 0.0;         ///< standard deviation of the offset by the jackknife over motions [s]
  /// Offsets of the grid search [s], and the mean absolute difference of speeds of each [m/s].
  std::vector<double> tried, misfit;
};

/// Offset between both clocks plus the robot's delay behind its command [s]. It minimizes the mean of
/// |‖v_observed(t)‖ − ‖v_commanded(t − offset)‖|, because a rigid offset does not change speeds. Differences
/// are limited to kJump, for robustness against jumping observations. A grid search is refined by a parabola
/// through the three grid points around the minimum. All offsets are compared on the same observations: those
/// with a commanded pose at every offset.
ClockOffsetReport clockOffsetBetween(const std::vector<PoseMotion>& motions, StreamKind reference);
inline constexpr double kJump = 0.05;  ///< [m/s]

}  // namespace capstan::learning
