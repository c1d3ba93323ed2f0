#pragma once

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

#include "core/base/progress.h"

namespace capstan::base {

/// The part of a progress from its present fraction to `end`, for a number of equal pieces of work. Without a
/// progress it does nothing.
class ProgressShare {
 public:
  ProgressShare(Progress* progress, double end, std::string_view doing, std::size_t pieces)
      : progress_(progress), doing_(doing), pieces_(pieces) {
    if (!progress_) return;
    begin_ = progress_->fraction();
    end_ = std::max(begin_, end);
    progress_->report(begin_, doing_);
  }
  /// A piece is finished; any thread may call it.
  void finished() {
    if (!progress_) return;
    const std::lock_guard lock(mutex_);  // a later piece is not overtaken by an earlier one
    ++done_;
    progress_->report(begin_ + (end_ - begin_) * static_cast<double>(done_) / static_cast<double>(pieces_),
                      doing_);
  }

 private:
  Progress* progress_;
  std::string doing_;
  std::size_t pieces_, done_ = 0;
  double begin_ = 0.0, end_ = 0.0;
  std::mutex mutex_;
};

}  // namespace capstan::base
