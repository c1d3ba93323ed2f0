#pragma once

#include <deque>
#include <utility>

#include "core/learning/model/correction_model.h"

namespace capstan::learning {

struct DriftOptions {
  double span = 240.0;  ///< window of the test, in motions' own time [s]: kFewestPieces spacings at least
  static constexpr double kSpacing = 1.0;      ///< between states that count as independent [s]
  double level = 1e-3;                         ///< probability of a false alarm of one test
  static constexpr double kSigmaKnown = 1.25;  ///< factor within which the stated σ are assumed to hold
  double least_confidence = kLowConfidence;    ///< of states that driftAlong() judges
};

struct DriftReport {
  Eigen::Index output = 0;  ///< the one with most errors beyond their σ: x, y, z, rotation's components
  double beyond = 0.0;  ///< share of its errors beyond σ; at most kBeyond is expected while the model holds
  double limit = 1.0;   ///< of that share, from which on the model has drifted
  double span = 0.0;    ///< window of that share [s]
  bool known = false;   ///< there are kFewestPieces
  bool drifted = false;
};
/// Fewer pieces cannot distinguish drift from chance.
inline constexpr std::size_t kFewestPieces = 15, kWindows = 4;
inline constexpr double kBeyond = 1.0 - kWithinSigma;

/// Detects that a learned model has drifted while it is in use. Errors of commanded against corrected poses
/// are compared with the σ that the model stated for them, output by output, by the share beyond σ: a few
/// wrong observations hardly change it. Of n independent errors the number beyond σ is binomial. The model
/// has drifted when in the last `span` seconds, or in their last half, quarter, … (kWindows in all, none of
/// fewer than kFewestPieces), that number is above its 1 − level / (6 kWindows) quantile for true σ of
/// kSigmaKnown times the stated ones. Successive errors correlate: states nearer than kSpacing are
/// averaged to one piece.
class DriftMonitor {
 public:
  /// The model outlives the monitor.
  explicit DriftMonitor(const CorrectionModel& model, const DriftOptions& options = {})
      : model_(model), options_(options) {}
  explicit DriftMonitor(CorrectionModel&&, const DriftOptions& = {}) = delete;

  /// An observed state with its commanded pose. Stamps rise.
  DriftReport add(const State& state) { return add(state, model_.correct(state)); }
  /// The same, where the model's correction of the state is known.
  DriftReport add(const State& state, const Corrected& corrected);
  void reset() { window_.clear(); }

 private:
  struct Piece {
    double t = 0.0;
    Vector6d beyond = Vector6d::Zero();  ///< states whose errors are beyond σ
    std::size_t states = 0;
  };
  DriftReport reportOver(std::size_t pieces) const;

  const CorrectionModel& model_;
  DriftOptions options_;
  std::deque<Piece> window_;
};

/// Reports of a monitor along motions, one after the other, each assumed to begin when the last has ended.
struct DriftHistory {
  std::vector<std::size_t> state;    ///< place of each that was judged among those given
  std::vector<double> t;             ///< since the first state [s]
  std::vector<DriftReport> reports;  ///< by state judged
  std::size_t low_confidence = 0;    ///< states not judged: the model's confidence is low there
  /// For each output the quantile of |error| / σ that is at most 1 while the model is valid.
  Vector6d factor = Vector6d::Zero();
  /// Indices of the judged states at which reports of drift begin and end.
  std::vector<std::pair<std::size_t, std::size_t>> drifted;
  bool known() const { return !reports.empty() && reports.back().known; }
  bool driftedNow() const { return !reports.empty() && reports.back().drifted; }
};

/// Judges states of motions, in their order. States at which the model's confidence is low are not judged:
/// their errors say nothing of drift.
DriftHistory driftAlong(const CorrectionModel& model, const std::vector<State>& states,
                        const DriftOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::learning
