#pragma once

#include <filesystem>
#include <string_view>

#include "core/recording/measured_table.h"
#include "core/robot/description.h"

namespace capstan::recording {

/// True if the header line is that of a recording by the RAVEN-II's own software (mpos1_deg, …).
bool isRavenMotors(std::string_view header_line);

/// Imports a recording of the RAVEN-II's own software as a measured table.
///
/// The file contains motor positions m in degrees of the motor shaft, with the motor zero at JOINT zero;
/// joint positions in degrees (for the insertion axis: metres times 180/π); speeds in the same units per
/// second; and torque commands, which are not converted. The robot's software computes joints from motors by
/// A q = m / TR, TR = N r / r_mc = 136.196, 121.522, 2158.59 rad/m. Its pulley radius r2 is 56.297 mm; the
/// published model rounds it to 56.298 mm. The measured table counts q_m from the hard stop, so that the
/// published model's transmission, s_l = r_l ∘ A (q − q_hs) = r_mc q_m / N, gives the same joints:
///
///     q_m = f ∘ (m π/180 − TR ∘ (A q_hs)),   f = (1, 56.298 / 56.297, 1)
///
/// A and q_hs are those of `robot`. Its pulley radii are not used, so that tracking can detect a different
/// radius. Joint columns become the reference q, marked as the robot's own kinematics (no truth). Throws
/// base::InputError like readMeasuredTable().
MeasuredTable readRavenMotors(const std::filesystem::path& path, const robot::Description& robot);

}  // namespace capstan::recording
