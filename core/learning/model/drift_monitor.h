#pragma once

#include <deque>
#include <utility>

#include "core/learning/model/correction_model.h"

namespace capstan::learning {

struct DriftOptions {
  double span = 240.0;   ///< of what is looked at, in motions' own time [s]: kFewestPieces spacings at least
  double spacing = 1.0;  ///< between states that count as independent [s]
  double level = 1e-3;   ///< chance of an alarm at one look where nothing has changed
  double sigma_known = 1.25;                 ///< factor to which the stated σ are trusted
  double least_confidence = kLowConfidence;  ///< of states that driftAlong() judges
};

struct DriftReport {
  Eigen::Index output = 0;  ///< the one with most errors beyond their σ: x, y, z, turn's parts
  double beyond = 0.0;  ///< share of its errors that are; kBeyond at most is expected while the model holds
  double limit = 1.0;   ///< of that share, from which on it is no chance
  double span = 0.0;    ///< that it is of [s]
  bool known = false;   ///< there are kFewestPieces
  bool drifted = false;
};
/// Fewer pieces cannot tell ageing from chance.
inline constexpr std::size_t kFewestPieces = 15, kWindows = 4;
inline constexpr double kBeyond = 1.0 - kWithinSigma;

/// Says when a learned model has aged: while it is in use, errors of what was seen against what was told are
/// compared with the σ that the model stated for them, output by output: by the share beyond them, which a
/// few observations gone wrong do not move. Of n independent errors a binomial number is beyond; the model
/// has aged when in the last `span` seconds, or in their last half, quarter, … (kWindows in all, none of
/// fewer than kFewestPieces), it is above its 1 − level / (6 kWindows) quantile, were the true σ
/// `sigma_known` times the stated. Errors that come together are one piece: states nearer than `spacing` are
/// averaged.
class DriftMonitor {
 public:
  /// The model outlives the monitor.
  explicit DriftMonitor(const CorrectionModel& model, const DriftOptions& options = {})
      : model_(model), options_(options) {}
  explicit DriftMonitor(CorrectionModel&&, const DriftOptions& = {}) = delete;

  /// A state that was seen, with what had been told. Stamps rise.
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

/// What a monitor says along motions, one after the other, each taken to begin when the last has ended.
struct DriftHistory {
  std::vector<std::size_t> state;    ///< place of each that was judged among those given
  std::vector<double> t;             ///< since the first state [s]
  std::vector<DriftReport> reports;  ///< by state judged
  std::size_t low_confidence = 0;    ///< states that were not: the model knows too little there
  /// By which errors exceed their σ: the quantile that is expected to be 1 at most while the model holds.
  Vector6d factor = Vector6d::Zero();
  /// Places among those judged at which the monitor began to say that the model has aged, and stopped to.
  std::vector<std::pair<std::size_t, std::size_t>> drifted;
  bool known() const { return !reports.empty() && reports.back().known; }
  bool driftedNow() const { return !reports.empty() && reports.back().drifted; }
};

/// Judges states of motions, in their order. Those at which the model is low_confidence say nothing of its
/// age.
DriftHistory driftAlong(const CorrectionModel& model, const std::vector<State>& states,
                        const DriftOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::learning
