#include "widgets/panels/learning/learning_work.h"

#include "core/recording/pose_table.h"

namespace capstan::widgets {

learning::LearningOptions LearningSettings::towards(learning::StreamKind stream) const {
  learning::LearningOptions options = learning;
  options.towards = stream;
  return options;
}

TrainedCorrection trainCorrection(const learning::LearningStages& stages, const LearningSettings& settings,
                                  base::Progress& progress) {
  constexpr double kEvaluated = 0.5;  // share of the evaluation in the progress
  const learning::LearningOptions options = settings.towards(stages.towards);
  learning::HeldOutEvaluation evaluation =
      evaluateHeldOut(stages, options, settings.hold_out, &progress, {0.0, kEvaluated, "evaluating"});
  learning::LearningReport learned =
      learnPrepared(stages, options, &progress, {kEvaluated, 1.0, "learning from all trajectories"});
  return {std::move(learned), std::move(evaluation)};
}

learning::CorrectionStudyOptions LearningSettings::study(int splits) const {
  learning::CorrectionStudyOptions options;
  options.splits = splits;
  options.test_share = hold_out.share;
  options.cleaning = learning.cleaning;
  options.correction = learning.correction;
  options.seed = hold_out.seed;
  return options;
}

learning::LearningCurveOptions LearningSettings::curve() const {
  learning::LearningCurveOptions options;
  options.test_share = hold_out.share;
  options.cleaning = learning.cleaning;
  options.correction = learning.correction;
  options.seed = hold_out.seed;
  return options;
}

learning::LearningStages readStages(const LearningChoice& choice, const LearningSettings& settings,
                                    base::Progress& progress) {
  std::vector<std::string> paths;
  for (const QString& table : choice.tables) paths.push_back(table.toStdString());
  return recording::namingTables(paths, [&] {
    const auto motions = recording::readPoseTables(paths, &progress);
    return progress.cancelled()
               ? learning::LearningStages{}
               : learning::learningStages(motions, settings.towards(choice.towards), &progress);
  });
}

}  // namespace capstan::widgets
