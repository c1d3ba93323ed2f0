#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/identification/estimate.h"
#include "core/identification/identification_data.h"

namespace capstan::identification {

/// RMS of the joints by inverse kinematics of the observed tip minus those of the model [rad, rad, m], over
/// the observations of one recording. Joint encoders are not needed; errors of the registration and the noise
/// of the cameras are in both numbers.
struct ModelError {
  Eigen::Vector3d before = Eigen::Vector3d::Zero();  ///< with the nominal parameters
  Eigen::Vector3d after = Eigen::Vector3d::Zero();   ///< with the observable estimates
  int observations = 0;
};

/// Errors of the filter's link dynamics (Shooting) over `data`, before and after. Nothing without
/// observations or when cancelled.
std::optional<ModelError> modelErrorOf(const IdentificationData& data, const ParameterSet& set,
                                       const std::vector<Estimate>& estimates,
                                       const base::Progress* progress = nullptr);

}  // namespace capstan::identification
