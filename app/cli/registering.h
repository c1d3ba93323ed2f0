#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <string>

#include "core/tracking/options.h"
#include "core/tracking/source.h"

namespace capstan::cli {

/// Opens the same recording again, from its beginning.
using SourceFactory = std::function<std::unique_ptr<tracking::Source>()>;

/// base_from_camera by --register: "hard-stop" is UKF paper (1) over frames at rest at the hard stop;
/// "kinematics" is the rigid transform (Kabsch) from the seen to the kinematic tip over the whole recording;
/// anything else is a file as writeRegistration() writes it. The rotation of "hard-stop" is that of
/// `mounting` (a file) or, without one, of the recording's stored registration. `message` says what was
/// found. Throws base::InputError.
Eigen::Isometry3d registerBy(const std::string& method, const std::string& mounting,
                             const SourceFactory& open, const tracking::TrackingOptions& options,
                             std::string& message);

/// YAML: translation [m] and rotation (rows) of base_from_camera.
Eigen::Isometry3d readRegistration(const std::string& file);
void writeRegistration(const Eigen::Isometry3d& base_from_camera, const std::string& file);

}  // namespace capstan::cli
