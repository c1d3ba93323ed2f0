#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/progress.h"
#include "core/experiments/results.h"
#include "core/experiments/shard.h"
#include "core/experiments/specification.h"

namespace capstan::experiments {

struct RunOptions {
  /// Folder of the results: those of experiment X are in out/X, its finished trials in out/X/trials. Empty:
  /// nothing is written.
  std::filesystem::path out = {};
  int threads = 2;                  ///< number of trials in parallel; the result does not depend on it
  std::optional<bool> images = {};  ///< replaces the value of the specification
  std::string software = {};        ///< program and version, stored in the results
  PartialRun* part = nullptr;       ///< trials that are run, if not all; needs `out`
};

/// Runs the experiments whose robot `specification` needs, then all of its trials.
///
/// A finished trial in `out` from the same specification, files, options and software is read and not run
/// again. A damaged file is named in Results::notices, and its trial is run again. Each trial is written when
/// it finishes, so that an interrupted run continues where it stopped and ends with the same bytes. Joint
/// encoders are used for errors only.
///
/// With `part`, only its trials are run or read. An identification joins its trials and therefore counts as
/// one trial. The experiments that `specification` needs are run by every shard that has a trial of it. A
/// shard writes no results and returns those of its own trials.
///
/// Throws base::InputError for an unusable file or name in the specification, before the first trial where it
/// can be checked; an unusable recording is refused when its trial starts.
Results run(const Specification& specification, const RunOptions& options, base::Progress& progress);

}  // namespace capstan::experiments
