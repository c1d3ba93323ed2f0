#pragma once

#include <string>
#include <vector>

#include "core/base/workers.h"
#include "core/experiments/results.h"
#include "core/experiments/trial_setup.h"
#include "core/identification/options.h"
#include "core/identification/parameters.h"

namespace capstan::experiments {

/// Setup of an identifying experiment, with its options file read.
struct IdentificationSetup {
  IdentificationSpec spec;
  identification::IdentificationOptions options;
  std::string software = {};   ///< program and version, for the robot file
  nlohmann::json fingerprint;  ///< fingerprint of this part, without that of the trials
};

/// Reads the setup. Throws base::InputError for an unusable options file or parameters that `nominal` does
/// not have.
IdentificationSetup setUpIdentification(const Specification& specification,
                                        const robot::Description& nominal);

/// Joins all trials and identifies with the dual UKF, UKF paper (11)–(12), then with the batch method from
/// its estimates. Joint encoders are not used in the identification; they only appear in the motions of the
/// result. Where the requested method has no estimates, the robot of the other one is used. When cancelled,
/// the result is unfinished. Throws base::InputError for a trial without camera observations.
IdentificationResult identifyTrials(const std::vector<TrialSetup>& trials, const IdentificationSetup& setup,
                                    int threads, const base::ProgressSlice& progress);

/// True values of the parameters in `set` from the text of a truth file, SI, in the set's order; NaN without
/// a truth. Friction is that of the nominal robot: a truth file changes it at low speed only.
std::vector<double> trueValues(const std::string& truth, const robot::Description& nominal,
                               const identification::ParameterSet& set);

}  // namespace capstan::experiments
