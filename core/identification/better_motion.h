#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/identification/camera_pose.h"
#include "core/identification/estimate.h"
#include "core/identification/identification_data.h"

/// Proposes a motion that determines what a recording leaves weak.
namespace capstan::identification {

/// Sinusoid per joint: q_i(t) = centre_i + amplitude_i sin(2π frequency_i t) · ramp(t), where the ramp takes
/// kRamp at each end.
struct SinusoidMotion {
  static constexpr double kRamp = 2.0;                  ///< [s]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();     ///< [rad, rad, m]
  Eigen::Vector3d amplitude = Eigen::Vector3d::Zero();  ///< [rad, rad, m]
  Eigen::Vector3d frequency = Eigen::Vector3d::Zero();  ///< [Hz]
  double duration = 40.0;                               ///< [s]

  Eigen::Vector3d at(double t) const;
};

/// Motions within the joint limits and 80 % of the highest speeds: slow and wide (pulley radii), medium, and
/// fast with many reversals (damping, friction), each about the middle of the workspace and reaching out and
/// raised (loads of gravity on the cables: stiffness).
std::vector<SinusoidMotion> candidateMotions(const robot::Description& robot);

struct MotionProposal {
  SinusoidMotion motion;
  std::vector<int> weak;          ///< parameters that it is for, by their index in the set
  std::vector<double> now, then;  ///< σ of ln w of every parameter by the recording, and with the motion
  std::string words;              ///< the motion and what it is predicted to bring
};

/// Indices of the parameters that are not observable; where there are none, of those beyond their goal.
std::vector<int> weakOf(const std::vector<Estimate>& estimates);

/// The candidate that reduces the σ of the weak parameters most, as a product of their ratios to the goals.
/// The motions are ordered by the σ of the linear model at the estimates, with the recording's mean camera
/// noise and 15 frames per second. What is stated of the best one is the σ of the batch method, model
/// discrepancy included (identifyBatch()). Information adds to that of the estimates' σ. Nothing where no
/// parameter is weak, where there are no observations, or when cancelled.
std::optional<MotionProposal> proposeMotion(const IdentificationData& recorded, const ParameterSet& set,
                                            const std::vector<Estimate>& estimates,
                                            const CameraPoseOptions& camera, base::Progress& progress);

}  // namespace capstan::identification
