#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/experiments/identified.h"
#include "core/identification/batch.h"
#include "core/identification/dual_ukf.h"
#include "core/identification/identification_data.h"
#include "core/identification/options.h"

namespace capstan::experiments {

struct IdentifyOptions {
  bool dual = true, batch = true;  ///< methods to report; at least one
  identification::CameraPoseOptions camera = {};
  int threads = 2;  ///< number of worker threads of the batch method
};

/// Results of one method or both for a recording.
struct Identified {
  identification::ParameterSet set;
  std::optional<identification::DualUkfReport> dual = {};  ///< report; unusable estimates are removed
  std::optional<identification::BatchReport> batch = {};   ///< report; unusable estimates are removed
  Choice choice = {};                                      ///< the batch method where it has estimates

  /// Estimates of the chosen method. Call it only if choice.method.
  const std::vector<identification::Estimate>& estimates() const;
  /// True if at least one parameter is observable for the chosen method.
  bool anySeen() const;
  /// Nominal robot with the estimates of all observable parameters. Call it only if choice.method.
  robot::Description robot() const { return identification::identifiedRobot(set, estimates()); }
};

/// Identifies the parameters of `set` from motors and cameras of `data`: first the dual UKF, then the batch
/// method from its estimates. Each makes one pass or two, depending on the delay of the cameras. The result
/// is unusable when `progress` was cancelled. `capstan-cli identify` and `report` both call this function.
Identified identifyRecording(const identification::IdentificationData& data,
                             const identification::ParameterSet& set, const IdentifyOptions& options,
                             base::Progress& progress);

}  // namespace capstan::experiments
