#include "core/diagnosis/selection/search_progress.h"

#include <algorithm>

namespace capstan::diagnosis {
namespace {

/// Integration steps per row and joint that a search takes, about: what is expected before its first step.
constexpr double kFirstSteps = 3000.0;
/// Work of an expansion of a set, about, in that of the first fit.
constexpr double kExpansion = 5.0;

}  // namespace

SearchProgress::SearchProgress(const FitData& data, const std::vector<Evidence>& recordings,
                               base::Progress* progress, double end, double limit)
    : data_(data),
      progress_(progress),
      begin_(progress ? progress->fraction() : 0.0),
      end_(end),
      before_(data.work()),
      work_(limit) {
  double rows = 0.0;
  for (const Evidence& evidence : recordings)
    rows += static_cast<double>(evidence.rows()) * evidence.joints * (data.rigid() ? evidence.joints : 1);
  work_.expect(kFirstSteps * rows);
  if (progress_) data_.onWork([this](double work) { show(work); });
}

void SearchProgress::report(const std::string& doing) {
  doing_ = doing;
  if (progress_) show(data_.work());
}

void SearchProgress::beginStep(int steps) {
  const double done = data_.work() - before_;
  if (steps_ == 0) first_fit_ = done;
  const double each =
      steps_ > 0 ? std::max((done - first_fit_) / steps_, first_fit_) : kExpansion * first_fit_;
  work_.expect((steps - 1) * each + first_fit_);
  ++steps_;
}

void SearchProgress::show(double work) {
  progress_->report(begin_ + work_.advance(work - before_) * (end_ - begin_), doing_);
}

}  // namespace capstan::diagnosis
