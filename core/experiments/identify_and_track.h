#pragma once

#include <optional>
#include <string>

#include "core/base/progress.h"
#include "core/experiments/identify_recording.h"
#include "core/identification/identification_data.h"
#include "core/tracking/options.h"
#include "core/tracking/source.h"
#include "core/tracking/track_all.h"

namespace capstan::experiments {

/// What follows the tracking of a recording with nominal constants: what its motors and cameras say about
/// these constants, and the same recording tracked again with what was found.
struct IdentifyAndTrack {
  std::optional<Identified> identified;          ///< none: `fault` says why
  std::optional<tracking::TrackReport> tracked;  ///< with the identified robot; none: no parameter was seen
  std::string fault;                             ///< in plain words; empty: the recording was tracked again
  double duration = 0.0;                         ///< of the motor samples identified from [s]
  bool cancelled = false;                        ///< what came before is there
};

/// Identifies the default parameters (identification::kDefaultParameters) from `data`, as `capstan-cli
/// identify` does, and tracks `recording` from its beginning with the robot found and `options`, as
/// `capstan-cli track --estimator-robot` does. `data` was collected while the same recording was tracked with
/// the nominal robot (identification::DataCollector). Neither truth nor joint encoders are an input; these
/// enter the errors of `tracked` alone. Cancellable. Throws base::InputError for a recording that cannot be
/// read.
IdentifyAndTrack identifyAndTrack(const identification::IdentificationData& data, tracking::Source& recording,
                                  const tracking::TrackingOptions& options, base::Progress& progress);

}  // namespace capstan::experiments
