#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/fit/fit.h"
#include "core/diagnosis/selection/work_progress.h"

namespace capstan::diagnosis {

/// Progress of a search over sets of effects, from the caller's present fraction to `end`, by the work of its
/// simulations from now on. `progress` null: nobody watches. `limit`: work after which the search begins no
/// further fits.
class SearchProgress {
 public:
  SearchProgress(const FitData& data, const std::vector<Evidence>& recordings, base::Progress* progress,
                 double end, double limit = std::numeric_limits<double>::infinity());
  ~SearchProgress() { data_.onWork({}); }
  SearchProgress(const SearchProgress&) = delete;
  SearchProgress& operator=(const SearchProgress&) = delete;

  void report(const std::string& doing);
  /// A step of the search begins, `steps` with it are left. The last one is expected to be a fit as the first
  /// one, the others as large as the steps until now.
  void beginStep(int steps);

 private:
  void show(double work);

  const FitData& data_;
  base::Progress* progress_;
  double begin_, end_;
  double before_;           ///< work that was done before
  double first_fit_ = 0.0;  ///< work of the first fit
  int steps_ = 0;
  WorkProgress work_;
  std::string doing_;
};

}  // namespace capstan::diagnosis
