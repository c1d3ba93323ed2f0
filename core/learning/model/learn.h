#pragma once

#include "core/learning/model/correction_model.h"
#include "core/learning/poses/clean_states.h"
#include "core/learning/poses/screen_poses.h"
#include "core/learning/poses/training_states.h"

/// Learning of a correction model from tables of tip poses, with all stages in their order (GPR paper,
/// section IV).
namespace capstan::learning {

struct LearningOptions {
  StreamKind towards = StreamKind::kCommand;  ///< stream towards which poses are corrected
  bool align = true;                          ///< compensate the clock offset of observations behind commands
  bool clean = true;
  /// Weights states, also rejected ones, by how well models of other motions predict them (weigh()). Used
  /// only with `clean` and without `rigid`.
  bool weigh = true;
  bool rigid = false;  ///< learn the rigid offset alone
  /// most_rejected is stricter than the paper's P, because in a partly wrong trajectory (for example with
  /// swapped axes) some states pass by chance.
  CleaningOptions cleaning{.most_rejected = 0.4};
  CorrectionOptions correction{.motion = std::nullopt};
};

/// Result of preparing the rows of a recording for learning.
struct PreparedStates {
  ScreenReport screen;
  /// Measured offset, removed or not; `tried` is empty if the offset was given.
  ClockOffsetReport clock_offset;
  double removed = 0.0;       ///< clock offset that was removed [s]
  std::vector<State> states;  ///< paired states with velocities
  bool cancelled = false;     ///< results of later stages are empty
};

/// Prepares states with a known clock offset [s], by screenPoses() and statesOf().
PreparedStates prepareAt(double clock_offset, const std::vector<RawMotion>& motions, StreamKind towards);

/// Screens rows, estimates the clock offset and pairs poses. Throws base::InputError as checkTables(), and if
/// no motion has both streams at the same time.
PreparedStates prepare(const std::vector<RawMotion>& motions, const LearningOptions& options,
                       base::Progress* progress = nullptr, const base::ProgressPart& part = {});

struct LearningReport {
  PreparedStates prepared;
  CleaningReport cleaning;  ///< cleaning of prepared.states; without cleaning all states are inliers
  WeighingReport weighing;  ///< `cleaning` has the inliers after weighing
  CorrectionModel model;
  bool cancelled = false;
};

/// Learns a correction from all states of prepare() with the same options. Throws base::InputError if too few
/// states remain, and as checkRelated().
LearningReport learnPrepared(PreparedStates prepared, const LearningOptions& options = {},
                             base::Progress* progress = nullptr, const base::ProgressPart& part = {});

/// Calls prepare() and learnPrepared(). Throws base::InputError as both.
LearningReport learn(const std::vector<RawMotion>& motions, const LearningOptions& options = {},
                     base::Progress* progress = nullptr);

/// Adds new motions to a learned model, in seconds instead of minutes. The motions are screened, paired at
/// the model's own `clock_offset` (it is not measured again) and cleaned by options.cleaning. The model keeps
/// its offset, hyperparameters, inducing points and factors on σ, so in regions without earlier data it
/// improves less than with learn(). Throws base::InputError as learn(), and if the motions contradict the
/// model (driftAlong) or it has no processes.
LearningReport learnMore(CorrectionModel model, double clock_offset, const std::vector<RawMotion>& motions,
                         const LearningOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::learning
