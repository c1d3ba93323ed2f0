#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/progress.h"
#include "core/experiments/results.h"
#include "core/experiments/specification.h"

namespace capstan::experiments {

struct RunOptions {
  /// Results of experiment X go to out/X; finished trials are kept in out/X/trials. Empty: nothing is
  /// written.
  std::filesystem::path out = {};
  int threads = 2;                  ///< trials at the same time; the result does not depend on it
  std::optional<bool> images = {};  ///< in place of the specification's
  std::string software = {};        ///< program and version, kept in the results
};

/// Runs every trial of `specification`, and before them the experiments whose robot it needs.
///
/// A trial that `out` holds already, made from the same specification, files, options and software, is read
/// and not run again; a file that is damaged is named in Results::notices and its trial run again. Trials are
/// written whole as they finish, so that an interrupted run is taken up where it was stopped, with the same
/// bytes in the end. Joint encoders are used for errors only.
///
/// Throws base::InputError for a file or name of the specification that is unusable, before anything is run,
/// where the trial itself can be checked; a recording that cannot be used is refused when its trial starts.
Results run(const Specification& specification, const RunOptions& options, base::Progress& progress);

}  // namespace capstan::experiments
