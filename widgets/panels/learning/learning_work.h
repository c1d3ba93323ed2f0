#pragma once

#include <memory>

#include "core/learning/evaluation/correction_study.h"
#include "core/learning/evaluation/evaluate.h"
#include "core/learning/evaluation/learning_curve.h"
#include "core/learning/evaluation/learning_stages.h"
#include "core/learning/model/learn.h"
#include "widgets/panels/learning/learning_choice.h"

namespace capstan::widgets {

/// Settings of learning and evaluation, common to all figures and tables of the panel. Defaults are those of
/// capstan-cli learn.
struct LearningSettings {
  learning::LearningOptions learning;  ///< options of learning; LearningChoice sets `towards`
  learning::HoldOut hold_out;

  learning::LearningOptions towards(learning::StreamKind stream) const;
  learning::CorrectionStudyOptions study(int splits) const;
  learning::LearningCurveOptions curve() const;
};

/// Results so far; null: not computed yet.
struct LearningResults {
  std::shared_ptr<const learning::LearningStages> stages;
  std::shared_ptr<const learning::LearningReport> learned;  ///< trained on all trajectories; this is saved
  std::shared_ptr<const learning::HeldOutEvaluation> evaluation;
  std::shared_ptr<const learning::CorrectionStudyReport> study;
  std::shared_ptr<const learning::LearningCurve> curve;
  int splits = 0;  ///< number of splits of the study
};

/// Result of training.
struct TrainedCorrection {
  learning::LearningReport learned;
  learning::HeldOutEvaluation evaluation;
};

/// Evaluates on held-out trajectories, and trains a model on all trajectories. Throws base::InputError as
/// evaluateHeldOut() and learnPrepared().
TrainedCorrection trainCorrection(const learning::LearningStages& stages, const LearningSettings& settings,
                                  base::Progress& progress);

/// Reads the tables and runs all stages up to the rigid offset, in the background. Throws base::InputError as
/// readPoseTables() and learningStages().
learning::LearningStages readStages(const LearningChoice& choice, const LearningSettings& settings,
                                    base::Progress& progress);

}  // namespace capstan::widgets
