#pragma once

#include <memory>

#include "core/experiments/correction_study.h"
#include "core/experiments/correction_trial.h"
#include "core/experiments/learning_curve.h"
#include "core/experiments/learning_stages.h"
#include "widgets/panels/learning/learning_choice.h"

namespace capstan::widgets {

/// How is learned: the same of every figure and table of the panel.
struct LearningSettings {
  learning::LagOptions lag;
  experiments::CorrectionTrialOptions trial;

  LearningSettings() { trial.correction.motion.reset(); }  // as learning::chooseMotion() finds
  experiments::CorrectionStudyOptions study(int splits) const;
  experiments::LearningCurveOptions curve() const;
};

/// What there is so far; null: not yet.
struct LearningResults {
  std::shared_ptr<const experiments::LearningStages> stages;
  std::shared_ptr<const experiments::CorrectionTrial> trial;
  std::shared_ptr<const experiments::CorrectionStudyReport> study;
  std::shared_ptr<const experiments::LearningCurve> curve;
  int splits = 0;  ///< of the study
};

/// Reads the tables and goes through all stages up to the rigid offset, in the background. Of several tables
/// trajectories carry the name of theirs. base::InputError as readPoseTable() and learningStages().
experiments::LearningStages readStages(const LearningChoice& choice, const LearningSettings& settings,
                                       base::Progress& progress);

}  // namespace capstan::widgets
