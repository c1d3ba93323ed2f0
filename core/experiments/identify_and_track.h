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

/// Results of an identification from a recording, and of tracking the recording again with the identified
/// robot.
struct IdentifyAndTrack {
  std::optional<Identified> identified;  ///< none: `fault` has the reason
  std::optional<tracking::TrackReport>
      tracked;             ///< tracking with the identified robot; none: no parameter is observable
  std::string fault;       ///< reason for missing results; empty: there is none
  double duration = 0.0;   ///< duration of the motor samples of the identification [s]
  bool cancelled = false;  ///< true: only finished parts are filled
};

/// Identifies the default parameters (identification::kDefaultParameters) from `data`, as `capstan-cli
/// identify` does. Then tracks `recording` from its beginning with the identified robot and `options`, as
/// `capstan-cli track
/// --estimator-robot` does. `data` was collected while the same recording was tracked with the nominal robot
/// (identification::DataCollector). The truth is not used; joint encoders are used only for the errors of
/// `tracked`. Cancellable. Throws base::InputError for a recording that cannot be read.
IdentifyAndTrack identifyAndTrack(const identification::IdentificationData& data, tracking::Source& recording,
                                  const tracking::TrackingOptions& options, base::Progress& progress);

}  // namespace capstan::experiments
