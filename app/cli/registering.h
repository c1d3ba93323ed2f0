#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <string>

#include "core/tracking/options.h"
#include "core/tracking/source.h"

namespace capstan::cli {

/// Function that opens the same recording again, from its beginning.
using SourceFactory = std::function<std::unique_ptr<tracking::Source>()>;

/// Returns base_from_camera by a method of --register. "hard-stop": UKF paper (1) over frames at rest at the
/// hard stop, with the rotation of the file `mounting` or, without it, of the recording's stored
/// registration; "kinematics": rigid transform (Kabsch) from the observed to the kinematic tip over the whole
/// recording; other names: a file that writeRegistration() wrote. `message` gets a summary of the result.
/// Throws base::InputError.
Eigen::Isometry3d registerBy(const std::string& method, const std::string& mounting,
                             const SourceFactory& open, const tracking::TrackingOptions& options,
                             std::string& message);

}  // namespace capstan::cli
