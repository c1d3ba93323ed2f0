#pragma once

#include <array>

#include "tests/support/sample_diagnosis.h"

namespace capstan::testing {

/// Motion behind a sample report: measured, and simulated with the three models.
struct SampleMotion {
  diagnosis::Evidence evidence;
  diagnosis::SimulatedMotion nominal, refitted, extended;
};

SampleMotion sampleMotion(const SampleDiagnosis& sample, int recording, const robot::Description& robot);

inline constexpr double kSampleBacklash = 0.9e-3;      ///< half width of joint 2's backlash, at the cable [m]
inline constexpr double kSampleEccentricity = 0.4e-3;  ///< eccentricity of joint 1's capstan [m]
inline constexpr double kSampleVibration = 7.3;        ///< frequency of joint 3's vibration [Hz]

}  // namespace capstan::testing
