#include "core/learning/drift_monitor.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>

namespace capstan::learning {
namespace {

constexpr double kOutputs = 6.0;
constexpr std::size_t kAtOnce = 500;  // states that are corrected together

}  // namespace

DriftReport DriftMonitor::add(const State& state, const Corrected& corrected) {
  if (window_.empty() || state.t >= window_.back().t + options_.spacing) window_.push_back({state.t, 0.0, 0});
  window_.back().squares += errorsInSigma(corrected, state.pair.told).squaredNorm();
  ++window_.back().states;
  while (window_.front().t < state.t - options_.span) window_.pop_front();
  DriftReport report;
  double sum = 0.0;
  for (const Piece& piece : window_) {
    sum += piece.squares / static_cast<double>(piece.states);
    report.states += piece.states;
  }
  const double free = kOutputs * static_cast<double>(window_.size());
  const boost::math::chi_squared chance(free);
  report.ratio = sum / free;
  const double most = boost::math::quantile(boost::math::complement(chance, options_.level));
  report.limit = options_.sigma_known * options_.sigma_known * most / free;
  report.aged = report.ratio > report.limit;
  return report;
}

DriftCourse driftAlong(const CorrectionModel& model, const std::vector<State>& states,
                       const DriftOptions& options, base::Progress* progress) {
  DriftCourse course;
  DriftMonitor monitor(model, options);
  double begun = 0.0;  // the motion's clock at the whole's zero
  std::size_t aged = 0;
  for (std::size_t from = 0; from < states.size() && !(progress && progress->cancelled()); from += kAtOnce) {
    if (progress)
      progress->report(static_cast<double>(from) / static_cast<double>(states.size()), "looking for drift");
    const std::size_t to = std::min(from + kAtOnce, states.size());
    const std::vector<State> some(states.begin() + static_cast<std::ptrdiff_t>(from),
                                  states.begin() + static_cast<std::ptrdiff_t>(to));
    const std::vector<Corrected> corrected = model.correctSurely(some);
    for (std::size_t k = 0; k < some.size(); ++k) {
      State state = some[k];
      if (course.t.empty() || state.motion != states[from + k - 1].motion)
        begun = state.t - (course.t.empty() ? 0.0 : course.t.back() + options.spacing);
      state.t -= begun;
      course.t.push_back(state.t);
      course.reports.push_back(monitor.add(state, corrected[k]));
      const bool now = course.reports.back().aged;
      aged += now;
      if (!now)
        course.aged_from.reset();
      else if (!course.aged_from)
        course.aged_from = from + k;
    }
  }
  if (!course.t.empty()) course.aged_share = static_cast<double>(aged) / static_cast<double>(course.t.size());
  return course;
}

}  // namespace capstan::learning
