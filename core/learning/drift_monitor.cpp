#include "core/learning/drift_monitor.h"

#include <boost/math/distributions/chi_squared.hpp>

namespace capstan::learning {
namespace {

constexpr double kOutputs = 6.0;

/// Σ (e/σ)² of one state.
double squaresOf(const CorrectionModel& model, const State& state) {
  const Corrected corrected = model.correct(state);
  const PoseFeatures tangent(RotationForm::kTangent, Motion::kNone, Eigen::Quaterniond::Identity());
  const Vector6d off = tangent.correction(corrected.pose, state.pair.told);
  return off.cwiseQuotient(corrected.sigma).squaredNorm();
}

}  // namespace

DriftReport DriftMonitor::add(const State& state) {
  if (window_.empty() || state.t >= window_.back().t + options_.spacing) window_.push_back({state.t, 0.0, 0});
  window_.back().squares += squaresOf(model_, state);
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

}  // namespace capstan::learning
