#pragma once

#include <Eigen/Geometry>
#include <QString>
#include <optional>

#include "core/registration/pose_collector.h"
#include "core/tracking/transmission_estimate.h"

namespace capstan::widgets {

/// "−1.23" of a length.
QString inMillimetres(double metres, int digits = 2);
/// Why poses by the robot file would mislead: what the augmented filter has found wrong in it; empty:
/// nothing.
QString wrongConstantsOf(const tracking::TransmissionEstimate& found);
/// Lines with the fit, which must exist, and its difference from `current`, the registration in use.
QString fitText(const registration::PoseCollector& collector,
                const std::optional<Eigen::Isometry3d>& current);
/// Result of the check at further poses, or what it does. Compares the fit, or else `current`.
QString closureText(const registration::PoseCollector& collector,
                    const std::optional<Eigen::Isometry3d>& current);

}  // namespace capstan::widgets
