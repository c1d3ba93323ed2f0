#pragma once

#include <filesystem>
#include <string_view>

#include "core/robot/description.h"
#include "core/session/measured_table.h"

namespace capstan::session {

/// Does the header line belong to a recording of the RAVEN-II's own software (mpos1_deg, …)?
bool isRavenMotors(std::string_view header_line);

/// Imports a recording of the RAVEN-II's own software as a measured table.
///
/// The file: motor positions mpos in degrees of the motor shaft, motor zero at JOINT zero; joint positions
/// jpos in degrees, the insertion axis too, as metres times 180/π; speeds likewise; tau a torque command
/// [N·m]. Ours: q_m from the hard stop, q in rad, rad, m. Both have s_m = r_mc q_m / N, so a shift of motor
/// zero by what the hard stop is away from joint zero remains:
///
///     q_m = m · π/180 − (N / r_mc) r_l ∘ (A q_hs)
///
/// Joint columns become the reference q; nothing else is dropped. Throws base::InputError like
/// readMeasuredTable().
MeasuredTable readRavenMotors(const std::filesystem::path& path, const robot::Description& robot);

}  // namespace capstan::session
