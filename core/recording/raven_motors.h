#pragma once

#include <filesystem>
#include <string_view>

#include "core/recording/measured_table.h"
#include "core/robot/description.h"

namespace capstan::recording {

/// Does the header line belong to a recording of the RAVEN-II's own software (mpos1_deg, …)?
bool isRavenMotors(std::string_view header_line);

/// Imports a recording of the RAVEN-II's own software as a measured table.
///
/// The file: motor positions m in degrees of the motor shaft, motor zero at JOINT zero; joint positions in
/// degrees, the insertion axis too, as metres times 180/π; speeds likewise; torque commands as they are. The
/// software turns motors into joints by A q = m / TR, TR = N r / r_mc = 136.196, 121.522, 2158.59 rad/m, its
/// own pulley radius r2 being 56.297 mm where the published model rounds to 56.298 mm. Ours: q_m from the
/// hard stop, so that the published model's transmission, s_l = r_l ∘ A (q − q_hs) = r_mc q_m / N, gives the
/// same joints:
///
///     q_m = f ∘ (m π/180 − TR ∘ (A q_hs)),   f = (1, 56.298 / 56.297, 1)
///
/// A and q_hs are `robot`'s; its pulley radii do not enter, so that another radius shows in what tracking
/// makes of the table. Joint columns become the reference q, marked as the robot's own kinematics: no truth.
/// Throws base::InputError like readMeasuredTable().
MeasuredTable readRavenMotors(const std::filesystem::path& path, const robot::Description& robot);

}  // namespace capstan::recording
