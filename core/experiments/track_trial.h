#pragma once

#include "core/base/progress.h"
#include "core/experiments/results.h"
#include "core/experiments/trial_setup.h"

namespace capstan::experiments {

/// Runs the tracking pipeline over one trial, with the six-state filter of the UKF paper and, beside it, with
/// the augmented one. Deterministic and single-threaded. Joint encoders enter the
/// errors and nothing else. Nothing is worth keeping of a cancelled trial. Throws base::InputError for a
/// recording that cannot be used.
TrialResult trackTrial(const TrialSetup& setup, base::Progress& progress);

}  // namespace capstan::experiments
