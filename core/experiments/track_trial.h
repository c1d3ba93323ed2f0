#pragma once

#include "core/base/progress.h"
#include "core/experiments/results.h"
#include "core/experiments/trial_setup.h"

namespace capstan::experiments {

/// Runs the tracking pipeline over one trial, with the six-state filter of the UKF paper and in parallel with
/// the augmented one. Deterministic and single-threaded. Joint encoders are used for errors only. The result
/// of a cancelled trial is unusable. Throws base::InputError for an unusable recording.
TrialResult trackTrial(const TrialSetup& setup, base::Progress& progress);

}  // namespace capstan::experiments
