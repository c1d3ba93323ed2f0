#pragma once

#include <array>

#include "tests/support/sample_diagnosis.h"

namespace capstan::testing {

/// The motion behind a sample: what was measured, and the three models of it.
struct SampleMotion {
  diagnosis::Evidence evidence;
  diagnosis::SimulatedMotion nominal, refitted, extended;
};

SampleMotion sampleMotion(const SampleDiagnosis& sample, int recording, const robot::Description& robot);

inline constexpr double kSampleBacklash = 0.9e-3;      ///< half width, at the cable [m]
inline constexpr double kSampleEccentricity = 0.4e-3;  ///< of joint 1's capstan [m]
inline constexpr double kSampleVibration = 7.3;        ///< of joint 3 [Hz]

}  // namespace capstan::testing
