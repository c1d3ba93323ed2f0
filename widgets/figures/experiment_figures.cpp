#include "widgets/figures/experiment_figures.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/error_run.h"
#include "core/base/names.h"
#include "core/experiments/tables.h"
#include "core/experiments/trial_robots.h"
#include "core/stats/running_rms.h"
#include "widgets/figures/boxplot_figure.h"
#include "widgets/figures/convergence_figure.h"
#include "widgets/figures/histogram_figure.h"
#include "widgets/figures/trajectory_figure.h"

namespace capstan::widgets {

namespace {

using experiments::Estimator;
using experiments::IdentifiedParameter;
using experiments::Results;
using experiments::TrialMotion;
using experiments::TrialResult;

constexpr double kDetail = 20.0;  ///< length of a detail [s]
constexpr std::array kJointTitles = {"shoulder q1", "elbow q2", "insertion q3"};
constexpr std::array kCompared = {std::pair{Estimator::kKinematic, Quantity::kKinematic},
                                  std::pair{Estimator::kUkf, Quantity::kUkf}};

QString fromUtf8(const std::string& text) { return QString::fromStdString(text); }

QString unitOf(int joint) {
  return QString::fromLatin1(tracking::kJointUnits[static_cast<std::size_t>(joint)]);
}

/// Title "Experiment C, trial 1"; for results that are no experiment of one letter, their title alone.
QString nameOf(const Results& results, const TrialMotion* trial = nullptr) {
  QString name = results.name.size() == 1 && results.name[0] >= 'A' && results.name[0] <= 'Z'
                     ? QStringLiteral("Experiment ") + fromUtf8(results.name)
                     : fromUtf8(results.title.empty() ? results.name : results.title);
  const std::size_t trials =
      results.identification ? results.identification->motions.size() : results.trials.size();
  if (trial && trials > 1) name += QStringLiteral(", ") + fromUtf8(trial->name);
  return name;
}

/// Whether the reference is the robot's own kinematics, not joint encoders.
bool withoutEncoders(const Results& results) {
  return std::any_of(results.trials.begin(), results.trials.end(),
                     [](const TrialResult& trial) { return trial.own_kinematics; });
}

/// Name of the differences: without joint encoders they are not errors.
QString errorWord(const Results& results) {
  return withoutEncoders(results) ? QObject::tr("difference from the robot's kinematics")
                                  : QObject::tr("error");
}

QString shortErrorWord(const Results& results) {
  return withoutEncoders(results) ? QObject::tr("difference") : QObject::tr("error");
}

QString robotWord(const Results& results) {
  return results.simulated ? QObject::tr("simulated robot") : QObject::tr("recorded robot");
}

QString noteOf(const Results& results, const TrialMotion& trial) {
  QString note = robotWord(results) + QObject::tr(", %1 s").arg(trial.duration(), 0, 'f', 0);
  if (trial.occluded_share > 0.0)
    note += QObject::tr(", %1 % occluded").arg(100.0 * trial.occluded_share, 0, 'f', 0);
  return note;
}

/// Note: whose kinematics and filter, and how many of the samples a distribution is drawn from.
QString errorNote(const Results& results, const TrialResult& trial, bool distribution) {
  QString note;
  const QString robots = fromUtf8(experiments::robotWords(experiments::kinematicRobotOf(trial),
                                                          experiments::filterRobotOf(results, trial)));
  if (!robots.isEmpty()) note += QStringLiteral("; ") + robots;
  const auto all = trial.counts[static_cast<std::size_t>(Estimator::kUkf)];
  if (distribution)
    note += trial.errors.size() < all ? QObject::tr("; %1 of %2 samples").arg(trial.errors.size()).arg(all)
                                      : QObject::tr("; n = %1").arg(trial.errors.size());
  return note;
}

std::vector<double> inUnit(std::vector<double> values, int joint) {
  for (double& value : values) value = experiments::forPeople(value, joint);
  return values;
}

/// RMS of the whole trial as in the tables; for a part of the trial, over the thinned series.
TrajectoryRms rmsOf(const TrialResult& trial, double begin, double end) {
  const auto at = [](Estimator which) { return static_cast<std::size_t>(which); };
  if (begin <= trial.begin && end >= trial.end)
    return {trial.rmsOf(Estimator::kKinematic), trial.rmsOf(Estimator::kUkf),
            trial.counts[at(Estimator::kKinematic)], trial.counts[at(Estimator::kUkf)]};
  stats::RunningRms<3> kinematic, ukf;
  for (const experiments::ErrorPoint& point : trial.errors) {
    if (point.t < begin || point.t > end) continue;
    kinematic.add(point.kinematic);
    ukf.add(point.ukf);
  }
  return {kinematic.value(), ukf.value(), kinematic.count(), ukf.count()};
}

/// `result`: result of a tracked trial; null: the trial was used for identification, and only its motion is
/// stored.
std::unique_ptr<Figure> trajectory(const Results& results, const TrialMotion& trial,
                                   const TrialResult* result, double begin, double end) {
  TrajectoryData data{.title = nameOf(results, &trial) + QObject::tr(": joint positions"),
                      .note = noteOf(results, trial)};
  data.own_kinematics = result && result->own_kinematics;
  if (result && !result->errors.empty()) {
    data.rms = rmsOf(*result, begin, end);
    data.note += errorNote(results, *result, false);
  }
  if (begin > trial.begin || end < trial.end)
    data.note += QObject::tr("; here %1 s to %2 s").arg(begin, 0, 'f', 0).arg(end, 0, 'f', 0);
  if (results.identification) data.note += QObject::tr("; UKF with the robot from before the identification");
  auto camera = trial.camera.begin();
  for (const auto& point : trial.trajectory) {
    // Observations are drawn at their own times of exposure, which a thinned trajectory does not contain.
    const experiments::CameraPoint* seen = nullptr;
    for (; camera != trial.camera.end() && camera->t <= point.t; ++camera) seen = &*camera;
    if (point.t < begin || point.t > end) continue;
    data.samples.push_back({.t = point.t,
                            .q_true = point.q_true,
                            .q_kin = point.q_kin,
                            .q_cam = seen ? seen->q : experiments::noJoints(),
                            .q_ukf = point.q_ukf,
                            .sigma = point.sigma,
                            .occluded = point.occluded});
    if (seen) data.samples.back().t_cam = seen->t;
  }
  return std::make_unique<TrajectoryFigure>(std::move(data));
}

/// Beginning of a detail: a quarter of its length before the first occlusion after the trial's first seconds,
/// else in the middle of the trial.
double detailBegin(const TrialMotion& trial) {
  const auto occluded = std::find_if(
      trial.trajectory.begin(), trial.trajectory.end(),
      [&](const auto& point) { return point.occluded && point.t > trial.begin + 0.25 * kDetail; });
  const double about = occluded == trial.trajectory.end() ? 0.5 * (trial.begin + trial.end) : occluded->t;
  return std::clamp(about - 0.25 * kDetail, trial.begin, std::max(trial.begin, trial.end - kDetail));
}

std::unique_ptr<Figure> histogram(const Results& results, const TrialResult& trial) {
  HistogramData data{.title = nameOf(results, &trial) + QStringLiteral(": ") + errorWord(results) +
                              QObject::tr(" of the joint positions"),
                     .note = noteOf(results, trial) + errorNote(results, trial, true),
                     .quantity = QObject::tr("error")};
  if (trial.own_kinematics) data.quantity = QObject::tr("difference");
  for (int joint = 0; joint < 3; ++joint) {
    HistogramPanel panel{kJointTitles[static_cast<std::size_t>(joint)], unitOf(joint), {}};
    for (const auto& [estimator, quantity] : kCompared)
      panel.series.push_back({{quantity}, inUnit(trial.errorsOf(estimator, joint), joint)});
    data.panels.push_back(std::move(panel));
  }
  return std::make_unique<HistogramFigure>(std::move(data));
}

/// Errors of kinematics and UKF; absolute errors of the UKF alone, whose change the figure shows.
BoxplotGroup groupOf(const TrialResult& trial, const QString& label, int joint, bool absolute) {
  BoxplotGroup group{label, {}};
  for (const auto& [estimator, quantity] : kCompared) {
    if (absolute && estimator != Estimator::kUkf) continue;
    group.boxes.push_back(
        {{quantity},
         boxplotOf(inUnit(
             absolute ? trial.absoluteErrors(estimator, joint) : trial.errorsOf(estimator, joint), joint))});
  }
  return group;
}

/// "3" for "trial 3", on an axis that is labelled "trial".
QString shortName(const TrialResult& trial) {
  const QString name = fromUtf8(trial.name);
  return name.startsWith(QLatin1String("trial ")) ? name.mid(6) : name;
}

std::unique_ptr<Figure> boxesOfTrials(const Results& results, const std::vector<int>& joints) {
  BoxplotData data{
      .title = nameOf(results) + QObject::tr(": signed ") + errorWord(results) +
               (joints.size() == 1 ? QObject::tr(" of joint %1").arg(joints[0] + 1) : QString()),
      .note = robotWord(results) + errorNote(results, results.trials.front(), results.trials.size() == 1),
      .quantity = QObject::tr("signed %1").arg(shortErrorWord(results))};
  for (const int joint : joints) {
    BoxplotPanel panel{.title = kJointTitles[static_cast<std::size_t>(joint)],
                       .unit = unitOf(joint),
                       .x_label = QObject::tr("trial")};
    for (const TrialResult& trial : results.trials)
      panel.groups.push_back(groupOf(trial, shortName(trial), joint, false));
    data.panels.push_back(std::move(panel));
  }
  return std::make_unique<BoxplotFigure>(std::move(data));
}

std::unique_ptr<Figure> boxesByOcclusion(const Results& results) {
  BoxplotData data{
      .title = nameOf(results) + QObject::tr(": absolute %1 of the UKF by occlusion").arg(errorWord(results)),
      .note = robotWord(results) + errorNote(results, results.trials.front(), false),
      .quantity = QStringLiteral("|%1|").arg(shortErrorWord(results))};
  for (int joint = 0; joint < 3; ++joint) {
    BoxplotPanel panel{.title = kJointTitles[static_cast<std::size_t>(joint)],
                       .unit = unitOf(joint),
                       .x_label = QObject::tr("occlusion [%]")};
    for (const TrialResult& trial : results.trials)
      panel.groups.push_back(groupOf(trial, QString::number(trial.occlusion.percentage), joint, true));
    data.panels.push_back(std::move(panel));
  }
  return std::make_unique<BoxplotFigure>(std::move(data));
}

/// Parameter name without joint number: "k_e" for "k_e2".
std::string kindOf(const IdentifiedParameter& parameter) {
  std::string kind = parameter.name;
  while (!kind.empty() && kind.back() >= '0' && kind.back() <= '9') kind.pop_back();
  return kind;
}

/// Parameters of one figure, and its name: stiffness and damping of the cables share a figure.
std::string sheetOf(const IdentifiedParameter& parameter) {
  const std::string kind = kindOf(parameter);
  return kind == "k_e" || kind == "b_e" ? "cables" : experiments::fileNameOf(kind);
}

ConvergencePanel panelOf(const Results& results, std::size_t index) {
  const auto& identification = *results.identification;
  const IdentifiedParameter& parameter = identification.parameters[index];
  ConvergencePanel panel{.title = fromUtf8(parameter.words) + QStringLiteral(", ") + fromUtf8(parameter.name),
                         .unit = fromUtf8(parameter.unit),
                         .nominal = parameter.nominal * parameter.scale,
                         .settled_at = parameter.settled_at,
                         .seen = parameter.dual_ukf.seen,
                         .group = parameter.name.back()};
  if (std::isfinite(parameter.truth)) panel.truth = parameter.truth * parameter.scale;
  for (const auto& point : identification.trace) {
    panel.t.push_back(point.t);
    panel.value.push_back(point.value[index] * parameter.scale);
    panel.sigma.push_back(point.sigma[index] * parameter.scale);
  }
  return panel;
}

/// Occluded intervals in the time of the trace, in which recordings follow each other one second apart.
std::vector<TimeInterval> occludedTime(const experiments::IdentificationResult& identification) {
  constexpr double kApart = 1.0;  // identification::append() [s]
  std::vector<TimeInterval> spans;
  double begin = 0.0;
  for (const TrialMotion& motion : identification.motions) {
    bool open = false;
    for (const auto& point : motion.trajectory) {
      const double t = begin + point.t - motion.begin;
      if (open) spans.back().upper = t;
      if (point.occluded && !open) spans.emplace_back(t, t);
      open = point.occluded;
    }
    begin += motion.duration() + kApart;
  }
  return spans;
}

/// For experiments of the paper, their title.
QString whatIsIdentified(const Results& results) {
  return results.title.empty() || !experiments::isPapers(results) ? QObject::tr("identified parameters")
                                                                  : fromUtf8(results.title);
}

std::unique_ptr<Figure> parametersOver(const Results& results, const std::string& sheet) {
  const auto& parameters = results.identification->parameters;
  ConvergenceData data{
      .title = nameOf(results) + QStringLiteral(": ") + whatIsIdentified(results),
      .note = robotWord(results) +
              QObject::tr(", dual UKF, %1 s").arg(results.identification->duration, 0, 'f', 0)};
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (sheetOf(parameters[i]) == sheet) members.push_back(i);
  // One row per joint: stiffness beside damping.
  std::stable_sort(members.begin(), members.end(), [&](std::size_t a, std::size_t b) {
    return parameters[a].name.back() < parameters[b].name.back();
  });
  for (const std::size_t i : members) data.panels.push_back(panelOf(results, i));
  data.occluded = occludedTime(*results.identification);
  return std::make_unique<ConvergenceFigure>(std::move(data));
}

bool differInOcclusion(const Results& results) {
  return std::any_of(results.trials.begin(), results.trials.end(), [&](const TrialResult& trial) {
    return trial.occlusion.percentage != results.trials[0].occlusion.percentage;
  });
}

void addMotion(std::vector<ExperimentFigure>& figures, const Results& results, const TrialMotion& trial,
               const TrialResult* result, bool first) {
  if (trial.trajectory.size() < 2) return;
  const std::string end = experiments::fileNameOf(trial.name), start = results.name + "-";
  figures.push_back({start + "trajectory-" + end, FigureKind::kTrajectory,
                     [&, result] { return trajectory(results, trial, result, trial.begin, trial.end); }});
  if (first && trial.duration() > 1.5 * kDetail)
    figures.push_back({start + "detail-" + end, FigureKind::kTrajectory, [&, result] {
                         const double begin = detailBegin(trial);
                         return trajectory(results, trial, result, begin, begin + kDetail);
                       }});
}

void addTrial(std::vector<ExperimentFigure>& figures, const Results& results, const TrialResult& trial) {
  addMotion(figures, results, trial, &trial, &trial == &results.trials[0]);
  if (!trial.errors.empty())
    figures.push_back({results.name + "-histogram-" + experiments::fileNameOf(trial.name),
                       FigureKind::kHistogram, [&] { return histogram(results, trial); }});
}

void addBoxplots(std::vector<ExperimentFigure>& figures, const Results& results) {
  const std::string start = results.name + "-boxplot";
  if (differInOcclusion(results)) {
    figures.push_back(
        {start + "-occlusion", FigureKind::kBoxplot, [&] { return boxesByOcclusion(results); }});
  } else if (results.trials.size() == 1) {
    figures.push_back({start, FigureKind::kBoxplot, [&] { return boxesOfTrials(results, {0, 1, 2}); }});
  } else {
    for (int joint = 0; joint < 3; ++joint)
      figures.push_back({start + "-joint-" + std::to_string(joint + 1), FigureKind::kBoxplot,
                         [&, joint] { return boxesOfTrials(results, {joint}); }});
  }
}

}  // namespace

std::vector<ExperimentFigure> figuresOf(const Results& results) {
  std::vector<ExperimentFigure> figures;
  for (const TrialResult& trial : results.trials) addTrial(figures, results, trial);
  if (std::any_of(results.trials.begin(), results.trials.end(),
                  [](const TrialResult& trial) { return !trial.errors.empty(); }))
    addBoxplots(figures, results);
  if (!results.identification) return figures;
  const std::vector<TrialMotion>& motions = results.identification->motions;
  for (const TrialMotion& motion : motions)
    addMotion(figures, results, motion, nullptr, &motion == &motions[0]);
  if (results.identification->trace.empty()) return figures;
  std::vector<std::string> sheets;
  for (const IdentifiedParameter& parameter : results.identification->parameters)
    if (std::find(sheets.begin(), sheets.end(), sheetOf(parameter)) == sheets.end())
      sheets.push_back(sheetOf(parameter));
  for (const std::string& sheet : sheets)
    figures.push_back({results.name + "-parameters-" + sheet, FigureKind::kParameters,
                       [&results, sheet] { return parametersOver(results, sheet); }});
  return figures;
}

}  // namespace capstan::widgets
