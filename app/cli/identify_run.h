#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/identify_output.h"
#include "core/base/progress.h"
#include "core/experiments/identify_recording.h"
#include "core/identification/identification_data.h"
#include "core/identification/options.h"
#include "core/identification/parameters.h"
#include "core/tracking/options.h"
#include "core/tracking/source.h"

namespace capstan::cli {

/// How `identify` computes: values of its options of the same names.
struct IdentifyMethods {
  std::string robot, method = "both", parameters = identification::kDefaultParameters, options;
  int threads = 2;
  bool exact_camera = false;
};

/// Motors and cameras of one or more recordings of a robot, one after the other.
struct CollectedRecordings {
  std::optional<identification::IdentificationData> data;
  std::string truth;                   ///< text of the truth file of simulated recordings, else empty
  tracking::TrackingOptions tracking;  ///< tracking options of the first recording

  /// Adds the recording of `source`. Throws base::InputError about `file` where nothing can be identified
  /// from it; an empty `file` is not checked.
  void add(tracking::Source& source, const std::string& file, base::Progress& progress);
};

/// Results of the methods, and the data that they used.
struct Findings {
  std::string truth;  ///< text of the truth file; empty: not simulated
  tracking::TrackingOptions tracking;
  robot::Description recorded;  ///< nominal robot of the recording
  double duration = 0.0;        ///< duration of the motor samples [s]
  std::uint64_t excluded = 0, used = 0;
  std::optional<experiments::Identified> identified;

  /// Delay of the camera by the chosen method [s].
  double delay() const;
  TrueValues trueValues() const;
};

/// Runs the methods. Returns nothing if `progress` was cancelled. Throws base::InputError.
std::optional<Findings> identifyCollected(const CollectedRecordings& recordings,
                                          const IdentifyMethods& methods, base::Progress& progress);

/// Document of `identify --json`.
nlohmann::json documentOf(const Findings& found);

/// Notice of excluded motor samples; empty: none was excluded.
std::string excludedWords(const Findings& found);

/// Text of the identified robot file; `recordings` are names for its comments. Call it only if a method was
/// chosen.
std::string identifiedRobotText(const Findings& found, const std::vector<std::string>& recordings);

/// Text of the tracking options of the recording with the identified delay of the camera.
std::string trackingOptionsText(const Findings& found);

}  // namespace capstan::cli
