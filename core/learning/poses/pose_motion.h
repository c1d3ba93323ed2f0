#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/base/names.h"

/// Motions of a tip as three streams of poses with time stamps: observed by cameras, computed by the robot's
/// forward kinematics, and commanded.
namespace capstan::learning {

enum class StreamKind { kCamera, kRobot, kCommand };
inline constexpr std::size_t kStreams = 3;

/// Reason why a row of a stream or a state is rejected.
enum class Reason {
  kNone,
  kNotFinite,     ///< an empty cell, NaN or infinity
  kPlaceholder,   ///< position 0 and no rotation: there is no pose
  kNoRotation,    ///< a quaternion whose norm is not 1
  kRepeat,        ///< the stamp of the row before
  kBackInTime,    ///< a stamp before that of the row before
  kOutlier,       ///< beyond the least median of squares
  kTooFarTurned,  ///< an orientation in which the markers are not visible
  kOutside,       ///< a position that the arm cannot reach
  kTooFast,       ///< a speed that the robot cannot reach
  kTurnsTooFast,
  kTrajectory,  ///< most of its trajectory was rejected
};

/// Pose of a table without any check.
struct RawPose {
  std::size_t row = 0;                                    ///< line of the file, for messages
  double t = 0.0;                                         ///< stamp [s] on the stream's own clock
  Eigen::Vector3d position = Eigen::Vector3d::Zero();     ///< [m]
  Eigen::Vector4d quaternion = Eigen::Vector4d::UnitW();  ///< x, y, z, w
};

struct RawMotion {
  std::string name;  ///< "task 1, trajectory 22"
  std::array<std::vector<RawPose>, kStreams> streams;
  std::string table = {};  ///< its file, for messages
};

struct StampedPose {
  std::size_t row = 0;
  double t = 0.0;  ///< [s]
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

/// Motion whose stamps strictly increase in each stream.
struct PoseMotion {
  std::string name;
  std::array<std::vector<StampedPose>, kStreams> streams;
  std::string table = {};
  const std::vector<StampedPose>& of(StreamKind kind) const {
    return streams[static_cast<std::size_t>(kind)];
  }
};

}  // namespace capstan::learning

template <>
struct capstan::base::NamesOf<capstan::learning::StreamKind> {
  using K = capstan::learning::StreamKind;
  static constexpr std::array value = {std::pair{K::kCamera, "camera"}, std::pair{K::kRobot, "robot"},
                                       std::pair{K::kCommand, "command"}};
};

template <>
struct capstan::base::NamesOf<capstan::learning::Reason> {
  using R = capstan::learning::Reason;
  static constexpr std::array value = {std::pair{R::kNone, "counts"},
                                       std::pair{R::kNotFinite, "not a number"},
                                       std::pair{R::kPlaceholder, "placeholder"},
                                       std::pair{R::kNoRotation, "no unit quaternion"},
                                       std::pair{R::kRepeat, "repeated row"},
                                       std::pair{R::kBackInTime, "goes back in time"},
                                       std::pair{R::kOutlier, "far from the consensus"},
                                       std::pair{R::kTooFarTurned, "rotated too far from the command"},
                                       std::pair{R::kOutside, "outside the workspace"},
                                       std::pair{R::kTooFast, "faster than the robot"},
                                       std::pair{R::kTurnsTooFast, "rotates faster than the robot"},
                                       std::pair{R::kTrajectory, "in a rejected trajectory"}};
};

template <>
struct capstan::base::KeysOf<capstan::learning::Reason> {
  using R = capstan::learning::Reason;
  static constexpr std::array value = {std::pair{R::kNone, "inlier"},
                                       std::pair{R::kNotFinite, "not_a_number"},
                                       std::pair{R::kPlaceholder, "placeholder"},
                                       std::pair{R::kNoRotation, "no_unit_quaternion"},
                                       std::pair{R::kRepeat, "repeated_row"},
                                       std::pair{R::kBackInTime, "back_in_time"},
                                       std::pair{R::kOutlier, "far_from_consensus"},
                                       std::pair{R::kTooFarTurned, "rotated_too_far"},
                                       std::pair{R::kOutside, "outside_workspace"},
                                       std::pair{R::kTooFast, "too_fast"},
                                       std::pair{R::kTurnsTooFast, "rotates_too_fast"},
                                       std::pair{R::kTrajectory, "rejected_trajectory"}};
};
