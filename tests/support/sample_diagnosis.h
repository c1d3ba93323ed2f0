#pragma once

#include <cstdint>

#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/report/report.h"

namespace capstan::testing {

/// Sample report of a left RAVEN-II, made without the diagnosis engine, for tests of panels, files and pages.
/// Motion, residuals, statistics, signatures, gains and processes are computed from one another as in a real
/// report; causes, posterior, ranking and refit are written by hand to match. With causes, an asymmetric
/// friction of joint 1 that moves less than the tolerance is also measurable.
struct SampleDiagnosis {
  /// kFound: backlash in joint 2; kSeveral: an eccentric capstan of joint 1 as well; kTie: backlash or
  /// hysteresis in joint 2; kNothing: noise alone; kUnexplained: a vibration of joint 3 at 7.3 Hz, and a
  /// residual that depends on the position of joint 1.
  diagnosis::Verdict verdict = diagnosis::Verdict::kFound;
  int recordings = 1;
  bool cameras = false;    ///< true: tip channels as well
  double duration = 24.0;  ///< duration of each recording [s], at 100 Hz
  std::uint64_t seed = 1;
};

diagnosis::Report sampleReport(const SampleDiagnosis& sample = {});

/// Evidence of the recording `recording` (from 0) of sampleReport().
diagnosis::Evidence sampleEvidence(const SampleDiagnosis& sample = {}, int recording = 0);

}  // namespace capstan::testing
