#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/fit/fit.h"
#include "core/diagnosis/selection/work_progress.h"

namespace capstan::diagnosis {

/// Progress of a search over sets of effects, from the caller's present fraction to `end`, by the work of its
/// simulations. `progress` null: nobody watches.
class SearchProgress {
 public:
  SearchProgress(const FitData& data, const std::vector<Evidence>& recordings, base::Progress* progress,
                 double end);
  ~SearchProgress() { data_.onWork({}); }
  SearchProgress(const SearchProgress&) = delete;
  SearchProgress& operator=(const SearchProgress&) = delete;

  void report(const std::string& doing);
  /// A step of the search begins. The work that is left is that of `steps` more steps, as large as those
  /// until now.
  void beginStep(int steps) { work_.expect(steps * data_.work() / ++steps_); }

 private:
  void show(double work);

  const FitData& data_;
  base::Progress* progress_;
  double begin_, end_;
  int steps_ = 0;
  WorkProgress work_;
  std::string doing_;
};

}  // namespace capstan::diagnosis
