#pragma once

#include <array>
#include <vector>

#include "core/experiments/training_motions.h"

/// Table II of the GPR paper: how near, and how repeatably, an arm arrives at fragments that it moves to
/// without looking.
namespace capstan::experiments {

struct ArrivalOptions {
  int locations = 10;
  int repetitions = 10;    ///< of each
  int waypoints = 10;      ///< of each motion
  double speed = 0.05;     ///< [m/s]
  double settle = 0.5;     ///< at rest, before it is measured [s]
  double most_yaw = 0.35;  ///< [rad]
  int threads = 2;         ///< modes at the same time; the result does not depend on it
  std::uint64_t seed = 1;
};

/// base::InputError: options that make no sense.
void checkArrival(const ArrivalOptions& options);

/// Of where the tool rests from what was desired, over all arrivals: as cameras see it, their registration's
/// errors with it, without their noise and jumps.
struct ArrivalErrors {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< of |x|, |y|, |z| [m]
  /// Of the place where the tool arrives, standard deviation between arrivals at one location, pooled over
  /// locations: the paper's repeatability [m].
  Eigen::Vector3d repeatability = Eigen::Vector3d::Zero();
  double distance = 0.0, distance_deviation = 0.0;  ///< of all arrivals [m]
  double angle = 0.0, angle_deviation = 0.0;        ///< [rad]
  double confidence = 0.0;                          ///< mean, where the motions ended
  std::vector<double> distances;                    ///< of each arrival [m]
  int arrived = 0;                                  ///< arrivals; a location out of reach counts none
};

using ArrivalReport = std::array<ArrivalErrors, learning::kCorrectionModes>;

/// The tool moves to the locations drawn on the grid in turn, in another order each time, so that the arm
/// comes from another side each time; in each mode on an arm of the same truth. Modes that were cancelled
/// have fewer arrivals. base::InputError as checkArrival.
ArrivalReport arrivalStudy(const robot::Description& robot, const simulation::ToolTruth& truth,
                           const learning::CorrectionModel& model, const ArrivalOptions& options,
                           const base::Progress* progress = nullptr);

}  // namespace capstan::experiments
