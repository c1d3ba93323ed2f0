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
  bool dual = true, batch = true;  ///< methods whose reports are requested; at least one
  identification::CameraPoseOptions camera = {};
  int threads = 2;  ///< number of worker threads of the batch method
};

/// What one method or both found in a recording.
struct Identified {
  identification::ParameterSet set;
  std::optional<identification::DualUkfReport> dual = {};  ///< without estimates: they are of no use
  std::optional<identification::BatchReport> batch = {};   ///< the same
  Choice choice = {};                                      ///< of the batch method where it found something

  /// Of the chosen method. Only if choice.method.
  const std::vector<identification::Estimate>& estimates() const;
  /// The chosen method shows at least one parameter.
  bool anySeen() const;
  /// The nominal robot with every parameter that was seen. Only if choice.method.
  robot::Description robot() const { return identification::identifiedRobot(set, estimates()); }
};

/// Identifies the parameters of `set` from motors and cameras of `data`: the dual UKF, and from where it
/// ended the batch method, each in as many passes as the cameras' delay asks for. Nothing is worth keeping
/// where `progress` was cancelled. `capstan-cli identify` and `report` both come here.
Identified identifyRecording(const identification::IdentificationData& data,
                             const identification::ParameterSet& set, const IdentifyOptions& options,
                             base::Progress& progress);

}  // namespace capstan::experiments
