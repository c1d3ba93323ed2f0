#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "core/base/progress.h"
#include "core/tracking/options.h"
#include "core/tracking/source.h"
#include "core/tracking/track_all.h"

namespace capstan::analysis {

/// What is different when a session is tracked again; what is not given stays as the session has it.
struct RerunChange {
  std::filesystem::path robot = {};    ///< robot file of kinematics and filter
  std::filesystem::path options = {};  ///< file of filter options
  std::optional<tracking::FilterKind> filter = {};
  std::optional<tracking::OneCamera> one_camera = {};
  std::optional<double> gate_probability = {};  ///< of the χ² gate on the innovation
  std::optional<double> camera_delay = {};      ///< time stamp minus exposure of a camera sample [s]

  bool empty() const;
  /// The changes in words, as "robot my_robot.yaml, gate 0.99"; empty: nothing is changed.
  std::string words() const;
};

/// The source's information with the robot of the change, and its filter options with the rest. Throws
/// base::InputError for files that cannot be read.
struct RerunSetup {
  tracking::SourceInfo info;
  tracking::TrackingOptions options;
};
RerunSetup rerunSetup(const tracking::SourceInfo& info, const RerunChange& change);

/// Tracks a source with the change, from its begin to the arrival time `until` [s]; `info`: what the session
/// ran with, for example with the registration in use. `each` gets every snapshot. Throws as rerunSetup() and
/// tracking::makePipeline() do.
tracking::TrackReport rerun(tracking::Source& source, const tracking::SourceInfo& info,
                            const RerunChange& change, base::Progress& progress,
                            const std::function<void(const tracking::Snapshot&)>& each,
                            double until = std::numeric_limits<double>::infinity());

}  // namespace capstan::analysis
