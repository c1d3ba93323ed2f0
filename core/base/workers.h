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
  double weight = 1.0;  ///< how long it takes, in any unit
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

/// Does all jobs: one thread in their order, several at a time the longest first; each has a progress of its
/// own, whose weighted sum is shown. A cancellation reaches every job. When a job throws, the others are
/// cancelled and the exception of the first in the list that threw leaves here.
void doAll(const std::vector<Job>& jobs, int threads, const ProgressSlice& progress);

}  // namespace capstan::base
