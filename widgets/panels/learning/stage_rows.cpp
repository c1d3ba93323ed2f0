#include "widgets/panels/learning/stage_rows.h"

#include <QObject>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "widgets/figures/figure_text.h"
#include "widgets/panels/learning/learning_figures.h"

namespace capstan::widgets {

using namespace learning;
using learning::Reason;
using learning::StreamKind;

namespace {

constexpr int kLargeRatio = 1000;

QString tr(const char* words) { return QObject::tr(words); }

/// Number with one decimal, in mm or in degrees.
QString shown(double value, bool angle = false) {
  return withMinus(QString::number(base::degreesOrMillimetres(value, angle), 'f', 1));
}

/// One line per reason of exclusion, the most frequent first.
template <class Count>
void addReasons(StageGroup& group, std::size_t all, const Count& count) {
  std::vector<std::pair<std::size_t, Reason>> found;
  for (const auto& [reason, words] : base::NamesOf<Reason>::value)
    if (const std::size_t n = count(reason); reason != Reason::kNone && n > 0) found.emplace_back(n, reason);
  std::sort(found.rbegin(), found.rend());
  for (const auto& [n, reason] : found)
    group.rows.push_back({QStringLiteral("    ") + QString::fromStdString(std::string(base::nameOf(reason))),
                          countText(n),
                          static_cast<double>(n) / static_cast<double>(std::max<std::size_t>(all, 1)), true});
}

StageGroup screening(const LearningStages& stages) {
  StageGroup group{tr("1  Screening"), {}};
  for (const StreamKind stream : {StreamKind::kCamera, stages.towards}) {
    const auto s = static_cast<std::size_t>(stream);
    const std::size_t rows = stages.screen.rows[s], poses = stages.screen.poses[s];
    group.rows.push_back({QObject::tr("%1: poses of %2 rows").arg(nameOf(stream), countText(rows)),
                          countText(poses),
                          static_cast<double>(poses) / static_cast<double>(std::max<std::size_t>(rows, 1))});
    addReasons(group, rows, [&](Reason reason) { return stages.screen.count(stream, reason); });
  }
  return group;
}

StageGroup pairing(const LearningStages& stages) {
  const double milli = 1e3;
  return {tr("2  Pairing"),
          {{QObject::tr("lag behind the %1, ± σ").arg(nameOf(stages.towards)),
            uncertainText(milli * stages.clock_offset.clock_offset, milli * stages.clock_offset.sigma) +
                QStringLiteral(" ms"),
            std::nan(""), false,
            tr("Delay of observations behind commands: clock offset plus delay of the robot; σ over "
               "trajectories")},
           {tr("states: observations with a commanded pose"), countText(stages.states.size())},
           {tr("observations without a commanded pose"), countText(stages.unpaired)}}};
}

StageGroup velocities(const LearningStages& stages) {
  const auto row = [](const QString& name, const QString& median, const QString& high) {
    return StageRow{name, QObject::tr("%1, %2").arg(median, high)};
  };
  const auto speed = [](double v) { return QString::number(base::toMillimetres(v), 'f', 0); };
  const auto rate = [](double w) { return QString::number(base::toDegrees(w), 'f', 0); };
  return {tr("3  Velocities (five-point stencil)"),
          {row(tr("speed [mm/s]: median, 99 %"), speed(stages.speed.median), speed(stages.speed.high)),
           row(tr("angular speed [deg/s]: median, 99 %"), rate(stages.rotation_rate.median),
               rate(stages.rotation_rate.high))}};
}

StageGroup cleaning(const LearningStages& stages) {
  const std::size_t all = stages.states.size(), kept = stages.cleaning.kept();
  StageGroup group{tr("4  Cleaning"), {}};
  group.rows.push_back({QObject::tr("accepted states, of %1").arg(countText(all)), countText(kept),
                        static_cast<double>(kept) / static_cast<double>(std::max<std::size_t>(all, 1))});
  addReasons(group, all, [&](Reason reason) { return stages.cleaning.count(reason); });
  const auto whole = static_cast<std::size_t>(
      std::count_if(stages.motions.begin(), stages.motions.end(),
                    [](const TrajectoryStates& motion) { return motion.rejected == motion.states(); }));
  group.rows.push_back(
      {QObject::tr("trajectories rejected whole, of %1").arg(countText(stages.motions.size())),
       countText(whole),
       static_cast<double>(whole) / static_cast<double>(std::max<std::size_t>(stages.motions.size(), 1)),
       true});
  return group;
}

StageGroup rigidOffset(const LearningStages& stages) {
  const Eigen::AngleAxisd rotation(stages.offset.linear());
  const Eigen::Vector3d by = stages.offset.translation();
  return {tr("5  Rigid offset"),
          {{tr("rotates by"), shown(rotation.angle(), true) + QStringLiteral("°")},
           {tr("moves by x, y, z"),
            QStringLiteral("%1, %2, %3 mm").arg(shown(by[0]), shown(by[1]), shown(by[2]))},
           {tr("distance, median, before and after"),
            QStringLiteral("%1 → %2 mm")
                .arg(shown(stages.before.median_distance), shown(stages.after.median_distance))},
           {tr("angle, median, before and after"),
            QStringLiteral("%1 → %2°")
                .arg(shown(stages.before.median_angle, true), shown(stages.after.median_angle, true))}}};
}

/// Names of the features, in the order of PoseFeatures::of().
QString featureName(std::size_t feature) {
  static constexpr std::array kNames = {"x", "y", "z", "rx", "ry", "rz", "vx", "vy", "vz", "ωx", "ωy", "ωz"};
  if (feature < kNames.size()) return QString::fromUtf8(kNames[feature]);
  const std::size_t drift = feature - kNames.size();
  return QObject::tr("%1 over %2 s")
      .arg(QString::fromUtf8(kNames[6 + drift % 6]))
      .arg(learning::kSpans[drift / 6]);
}

/// Features with the shortest length-scales: those that a correction depends on most.
QString sharpest(const learning::KernelParameters& parameters) {
  std::vector<std::pair<double, std::size_t>> lengths;
  for (Eigen::Index i = 0; i < parameters.ln_length.size(); ++i)
    lengths.emplace_back(std::exp(parameters.ln_length[i]), static_cast<std::size_t>(i));
  if (lengths.size() < 2) return {};
  std::sort(lengths.begin(), lengths.end());
  QStringList parts;
  for (std::size_t k = 0; k < std::min<std::size_t>(3, lengths.size()); ++k)
    parts << QStringLiteral("%1 %2").arg(featureName(lengths[k].second),
                                         significantText(lengths[k].first, 2));
  return parts.join(QStringLiteral(" · "));
}

/// Parameters of a committee: geometric mean over its members.
learning::KernelParameters middleOf(const learning::Committee& committee) {
  const auto& members = committee.members();
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(members.front().parameters().packed().size());
  for (const learning::SparseProcess& member : members) sum += member.parameters().packed();
  return learning::KernelParameters::unpacked(sum / static_cast<double>(members.size()),
                                              members.front().parameters().kernel);
}

QString inducingWords(const learning::Committee& committee) {
  const QString each = countText(static_cast<std::size_t>(committee.members().front().inducing()));
  const std::size_t members = committee.members().size();
  return members == 1 ? each : QStringLiteral("%1 × %2").arg(countText(members), each);
}

StageGroup process(const LearningReport& learned) {
  StageGroup group{tr("6  Gaussian process"), {}};
  group.rows.push_back({tr("training states"), countText(learned.cleaning.kept())});
  group.rows.push_back({tr("… that cleaning had rejected"), countText(learned.weighing.again.size()),
                        std::nan(""), false,
                        tr("States with the same error on several trajectories, for example where the robot "
                           "does not follow its command. This error can be learned, so they are accepted "
                           "again. States with random errors are not.")});
  group.rows.push_back(
      {tr("… down-weighted"), countText(learned.weighing.down_weighted), std::nan(""), false,
       tr("States that contradict models of other trajectories: an observation with a small jump, or a "
          "trajectory that differs from the others. They have a larger noise variance.")});
  const auto& processes = learned.model.processes();
  if (!processes.empty())
    group.rows.push_back({tr("inducing points"), inducingWords(processes[0]), std::nan(""), false,
                          tr("Members of each committee, whose corrections are averaged, and number of "
                             "inducing points of each")});
  static constexpr std::array kOutputs = {"x", "y", "z", "rx", "ry", "rz"};
  for (std::size_t k = 0; k < processes.size(); ++k) {
    const learning::KernelParameters p = middleOf(processes[k]);
    const double ratio = std::exp(p.ln_signal - p.ln_noise);
    group.rows.push_back(
        {QObject::tr("%1: signal / noise %2; lengths")
             .arg(QString::fromUtf8(kOutputs[k]),
                  ratio < kLargeRatio ? significantText(ratio, 2) : QStringLiteral("> %1").arg(kLargeRatio)),
         sharpest(p), std::nan(""), false,
         tr("Ratio of the standard deviations of correction and noise, and the three features with the "
            "shortest length-scales: position x y z, rotation r, velocity v, angular velocity ω; "
            "length-scales in standard deviations of the feature")});
  }
  return group;
}

StageGroup heldOut(const HeldOutEvaluation& evaluation) {
  StageGroup group{QObject::tr("7  Errors on %1 held-out trajectories").arg(evaluation.motions_held), {}};
  group.rows.push_back({tr("distance, median: observed → offset → corrected"),
                        medianWords(evaluation, true, false) + QStringLiteral(" mm")});
  group.rows.push_back({tr("angle, median: observed → offset → corrected"),
                        medianWords(evaluation, true, true) + QStringLiteral("°")});
  return group;
}

}  // namespace

std::vector<StageGroup> stageGroups(const LearningResults& results) {
  std::vector<StageGroup> groups;
  if (!results.stages) return groups;
  for (const auto& group : {&screening, &pairing, &velocities, &cleaning, &rigidOffset})
    groups.push_back(group(*results.stages));
  if (!results.evaluation || !results.learned) return groups;
  groups.push_back(process(*results.learned));
  groups.push_back(heldOut(*results.evaluation));
  return groups;
}

}  // namespace capstan::widgets
