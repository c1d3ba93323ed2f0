#pragma once

#include <string>
#include <vector>

#include "core/base/workers.h"
#include "core/experiments/results.h"
#include "core/experiments/trial_setup.h"
#include "core/identification/options.h"
#include "core/identification/parameters.h"

namespace capstan::experiments {

/// What an identifying experiment asks for, its options file read.
struct IdentificationSetup {
  IdentificationSpec spec;
  identification::IdentificationOptions options;
  std::string software = {};   ///< program and version, for the robot file
  nlohmann::json fingerprint;  ///< of this part; the trials' own come on top
};

/// Throws base::InputError for an options file that is unusable or parameters that `nominal` does not have.
IdentificationSetup setUpIdentification(const Specification& specification,
                                        const robot::Description& nominal);

/// Joins all trials and identifies with the dual UKF, UKF paper (11)–(12), and from there with the batch
/// method. Joint encoders are no input of either: they enter the motions that the result keeps, and nothing
/// else. Where the method whose robot should go on found nothing, that of the other one does. Cancelled: an
/// unfinished result. Throws base::InputError for a trial in which the cameras see nothing.
IdentificationResult identifyTrials(const std::vector<TrialSetup>& trials, const IdentificationSetup& setup,
                                    int threads, const base::ProgressSlice& progress);

/// True values of `set`'s parameters by a truth file's text, SI, in the set's order; NaN without one.
/// Friction is the nominal robot's: a truth file changes it at low speed only.
std::vector<double> trueValues(const std::string& truth, const robot::Description& nominal,
                               const identification::ParameterSet& set);

}  // namespace capstan::experiments
