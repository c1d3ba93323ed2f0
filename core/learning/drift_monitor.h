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
  double ratio = 1.0;      ///< mean square of errors over what their σ say; 1: as learned
  double limit = 0.0;      ///< of the ratio, from which on it is no chance
  std::size_t states = 0;  ///< that it is of
  bool aged = false;
};

/// Says when a learned model has aged: while it is in use, errors of what was seen against what was told are
/// compared with the σ that the model stated for them. n independent errors of q outputs have Σ (e/σ)² ~ χ²(n
/// q) while the model holds; the model has aged when the sum of the last `span` seconds is beyond its 1 −
/// level quantile, sigma_known² times. Errors that come together are one: states nearer than `spacing` are
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
    double t = 0.0, squares = 0.0;
    std::size_t states = 0;
  };
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
