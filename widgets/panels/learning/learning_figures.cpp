#include "widgets/panels/learning/learning_figures.h"

#include <QLocale>
#include <QObject>
#include <cmath>

#include "core/base/units.h"
#include "core/learning/poses/pose_features.h"
#include "core/stats/quantile.h"
#include "widgets/figures/figure_text.h"

namespace capstan::widgets {

using namespace learning;
using learning::Reason;
using learning::State;

namespace {

constexpr std::array kSteps = {PoseSource::kVisible, PoseSource::kOffset, PoseSource::kCorrected};

const StepErrors& errorsOf(const HeldOutEvaluation& evaluation, bool clean) {
  return clean ? evaluation.test.clean : evaluation.test.all;
}

/// One value per state, in units for people.
template <class Take>
BoxplotPanel errorPanel(const QString& title, bool angle, const StepErrors& errors, bool observed,
                        const Take& take) {
  BoxplotPanel panel{title, angle ? QObject::tr("deg") : QObject::tr("mm"), QObject::tr("held out"), {}};
  BoxplotGroup group{QObject::tr("states"), {}};
  for (std::size_t s = observed ? 0 : 1; s < kSteps.size(); ++s) {
    std::vector<double> values = take(errors[s]);
    for (double& value : values) value = base::degreesOrMillimetres(value, angle);
    group.boxes.push_back({{quantityOf(kSteps[s]), 0, {}, nameOf(kSteps[s])}, boxplotOf(values)});
  }
  panel.groups.push_back(std::move(group));
  return panel;
}

/// The three angles closest to `before`, so that the trace has no jump [deg].
Eigen::Vector3d anglesBeside(const Eigen::Isometry3d& pose, const Eigen::Vector3d& before) {
  const Eigen::Vector3d now = learning::yawPitchRoll(pose.linear()).unaryExpr(&base::toDegrees);
  return before + (now - before).unaryExpr([](double apart) { return std::remainder(apart, 360.0); });
}

void append(std::array<std::vector<double>, 6>& history, const Eigen::Isometry3d& pose,
            const Eigen::Vector3d& angles) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    history[static_cast<std::size_t>(k)].push_back(base::toMillimetres(pose.translation()[k]));
    history[static_cast<std::size_t>(k) + 3].push_back(angles[k]);
  }
}

}  // namespace

QString countText(std::size_t count) { return QLocale(QLocale::English).toString(qulonglong(count)); }

ClockOffsetData clockOffsetData(const LearningStages& stages) {
  return {QObject::tr("Lag of camera observations behind the %1").arg(nameOf(stages.towards)),
          {},
          stages.clock_offset};
}

BoxplotData errorData(const HeldOutEvaluation& evaluation, bool clean, bool observed) {
  const StepErrors& errors = errorsOf(evaluation, clean);
  BoxplotData data;
  data.title = QObject::tr("Errors on %1 of %2 trajectories, held out of training")
                   .arg(evaluation.motions_held)
                   .arg(evaluation.motions);
  data.note = clean ? QObject::tr("states accepted by cleaning") : QObject::tr("all states");
  data.quantity = QObject::tr("|error|");
  data.most_columns = 4;
  data.panels.push_back(errorPanel(QObject::tr("distance"), false, errors, observed,
                                   [](const PoseErrors& e) { return e.distance; }));
  for (Eigen::Index k = 0; k < 6; ++k) {
    if (k == 3)
      data.panels.push_back(errorPanel(QObject::tr("angle"), true, errors, observed,
                                       [](const PoseErrors& e) { return e.angle; }));
    data.panels.push_back(errorPanel(QString::fromUtf8(kDegreesOfFreedom[static_cast<std::size_t>(k)]),
                                     k >= 3, errors, observed,
                                     [k](const PoseErrors& e) { return e.along(k); }));
  }
  return data;
}

QString medianWords(const HeldOutEvaluation& evaluation, bool clean, bool angle) {
  QStringList parts;
  for (const PoseErrors& step : errorsOf(evaluation, clean)) {
    const CorrectionErrors sums = step.summed();
    const double median = angle ? sums.median_angle : sums.median_distance;
    parts << QString::number(base::degreesOrMillimetres(median, angle), 'f', 1);
  }
  return parts.join(QStringLiteral(" → "));
}

QString errorWords(const HeldOutEvaluation& evaluation, bool clean) {
  return QObject::tr("position\u00a0%1, angle\u00a0%2")
      .arg(unbroken(medianWords(evaluation, clean, false) + QStringLiteral(" mm")),
           unbroken(medianWords(evaluation, clean, true) + QStringLiteral("°")));
}

QString motionWords(learning::Motion motion) {
  switch (motion) {
    case learning::Motion::kNone:
      return QObject::tr("the pose alone");
    case learning::Motion::kVelocity:
      return QObject::tr("pose and velocity");
    default:
      return QObject::tr("pose, velocity and the last 1.6\u00a0s of motion");
  }
}

LearningCurveData curveData(const LearningCurve& curve) {
  return {QObject::tr("Error against the number of training states"),
          QObject::tr("%1 states of %2 held-out trajectories, accepted by cleaning")
              .arg(countText(curve.offset.states))
              .arg(curve.motions_held),
          curve};
}

PoseTraceData traceData(const LearningStages& stages, const HeldOutEvaluation* evaluation,
                        std::size_t which) {
  const TrajectoryStates& motion = stages.motions[which];
  PoseTraceData data;
  data.title = QString::fromStdString(stages.screen.motions[motion.motion].name);
  data.note =
      QObject::tr("%1 states, %2 rejected").arg(countText(motion.states()), countText(motion.rejected));
  if (evaluation)
    data.note += evaluation->held[motion.motion] ? QObject::tr("; held out of training")
                                                 : QObject::tr("; used for training");
  const Eigen::Isometry3d offset =
      evaluation && evaluation->learned ? evaluation->learned->model.offset() : stages.offset;
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();
  for (std::size_t k = motion.begin; k < motion.end; ++k) {
    const State& state = stages.states[k];
    if (k == motion.begin)
      angles = learning::yawPitchRoll(state.pair.commanded.linear()).unaryExpr(&base::toDegrees);
    angles = anglesBeside(state.pair.commanded, angles);
    const Eigen::Isometry3d moved = offset * state.pair.observed;
    data.t.push_back(state.t - stages.states[motion.begin].t);
    data.rejected.push_back(stages.cleaning.reason[k] != Reason::kNone);
    append(data.history[0], state.pair.commanded, angles);
    append(data.history[1], moved, anglesBeside(moved, angles));
    if (evaluation && !evaluation->corrected.empty())
      append(data.history[2], evaluation->corrected[k], anglesBeside(evaluation->corrected[k], angles));
  }
  return data;
}

ReliabilityData reliabilityData(const HeldOutEvaluation& evaluation) {
  return {QObject::tr("Reliability of the stated errors"),
          QObject::tr("%1 states of %2 held-out trajectories, accepted by cleaning")
              .arg(countText(evaluation.test.stated.states()))
              .arg(evaluation.motions_held),
          evaluation.test.stated};
}

ConfidenceData confidenceData(const learning::ConfidenceSlice& slice) {
  return {QObject::tr("Confidence of the correction, %1 = %2 mm")
              .arg(QLatin1Char("xyz"[slice.axis]))
              .arg(withMinus(QString::number(base::toMillimetres(slice.at), 'f', 1))),
          QObject::tr("at rest, at the centre of the training orientations"), slice};
}

}  // namespace capstan::widgets
