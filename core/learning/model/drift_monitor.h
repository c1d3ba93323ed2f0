#pragma once

#include <deque>
#include <utility>

#include "core/learning/model/correction_model.h"

namespace capstan::learning {

struct DriftOptions {
  double span = 240.0;  ///< window of the test without pauses [s]; at least kFewestPieces kSpacing
  static constexpr double kSpacing = 1.0;      ///< distance of states that count as independent [s]
  static constexpr double kLevel = 1e-3;       ///< false-alarm probability of one test
  static constexpr double kSigmaKnown = 1.25;  ///< factor within which the stated σ are assumed to hold
};

struct DriftReport {
  Eigen::Index output = 0;  ///< output with the most errors beyond σ: x, y, z, components of the rotation
  double beyond = 0.0;      ///< share of its errors beyond σ; at most about kBeyond for a valid model
  double limit = 1.0;       ///< largest such share of a valid model
  double span = 0.0;        ///< window of that share [s]
  bool known = false;       ///< there are at least kFewestPieces
  bool drifted = false;
};
/// Smallest number of pieces that distinguishes drift from chance, and number of windows.
inline constexpr std::size_t kFewestPieces = 15, kWindows = 4;
inline constexpr double kBeyond = 1.0 - kWithinSigma;

/// Detects that a learned model has drifted while it is in use. The statistic is, per output, the share of
/// errors (commanded minus corrected pose) beyond the σ stated by the model, because a few wrong observations
/// hardly change it. The number of n independent errors beyond σ is binomial. The model has drifted when this
/// number exceeds its 1 − kLevel / (6 kWindows) quantile for true σ of kSigmaKnown times the stated σ. It is
/// tested in the last `span` seconds and in their last half, quarter, … (kWindows in all, each with at least
/// kFewestPieces). Successive errors correlate; therefore states nearer than kSpacing are averaged to one
/// piece.
class DriftMonitor {
 public:
  /// The model must outlive the monitor.
  explicit DriftMonitor(const CorrectionModel& model, const DriftOptions& options = {})
      : model_(model), options_(options) {}
  explicit DriftMonitor(CorrectionModel&&, const DriftOptions& = {}) = delete;

  /// Adds an observed state with its commanded pose. Stamps must increase.
  DriftReport add(const State& state) { return add(state, model_.correct(state)); }
  /// Adds a state whose correction by the model is known.
  DriftReport add(const State& state, const Corrected& corrected);
  void reset() { window_.clear(); }

 private:
  struct Piece {
    double t = 0.0;
    Vector6d beyond = Vector6d::Zero();  ///< number of states with errors beyond σ, by output
    std::size_t states = 0;
  };
  DriftReport reportOver(std::size_t pieces) const;

  const CorrectionModel& model_;
  DriftOptions options_;
  std::deque<Piece> window_;
};

/// Reports of a monitor along successive motions. Each motion is assumed to begin when the previous one
/// ended.
struct DriftHistory {
  std::vector<std::size_t> state;    ///< indices of the tested states among those given
  std::vector<double> t;             ///< time since the first state [s]
  std::vector<DriftReport> reports;  ///< one per tested state
  std::size_t low_confidence = 0;    ///< number of states not tested, because the model's confidence is low
  /// For each output the kWithinSigma quantile of |error| / σ, which is at most 1 while the model is valid.
  Vector6d factor = Vector6d::Zero();
  /// Indices of the tested states at which reports of drift begin and end.
  std::vector<std::pair<std::size_t, std::size_t>> drifted;
  bool known() const { return !reports.empty() && reports.back().known; }
  bool driftedNow() const { return !reports.empty() && reports.back().drifted; }
};

/// Tests states of motions in their order. States with a confidence below kLowConfidence are not tested,
/// because their errors do not indicate drift.
DriftHistory driftAlong(const CorrectionModel& model, const std::vector<State>& states,
                        const DriftOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::learning
