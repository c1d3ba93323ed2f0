#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/registration/pose_collector.h"
#include "core/robot/description.h"

/// Comparison of two registrations of the same cameras.
namespace capstan::registration {

/// What changes when the registration `to` replaces the registration `from`.
struct RegistrationDifference {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< of the camera, t_to − t_from, in frame 0 [m]
  double rotation = 0.0;                                  ///< angle of R_to R_fromᵀ [rad], 0…π
  /// Displacement of the registered tip, |to from⁻¹ p − p|, over the tips p of the workspace [m].
  WorkspaceError tool;
};

/// Tips at 27 poses: each joint at its lower limit, in the middle and at its upper limit [m, frame 0].
std::vector<Eigen::Vector3d> workspaceTips(const robot::Description& robot);

/// Difference over workspaceTips() of `robot`.
RegistrationDifference differenceOf(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                                    const robot::Description& robot);

/// "translation 4.12 mm (1.00, −4.00, 0.00), rotation 0.53°, at the tool 3.20 mm, at most 5.10 mm over the
/// workspace".
std::string wordsOf(const RegistrationDifference& difference);

}  // namespace capstan::registration
