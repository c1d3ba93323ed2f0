#pragma once

#include <memory>

#include "core/learning/evaluation/correction_study.h"
#include "core/learning/evaluation/evaluate.h"
#include "core/learning/evaluation/learning_curve.h"
#include "core/learning/evaluation/learning_stages.h"
#include "core/learning/model/learn.h"
#include "widgets/panels/learning/learning_choice.h"

namespace capstan::widgets {

/// How is learned and evaluated: the same of every figure and table of the panel. Defaults are those of
/// capstan-cli learn.
struct LearningSettings {
  learning::LearningOptions learning;  ///< towards: as the choice of tables says
  learning::HoldOut hold_out;

  learning::LearningOptions towards(learning::StreamKind stream) const;
  learning::CorrectionStudyOptions study(int splits) const;
  learning::LearningCurveOptions curve() const;
};

/// What there is so far; null: not yet.
struct LearningResults {
  std::shared_ptr<const learning::LearningStages> stages;
  std::shared_ptr<const learning::LearningReport> learned;  ///< from all trajectories: what is saved
  std::shared_ptr<const learning::HeldOutEvaluation> evaluation;
  std::shared_ptr<const learning::CorrectionStudyReport> study;
  std::shared_ptr<const learning::LearningCurve> curve;
  int splits = 0;  ///< of the study
};

/// What training leaves.
struct TrainedCorrection {
  learning::LearningReport learned;
  learning::HeldOutEvaluation evaluation;
};

/// Evaluates on trajectories held out, and learns a model from all. base::InputError as evaluateHeldOut() and
/// learnPrepared().
TrainedCorrection trainCorrection(const learning::LearningStages& stages, const LearningSettings& settings,
                                  base::Progress& progress);

/// Reads the tables and goes through all stages up to the rigid offset, in the background. base::InputError
/// as readPoseTables() and learningStages().
learning::LearningStages readStages(const LearningChoice& choice, const LearningSettings& settings,
                                    base::Progress& progress);

}  // namespace capstan::widgets
