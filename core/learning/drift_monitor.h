#pragma once

#include <deque>
#include <optional>

#include "core/learning/correction_model.h"

namespace capstan::learning {

struct DriftOptions {
  double span = 60.0;         ///< of what is looked at, in motions' own time [s]
  double spacing = 1.0;       ///< between states that count as independent [s]
  double level = 1e-3;        ///< chance of an alarm where nothing has changed
  double sigma_known = 1.25;  ///< factor to which the stated σ are trusted
};

struct DriftReport {
  Eigen::Index output = 0;  ///< the one with most errors beyond their σ: x, y, z, turn's parts
  double beyond = 0.0;      ///< share of its errors that are; kBeyond while the model holds
  double limit = 1.0;       ///< of that share, from which on it is no chance
  std::size_t states = 0;   ///< that it is of
  bool aged = false;
};
inline constexpr double kBeyond = 0.3173;  ///< of a normal distribution

/// Says when a learned model has aged: while it is in use, errors of what was seen against what was told are
/// compared with the σ that the model stated for them, output by output, as the σ are calibrated: by the
/// share beyond them, which a few sights gone wrong do not move. Of n independent errors a binomial number is
/// beyond; the model has aged when in the last `span` seconds it is above its 1 − level/6 quantile, were the
/// true σ `sigma_known` times the stated. Errors that come together are one: states nearer than `spacing` are
/// averaged.
class DriftMonitor {
 public:
  explicit DriftMonitor(const CorrectionModel& model, const DriftOptions& options = {})
      : model_(model), options_(options) {}

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
struct DriftCourse {
  std::vector<double> t;             ///< since the first state [s]
  std::vector<DriftReport> reports;  ///< by state
  /// The state from which on the monitor said that the model has aged until the last one, or none.
  std::optional<std::size_t> aged_from;
  double aged_share = 0.0;  ///< of the states
};

DriftCourse driftAlong(const CorrectionModel& model, const std::vector<State>& states,
                       const DriftOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::learning
