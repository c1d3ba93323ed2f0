#pragma once

#include <memory>

#include "core/learning/evaluation/correction_study.h"
#include "core/learning/evaluation/correction_trial.h"
#include "core/learning/evaluation/learning_curve.h"
#include "core/learning/evaluation/learning_stages.h"
#include "core/learning/model/learn.h"
#include "widgets/panels/learning/learning_choice.h"

namespace capstan::widgets {

/// How is learned: the same of every figure and table of the panel.
struct LearningSettings {
  learning::LagOptions lag;
  learning::CorrectionTrialOptions trial;

  /// As capstan-cli learn has them.
  LearningSettings();
  /// Of the model that is saved.
  learning::LearningOptions learning(learning::StreamKind towards) const;
  learning::CorrectionStudyOptions study(int splits) const;
  learning::LearningCurveOptions curve() const;
};

/// What there is so far; null: not yet.
struct LearningResults {
  std::shared_ptr<const learning::LearningStages> stages;
  std::shared_ptr<const learning::CorrectionTrial> trial;   ///< errors of trajectories held out
  std::shared_ptr<const learning::LearningReport> learned;  ///< from all of them: what is saved
  std::shared_ptr<const learning::CorrectionStudyReport> study;
  std::shared_ptr<const learning::LearningCurve> curve;
  int splits = 0;  ///< of the study
};

/// What training leaves.
struct TrainedCorrection {
  learning::CorrectionTrial trial;
  learning::LearningReport learned;
};

/// Takes errors on trajectories held out, and learns a model from all, as capstan-cli learn does.
/// base::InputError as correctionTrial() and learning::learnPrepared().
TrainedCorrection trainCorrection(const learning::LearningStages& stages, const LearningSettings& settings,
                                  base::Progress& progress);

/// Reads the tables and goes through all stages up to the rigid offset, in the background. Of several tables
/// trajectories carry the name of theirs. base::InputError as readPoseTable() and learningStages().
learning::LearningStages readStages(const LearningChoice& choice, const LearningSettings& settings,
                                    base::Progress& progress);

}  // namespace capstan::widgets
