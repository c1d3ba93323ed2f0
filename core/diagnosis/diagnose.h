#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/evidence/encoder_zeros.h"
#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/report/report.h"
#include "core/robot/description.h"

namespace capstan::diagnosis {

/// A rigid drive's simulation restarts so often in the fits [s]. Effects are sought over the near horizon
/// first, from which every fit finds its least, then over the far one, where slow ones show. Cameras alone
/// need time to determine the state at a window's start: they use the far horizon only.
inline constexpr double kNearHorizon = 0.5, kFarHorizon = 2.0;

struct DiagnosisOptions {
  int threads = 2;
  int most_causes = 6;     ///< largest set of effects that is tried
  Tolerance material = {};  ///< what an effect must move to be a cause
  EncoderZeros zeros = EncoderZeros::kOnePerRecording;  ///< of cable drives
  bool show =
      true;  ///< also traces and signatures of every channel; false: verdict, causes and ranking alone
  bool filter = true;  ///< also what the Kalman filter gains (three-joint cable arms with both sensors)
  std::vector<std::string> only;  ///< names of hypotheses to consider; empty: all
  std::uint64_t seed = 1;         ///< of the bootstraps
};

/// Shows what the nominal robot's simulation gets wrong in recordings of one robot, names the cause, extends
/// the model and measures the gain: refit, screen, select (selection.h), judge (verdict.h). Deterministic:
/// the same evidence and options give the same report, whatever the threads. base::InputError: no recordings;
/// recordings of different drives or joints; an unknown name in `only`. Cancelled through `progress`:
/// Report::cancelled, with what there is.
Report diagnose(const std::vector<Evidence>& recordings, const robot::Description& nominal,
                const DiagnosisOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::diagnosis
