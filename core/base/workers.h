#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/base/progress.h"

namespace capstan::base {

/// One piece of independent work.
struct Job {
  std::string name;
  double weight = 1.0;  ///< expected duration, in any unit that all jobs share
  std::function<void(base::Progress&)> work;
};

/// Part of a caller's progress bar.
struct ProgressSlice {
  base::Progress& whole;
  double from = 0.0, to = 1.0;

  void report(double fraction, const std::string& doing) const {
    whole.report(from + (to - from) * fraction, doing);
  }
  ProgressSlice part(double first, double last) const {
    return {whole, from + (to - from) * first, from + (to - from) * last};
  }
};

/// Runs all jobs: in the order of the list on one thread, the longest first on several. Each job has its own
/// progress; their sum, weighted by Job::weight, is reported to `progress`. A cancellation reaches every job.
/// When a job throws, the other jobs are cancelled and doAll() rethrows the exception of the job that comes
/// first in the list.
void doAll(const std::vector<Job>& jobs, int threads, const ProgressSlice& progress);

}  // namespace capstan::base
