#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/evidence/encoder_zeros.h"
#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/report/report.h"
#include "core/robot/description.h"

namespace capstan::diagnosis {

struct DiagnosisOptions {
  int threads = 2;                                      ///< number of worker threads
  int most_causes = 6;                                  ///< largest number of effects in a model
  Tolerance material = {};                              ///< displacement from which on an effect is a cause
  EncoderZeros zeros = EncoderZeros::kOnePerRecording;  ///< zeros of joint encoders, for cable drives
  /// True: the report also has time series and signatures of every channel (Signature: how the residual
  /// depends on a variable). False: verdict, causes and ranking alone.
  bool show = true;
  /// True: the report also states how much the error of the Kalman filter falls (only cable arms of three
  /// joints with joint encoders and cameras).
  bool filter = true;
  std::vector<std::string> only;  ///< names of hypotheses to consider; empty: all
  std::uint64_t seed = 1;         ///< seed of the bootstraps
  double effort = 1.0;            ///< multiplies the limit of the search for causes (kMostWork)
};

/// Diagnosis of one robot. It simulates the nominal robot on the inputs of the recordings (motor positions,
/// or motor torques of rigid drives), compares the result with joint encoders and cameras, finds the effects
/// that explain the residual, extends the model by them, and measures how much the residual falls on held-out
/// data. Its steps: refit, score tests, selection (selection.h), verdict (verdict.h). The same evidence and
/// options give the same report for any number of threads. Throws base::InputError without recordings, for
/// recordings of different drives or joints, and for an unknown name in `only`. If `progress` is cancelled,
/// Report::cancelled is set and the report contains the results computed until then.
Report diagnose(const std::vector<Evidence>& recordings, const robot::Description& nominal,
                const DiagnosisOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::diagnosis
