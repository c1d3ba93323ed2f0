#pragma once

#include <cstdint>

#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/report/report.h"

namespace capstan::testing {

/// What a diagnosis of a left RAVEN-II might report, without the engine that makes one: for tests of screens,
/// files and pages. Motion, residuals, statistics, signatures, gains and processes belong together and
/// follow from one another as in a real report; causes, ranking and refit are written to match.
struct SampleDiagnosis {
  /// kFound: backlash in joint 2; kSeveral: an eccentric capstan of joint 1 as well; kTie: backlash or
  /// hysteresis in joint 2; kNothing: noise alone; kUnexplained: a vibration of joint 3 at 7.3 Hz, and
  /// something that goes with the position of joint 1.
  diagnosis::Verdict verdict = diagnosis::Verdict::kFound;
  int recordings = 1;
  bool cameras = false;    ///< tip channels as well
  double duration = 24.0;  ///< of each recording [s], at 100 Hz
  std::uint64_t seed = 1;
};

diagnosis::Report sampleReport(const SampleDiagnosis& sample = {});

/// Of the recording `recording` (from 0), measured as sampleReport() has it.
diagnosis::Evidence sampleEvidence(const SampleDiagnosis& sample = {}, int recording = 0);

}  // namespace capstan::testing
