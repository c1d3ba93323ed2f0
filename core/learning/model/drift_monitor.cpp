#include "core/learning/model/drift_monitor.h"

#include <algorithm>
#include <array>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <numbers>

#include "core/stats/quantile.h"

namespace capstan::learning {
namespace {

constexpr double kOutputs = 6.0;
constexpr std::size_t kAtOnce = 500;  // number of states that are corrected together

}  // namespace

DriftReport DriftMonitor::add(const State& state, const Corrected& corrected) {
  if (window_.empty() || state.t >= window_.back().t + DriftOptions::kSpacing)
    window_.push_back({state.t, Vector6d::Zero(), 0});
  const Eigen::Array<double, 6, 1> off = errorsInSigma(corrected, state.pair.commanded).array().abs();
  window_.back().beyond.array() += 1.0 - (off <= 1.0).cast<double>();
  ++window_.back().states;
  while (window_.size() > 1 && window_.front().t < state.t - options_.span) window_.pop_front();
  DriftReport worst = reportOver(window_.size());
  std::size_t pieces = window_.size() / 2;
  for (std::size_t part = 1; part < kWindows && pieces >= kFewestPieces; pieces /= 2, ++part)
    if (const DriftReport report = reportOver(pieces);
        report.beyond / report.limit > worst.beyond / worst.limit)
      worst = report;
  return worst;
}

/// Report over the last `pieces` of the window.
DriftReport DriftMonitor::reportOver(std::size_t pieces) const {
  DriftReport report;
  Vector6d sum = Vector6d::Zero();
  const std::size_t first = window_.size() - pieces;
  for (std::size_t k = first; k < window_.size(); ++k)
    sum += window_[k].beyond / static_cast<double>(window_[k].states);
  const auto n = static_cast<double>(pieces);
  report.span = window_.back().t - window_[first].t;
  report.beyond = sum.maxCoeff(&report.output) / n;
  const double chance = std::erfc(1.0 / (DriftOptions::kSigmaKnown * std::numbers::sqrt2));
  const boost::math::binomial number(n, chance);
  report.limit =
      boost::math::quantile(boost::math::complement(number, DriftOptions::kLevel / (kOutputs * kWindows))) /
      n;
  report.known = pieces >= kFewestPieces;
  report.drifted = report.known && report.beyond > report.limit;
  return report;
}

namespace {

/// Passes states of successive motions to a monitor and collects its reports.
class Walk {
 public:
  Walk(const CorrectionModel& model, const DriftOptions& options) : monitor_(model, options) {}

  void take(std::size_t place, const State& state, const Corrected& corrected) {
    if (corrected.confidence < kLowConfidence) {
      ++history_.low_confidence;
      return;
    }
    State now = state;
    if (history_.t.empty() || state.motion != motion_)
      begun_ = state.t - (history_.t.empty() ? 0.0 : history_.t.back() + DriftOptions::kSpacing);
    motion_ = state.motion;
    now.t -= begun_;
    history_.state.push_back(place);
    history_.t.push_back(now.t);
    history_.reports.push_back(monitor_.add(now, corrected));
    const Vector6d off = errorsInSigma(corrected, state.pair.commanded);
    for (std::size_t i = 0; i < off_.size(); ++i)
      off_[i].push_back(std::abs(off[static_cast<Eigen::Index>(i)]));
    const std::size_t at = history_.t.size() - 1;
    if (!history_.reports.back().drifted) return;
    if (history_.drifted.empty() || history_.drifted.back().second != at)
      history_.drifted.emplace_back(at, at);
    history_.drifted.back().second = at + 1;
  }

  DriftHistory ended() {
    for (std::size_t i = 0; i < off_.size() && !history_.t.empty(); ++i)
      history_.factor[static_cast<Eigen::Index>(i)] = stats::quantile(off_[i], kWithinSigma);
    return std::move(history_);
  }

 private:
  DriftMonitor monitor_;
  DriftHistory history_;
  std::array<std::vector<double>, 6> off_;
  std::size_t motion_ = 0;
  double begun_ = 0.0;  ///< time on the motion's clock at which the common time is 0
};

}  // namespace

DriftHistory driftAlong(const CorrectionModel& model, const std::vector<State>& states,
                        const DriftOptions& options, base::Progress* progress) {
  Walk walk(model, options);
  for (std::size_t from = 0; from < states.size() && !(progress && progress->cancelled()); from += kAtOnce) {
    if (progress)
      progress->report(static_cast<double>(from) / static_cast<double>(states.size()), "looking for drift");
    const std::size_t to = std::min(from + kAtOnce, states.size());
    const std::vector<State> some(states.begin() + static_cast<std::ptrdiff_t>(from),
                                  states.begin() + static_cast<std::ptrdiff_t>(to));
    const std::vector<Corrected> corrected = model.correctWithConfidence(some);
    for (std::size_t k = 0; k < some.size(); ++k) walk.take(from + k, some[k], corrected[k]);
  }
  return walk.ended();
}

}  // namespace capstan::learning
