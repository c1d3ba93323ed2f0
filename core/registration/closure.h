#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "core/registration/pair_registration.h"
#include "core/registration/pose_collector.h"

/// Check of a registration at poses that it was not computed from.
namespace capstan::registration {

/// A check holds where its error is below this many standard deviations.
inline constexpr double kClosureSigmas = 3.0;

struct Closure {
  double error = 0.0;  ///< distance of the marker, transformed to frame 0, from the tip [m]
  double sigma = 0.0;  ///< its predicted RMS [m]

  bool holds() const { return error <= kClosureSigmas * sigma; }
};

/// Closure at each pose by a fit of other poses. The prediction has the fit's covariance and the standard
/// deviation of its pairs.
std::vector<Closure> closuresOf(const PairRegistration& fit, std::span<const CollectedPose> poses);

/// Closure at each pose by `base_from_camera`. The prediction has the uncertainty of the camera's point only:
/// it is that of a registration and a robot file without errors.
std::vector<Closure> closuresOf(const Eigen::Isometry3d& base_from_camera,
                                std::span<const CollectedPose> poses);

/// One sentence on the closures: whether they hold, and what to suspect where one does not. Empty without
/// closures.
std::string closureWords(std::span<const Closure> closures);

}  // namespace capstan::registration
