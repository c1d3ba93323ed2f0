#include "core/experiments/correction_experiment.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/learning/evaluation/learning_stages.h"
#include "core/recording/pose_table.h"

namespace capstan::experiments {
namespace {

using E = CorrectionExperiment;

constexpr std::string_view kPlace[] = {"table I: errors of corrected poses on trajectories held out",
                                       "section V-B 2, figure 5: errors by number of training states",
                                       "table II: arrival at fragments without looking",
                                       "section V-D: debridement of foam fragments"};

std::string_view placeOf(E experiment) { return kPlace[static_cast<std::size_t>(experiment)]; }

void checkPoses(const CorrectionExperimentOptions& options) {
  const std::string name(base::nameOf(options.experiment));
  if (needsPoses(options.experiment) && options.poses.empty())
    throw base::InputError({{},
                            0,
                            "experiment",
                            name,
                            "needs a table of tip poses",
                            "Give one with the columns traj, t_cam_s, cam_x … and the same of cmd or robot"});
  if (!needsPoses(options.experiment) && !options.poses.empty())
    throw base::InputError({options.poses.front(),
                            0,
                            {},
                            {},
                            "is not for experiment " + name + ", which simulates",
                            "Leave it out, or run experiment E or F"});
}

/// Training states from the tables of tip poses.
learning::LearningStages stagesOf(const CorrectionExperimentOptions& options, base::Progress& progress) {
  learning::LearningOptions preparing;
  preparing.towards = options.towards;
  preparing.cleaning = options.errors.cleaning;
  return recording::namingTables(options.poses, [&] {
    return learning::learningStages(recording::readPoseTables(options.poses, &progress), preparing,
                                    &progress);
  });
}

std::string tablesWords(const CorrectionExperimentOptions& options, const learning::LearningStages& stages) {
  return fmt::format("Recording: {}, {} trajectories, {} states; poses are compared with the {}.",
                     recording::nameOfTables(options.poses), stages.motions.size(), stages.states.size(),
                     base::nameOf(options.towards));
}

CorrectionExperimentResults errorsOf(const CorrectionExperimentOptions& options, base::Progress& progress) {
  const learning::LearningStages stages = stagesOf(options, progress);
  if (stages.cancelled || progress.cancelled()) return {.experiment = options.experiment, .cancelled = true};
  learning::CorrectionStudyReport report = correctionStudy(stages.states, options.errors, &progress);
  CorrectionExperimentResults results{.experiment = options.experiment};
  results.cancelled = report.cancelled;
  results.setting = tablesWords(options, stages) +
                    fmt::format(
                        " {} random splits by trajectory, {:.0f} % of the trajectories held out, errors "
                        "pooled; seed {}. The paper "
                        "has one split of a recording of its own of the da Vinci, which is not published: "
                        "its columns are not of "
                        "this recording.",
                        options.errors.splits, 100.0 * options.errors.test_share, options.errors.seed);
  results.tables = {
      {"table-1-clean", correctionTable(report.clean, learning::paperClean(), "Clean test states")},
      {"table-1-all", correctionTable(report.dirty, learning::paperDirty(), "All test states")}};
  results.found = std::move(report);
  return results;
}

/// Largest decrease of the mean absolute errors from `point` to all states, of x, y, z [m] and of yaw, pitch
/// and roll [rad].
std::pair<double, double> furtherFall(const learning::LearningCurve& curve,
                                      const learning::LearningCurvePoint& point) {
  const learning::Vector6d fall = point.errors.mean - curve.points.back().errors.mean;
  return {fall.head<3>().maxCoeff(), fall.tail<3>().maxCoeff()};
}

base::Table trainingSizeTable(const learning::LearningCurve& curve) {
  base::Table table;
  table.title = "Errors on clean held-out states by number of training states";
  table.columns = {{"share", "%", 1},
                   {"training states", {}, 0},
                   {"distance, mean", "mm", 3},
                   {"distance, median", "mm", 3},
                   {"angle, mean", "deg", 3},
                   {"angle, median", "deg", 3},
                   {"still to fall, position", "mm", 2},
                   {"still to fall, rotation", "deg", 2}};
  const auto row = [&](base::TableCell share, base::TableCell states,
                       const learning::CorrectionErrors& errors, base::TableCell position,
                       base::TableCell rotation) {
    table.rows.push_back({std::move(share), std::move(states), base::toMillimetres(errors.distance),
                          base::toMillimetres(errors.median_distance), base::toDegrees(errors.angle),
                          base::toDegrees(errors.median_angle), std::move(position), std::move(rotation)});
  };
  row("rigid offset", "all", curve.offset, "", "");
  for (const learning::LearningCurvePoint& point : curve.points) {
    const auto [position, rotation] = furtherFall(curve, point);
    row(100.0 * point.share, static_cast<double>(point.states), point.errors, base::toMillimetres(position),
        base::toDegrees(rotation));
  }
  table.note =
      "Still to fall: mean absolute error minus that with all states, the largest of the three axes. The "
      "paper: "
      "less than 0.1 mm and 0.1 deg from 460 states (2.5 %) on.";
  return table;
}

CorrectionExperimentResults trainingSizeOf(const CorrectionExperimentOptions& options,
                                           base::Progress& progress) {
  const learning::LearningStages stages = stagesOf(options, progress);
  if (stages.cancelled || progress.cancelled()) return {.experiment = options.experiment, .cancelled = true};
  learning::LearningCurve curve = learningCurve(stages.states, options.training_size, &progress);
  CorrectionExperimentResults results{.experiment = options.experiment};
  results.cancelled = curve.cancelled;
  results.setting =
      tablesWords(options, stages) +
      fmt::format(
          " {} trajectories are held out; training states are drawn at random from the inliers; seed {}. The "
          "paper gives its curve as a figure and the two numbers in the note.",
          curve.motions_held, options.training_size.seed);
  if (!curve.cancelled) results.tables = {{"training-size", trainingSizeTable(curve)}};
  results.found = std::move(curve);
  return results;
}

CorrectionExperimentResults simulatedOf(const CorrectionExperimentOptions& options,
                                        base::Progress& progress) {
  const bool arrival = options.experiment == E::kArrival;
  DebridementStudyReport report =
      arrival ? runArrival(options.simulated, progress) : runDebridement(options.simulated, progress);
  CorrectionExperimentResults results{.experiment = options.experiment};
  results.cancelled = report.cancelled;
  results.setting = fmt::format(
      "Simulated: a RAVEN-II with seven joints; its truth file sets errors of cables, transmission and "
      "cameras; "
      "seed {}. The paper used another arm, a da Vinci with motion capture.",
      options.simulated.seed);
  if (!report.cancelled) {
    results.tables = {{"training", trainingTable(report)}};
    if (arrival) {
      results.tables.push_back({"table-2", arrivalTable(report)});
    } else {
      results.tables.push_back({"debridement", debridementTable(report, options.simulated)});
      results.tables.push_back({"debridement-beyond", beyondTable(report, options.simulated)});
    }
  }
  results.found = std::move(report);
  return results;
}

}  // namespace

bool needsPoses(CorrectionExperiment experiment) {
  return experiment == E::kErrors || experiment == E::kTrainingSize;
}

CorrectionExperimentResults runCorrectionExperiment(const CorrectionExperimentOptions& options,
                                                    base::Progress& progress) {
  checkPoses(options);
  switch (options.experiment) {
    case E::kErrors:
      return errorsOf(options, progress);
    case E::kTrainingSize:
      return trainingSizeOf(options, progress);
    default:
      return simulatedOf(options, progress);
  }
}

std::string comparisonPage(const CorrectionExperimentResults& results, const std::string& software) {
  std::string page =
      fmt::format("# Experiment {} of the GPR paper: {}\n\n{}\n", base::nameOf(results.experiment),
                  placeOf(results.experiment), results.setting);
  for (const NamedTable& named : results.tables) page += "\n" + base::markdownOf(named.table);
  return page + fmt::format("\nComputed by {}.\n", software);
}

}  // namespace capstan::experiments
