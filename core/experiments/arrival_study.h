#pragma once

#include <array>
#include <vector>

#include "core/experiments/training_motions.h"

/// Table II of the GPR paper: accuracy and repeatability of an arm that moves to fragments without observing
/// the tool.
namespace capstan::experiments {

struct ArrivalOptions {
  int locations = 10;                       ///< number of locations
  int repetitions = 10;                     ///< number of arrivals per location
  int waypoints = 10;                       ///< number of waypoints per motion
  double speed = 0.05;                      ///< speed of the tool [m/s]
  static constexpr double kSettle = 0.5;    ///< time at rest before a measurement [s]
  static constexpr double kMostYaw = 0.35;  ///< largest yaw of a fragment [rad]
  int threads = 2;                          ///< number of modes in parallel; the result does not depend on it
  std::uint64_t seed = 1;
};

/// Throws base::InputError for options out of range.
void checkArrival(const ArrivalOptions& options);

/// Errors of the tool's rest poses against the desired poses, over all arrivals. The poses are those of the
/// cameras with their registration errors, without noise and jumps.
struct ArrivalErrors {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< means of |x|, |y|, |z| [m]
  /// The paper's repeatability: standard deviation of the position between arrivals at one location, pooled
  /// over locations [m].
  Eigen::Vector3d repeatability = Eigen::Vector3d::Zero();
  double distance = 0.0, distance_deviation = 0.0;  ///< mean and standard deviation of the distance [m]
  double angle = 0.0, angle_deviation = 0.0;        ///< mean and standard deviation of the angle [rad]
  double confidence = 0.0;        ///< mean confidence of the correction at the ends of motions
  std::vector<double> distances;  ///< distance of each arrival [m]
  int arrived = 0;                ///< number of arrivals; locations out of reach have none
};

using ArrivalReport = std::array<ArrivalErrors, learning::kCorrectionModes>;

/// Runs the study: in each mode, an arm of the same truth moves to locations drawn on the grid. Their order
/// is another one in each repetition, so that the arm arrives from different sides. Cancelled modes have
/// fewer arrivals. Throws base::InputError as checkArrival().
ArrivalReport arrivalStudy(const robot::Description& robot, const simulation::ToolTruth& truth,
                           const learning::CorrectionModel& model, const ArrivalOptions& options,
                           const base::Progress* progress = nullptr);

}  // namespace capstan::experiments
