#pragma once

#include "core/learning/model/correction_model.h"
#include "core/learning/poses/clean_states.h"
#include "core/learning/poses/screen_poses.h"
#include "core/learning/poses/training_states.h"

/// From tables of tip poses to a model: every stage of learning in its order (GPR paper, section IV).
namespace capstan::learning {

struct LearningOptions {
  StreamKind towards = StreamKind::kCommand;  ///< what corrected poses will be asked of
  ClockOffsetOptions clock_offset;
  bool align = true;  ///< compensate the clock offset of observations behind commands
  bool clean = true;
  /// Weighs states, rejected ones too, by how well models of others predict them; where states are cleaned,
  /// and processes learned.
  bool weigh = true;
  bool rigid = false;  ///< learn the rigid offset alone
  /// Stricter than the paper's P: in a trajectory that is wrong in part (swapped axes, say) some states pass
  /// by chance.
  CleaningOptions cleaning{.most_rejected = 0.4};
  CorrectionOptions correction{.motion = std::nullopt};
};

/// What becomes of the rows of a recording before anything is learned.
struct PreparedStates {
  ScreenReport screen;
  ClockOffsetReport clock_offset;  ///< as measured, taken off or not; nothing tried: as it was given
  double removed = 0.0;            ///< [s]
  std::vector<State> states;       ///< paired, with velocities
  bool cancelled = false;          ///< what came behind is empty
};

/// What statesOf() finds in the motions at a lag that is known.
PreparedStates prepareAt(double clock_offset, const std::vector<RawMotion>& motions, StreamKind towards);

/// Screens, aligns and pairs. base::InputError as checkTables(), and where no motion has both streams at
/// once.
PreparedStates prepare(const std::vector<RawMotion>& motions, const LearningOptions& options,
                       base::Progress* progress = nullptr, const base::ProgressPart& part = {});

struct LearningReport {
  PreparedStates prepared;
  CleaningReport cleaning;  ///< of prepared.states; where nothing is cleaned all count
  WeighingReport weighing;  ///< kept ones of `cleaning` are those that count after it
  CorrectionModel model;
  bool cancelled = false;
};

/// Learns a correction from states that prepare() made with the same options, of all of them.
/// base::InputError: too few states are left; checkRelated().
LearningReport learnPrepared(PreparedStates prepared, const LearningOptions& options = {},
                             base::Progress* progress = nullptr, const base::ProgressPart& part = {});

/// prepare() and learnPrepared(). base::InputError as both.
LearningReport learn(const std::vector<RawMotion>& motions, const LearningOptions& options = {},
                     base::Progress* progress = nullptr);

/// Adds new motions to a learned model, in seconds instead of minutes. The motions are screened, paired at
/// `clock_offset` (the model's own; it is not measured again) and cleaned by options.cleaning. The model
/// keeps its offset, hyperparameters, inducing points and σ scales, so in regions without earlier data it
/// gains less than learn(). base::InputError as learn(), and where the motions contradict the model
/// (driftAlong) or it has no processes.
LearningReport learnMore(CorrectionModel model, double clock_offset, const std::vector<RawMotion>& motions,
                         const LearningOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::learning
