#include "widgets/panels/learning/learning_work.h"

#include <filesystem>

#include "core/recording/pose_table.h"

namespace capstan::widgets {

LearningSettings::LearningSettings() {
  const learning::LearningOptions defaults;
  lag = defaults.lag;
  trial.cleaning = defaults.cleaning;
  trial.weigh = defaults.weigh;
  trial.correction.motion = defaults.correction.motion;
}

learning::LearningOptions LearningSettings::learning(learning::StreamKind towards) const {
  learning::LearningOptions options;
  options.towards = towards;
  options.lag = lag;
  options.weigh = trial.weigh;
  options.cleaning = trial.cleaning;
  options.correction = trial.correction;
  return options;
}

TrainedCorrection trainCorrection(const learning::LearningStages& stages, const LearningSettings& settings,
                                  base::Progress& progress) {
  learning::CorrectionTrial trial = correctionTrial(stages.states, settings.trial, &progress);
  learning::LearningReport learned{{}, {}, {}, learning::CorrectionModel(learning::CorrectionParts{}), true};
  if (!trial.cancelled)
    learned = learning::learnPrepared({stages.screen, stages.lag, stages.lag.lag, stages.states, false},
                                      settings.learning(stages.told), &progress,
                                      {0.0, 1.0, "learning from all trajectories"});
  trial.cancelled = trial.cancelled || learned.cancelled;
  return {std::move(trial), std::move(learned)};
}

learning::CorrectionStudyOptions LearningSettings::study(int splits) const {
  learning::CorrectionStudyOptions options;
  options.splits = splits;
  options.test_share = trial.test_share;
  options.cleaning = trial.cleaning;
  options.correction = trial.correction;
  options.seed = trial.seed;
  return options;
}

learning::LearningCurveOptions LearningSettings::curve() const {
  learning::LearningCurveOptions options;
  options.test_share = trial.test_share;
  options.cleaning = trial.cleaning;
  options.correction = trial.correction;
  options.seed = trial.seed;
  return options;
}

learning::LearningStages readStages(const LearningChoice& choice, const LearningSettings& settings,
                                    base::Progress& progress) {
  std::vector<learning::RawMotion> motions;
  for (const QString& table : choice.tables) {
    const std::filesystem::path path = table.toStdString();
    progress.report(0.0, "reading " + path.filename().string());
    for (learning::RawMotion& motion : recording::readPoseTable(path)) {
      if (choice.tables.size() > 1) motion.name = path.stem().string() + ", " + motion.name;
      motions.push_back(std::move(motion));
    }
    if (progress.cancelled()) return {};
  }
  std::vector<std::string> paths;
  for (const QString& table : choice.tables) paths.push_back(table.toStdString());
  return recording::namingTables(paths, [&] {
    return learning::learningStages(motions, {choice.told, settings.lag, settings.trial.cleaning}, &progress);
  });
}

}  // namespace capstan::widgets
