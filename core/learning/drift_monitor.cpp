#include "core/learning/drift_monitor.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <numbers>

namespace capstan::learning {
namespace {

constexpr double kOutputs = 6.0;
constexpr std::size_t kParts = 3;     // of the window that are judged: all, the last half, the last quarter
constexpr std::size_t kAtOnce = 500;  // states that are corrected together

}  // namespace

DriftReport DriftMonitor::add(const State& state, const Corrected& corrected) {
  if (window_.empty() || state.t >= window_.back().t + options_.spacing)
    window_.push_back({state.t, Vector6d::Zero(), 0});
  window_.back().beyond.array() +=
      (errorsInSigma(corrected, state.pair.told).array().abs() > 1.0).cast<double>();
  ++window_.back().states;
  while (window_.front().t < state.t - options_.span) window_.pop_front();
  DriftReport worst = reportOver(window_.size());
  for (std::size_t pieces = window_.size() / 2, part = 1; part < kParts && pieces > 0; pieces /= 2, ++part)
    if (const DriftReport report = reportOver(pieces);
        report.beyond / report.limit > worst.beyond / worst.limit)
      worst = report;
  return worst;
}

/// Of the last pieces of the window.
DriftReport DriftMonitor::reportOver(std::size_t pieces) const {
  DriftReport report;
  Vector6d sum = Vector6d::Zero();
  for (std::size_t k = window_.size() - pieces; k < window_.size(); ++k) {
    sum += window_[k].beyond / static_cast<double>(window_[k].states);
    report.states += window_[k].states;
  }
  const auto n = static_cast<double>(pieces);
  report.beyond = sum.maxCoeff(&report.output) / n;
  const double chance = std::erfc(1.0 / (options_.sigma_known * std::numbers::sqrt2));
  const boost::math::binomial number(n, chance);
  report.limit =
      boost::math::quantile(boost::math::complement(number, options_.level / (kOutputs * kParts))) / n;
  report.aged = report.beyond > report.limit;
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
