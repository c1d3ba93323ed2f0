#pragma once

#include "core/learning/clean_states.h"
#include "core/learning/correction_model.h"
#include "core/learning/screen_poses.h"

/// From tables of tip poses to a model: every stage of learning in its order (GPR paper, section IV).
namespace capstan::learning {

struct LearningOptions {
  StreamKind towards = StreamKind::kCommand;  ///< what corrected poses will be asked of
  bool align = true;                          ///< take the lag of what is seen behind what is told off
  bool clean = true;
  bool rigid = false;  ///< learn the rigid offset alone
  /// Of a trajectory that is wrong in part (axes swapped, say) some states pass by chance: less is trusted
  /// than the paper's P.
  CleaningOptions cleaning{.most_rejected = 0.4};
  CorrectionOptions correction;
};

/// What becomes of the rows of a recording before anything is learned.
struct PreparedStates {
  ScreenReport screen;
  LagReport lag;              ///< as measured, taken off or not
  double taken_off = 0.0;     ///< [s]
  std::vector<State> states;  ///< paired, with velocities
};

/// Screens, aligns and pairs. base::InputError: no motion has both streams at once.
PreparedStates prepare(const std::vector<RawMotion>& motions, const LearningOptions& options);

struct LearningReport {
  PreparedStates prepared;
  CleaningReport cleaning;  ///< of prepared.states; where nothing is cleaned all count
  CorrectionModel model;
  bool cancelled = false;
};

/// Learns a correction from motions. base::InputError: too few states are left, or no rigid offset relates
/// what was seen to what was told (wrong units, swapped axes).
LearningReport learn(const std::vector<RawMotion>& motions, const LearningOptions& options = {},
                     base::Progress* progress = nullptr);

}  // namespace capstan::learning
