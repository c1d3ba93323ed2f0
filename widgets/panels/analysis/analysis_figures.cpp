#include "widgets/panels/analysis/analysis_figures.h"

#include <QObject>

#include "core/tracking/snapshot.h"

namespace capstan::widgets {

using namespace analysis;
using namespace experiments;

namespace {

QString unitOf(int joint) { return tracking::kJointUnits[static_cast<std::size_t>(joint)]; }

QString titleOf(int joint, const std::array<QString, 3>& names) {
  const QString& name = names[static_cast<std::size_t>(joint)];
  const QString symbol = QStringLiteral("q%1").arg(joint + 1);
  return name.isEmpty() ? symbol : symbol + QLatin1Char(' ') + name;
}

QString noteOf(const Analysis& analysis) {
  QStringList parts;
  for (const std::string& run : runWords(analysis)) parts << QString::fromStdString(run);
  if (analysis.title_b.empty()) parts.front().remove(0, QStringLiteral("A: ").size());
  parts << QString::fromStdString(thinningWords(analysis));
  if (analysis.options.share == TimeShare::kOccluded) parts << QObject::tr("only occluded time");
  if (analysis.options.share == TimeShare::kVisible) parts << QObject::tr("only time with the marker seen");
  parts.removeAll({});
  return parts.join(QStringLiteral("; "));
}

/// Values of one estimator and joint, for both runs if there are two.
std::vector<std::vector<double>> valuesOf(const Analysis& analysis, const ErrorRun& a, const ErrorRun* b,
                                          int joint, Estimator estimator) {
  std::vector<std::vector<double>> values{selectedErrors(a, estimator, joint, analysis.options).value};
  if (b) values.push_back(selectedErrors(*b, estimator, joint, analysis.options).value);
  return values;
}

void addJoint(AnalysisFigures& figures, const Analysis& analysis, const ErrorRun& a, const ErrorRun* b,
              int joint, const QString& title) {
  HistogramPanel together{title, unitOf(joint), {}};
  BoxplotPanel boxes{title, unitOf(joint), QObject::tr("run"), {{QStringLiteral("A"), {}}}};
  if (b) boxes.groups.push_back({QStringLiteral("B"), {}});
  for (const Estimator estimator : analysis.options.estimators) {
    const Quantity quantity = quantityOf(estimator);
    auto values = valuesOf(analysis, a, b, joint, estimator);
    for (std::size_t run = 0; run < values.size(); ++run)
      boxes.groups[run].boxes.push_back({{quantity}, boxplotOf(values[run])});
    if (!b) {
      together.series.push_back({{quantity}, std::move(values[0])});
      continue;
    }
    figures.histogram.panels.push_back({title + QStringLiteral(", ") + nameOf(quantity),
                                        unitOf(joint),
                                        {{{quantity, 0, QStringLiteral("A")}, std::move(values[0])},
                                         {{quantity, 1, QStringLiteral("B")}, std::move(values[1])}},
                                        joint});
  }
  if (!b) figures.histogram.panels.push_back(std::move(together));
  figures.boxplot.panels.push_back(std::move(boxes));
}

}  // namespace

Quantity quantityOf(Estimator estimator) {
  return estimator == Estimator::kCamera ? Quantity::kCamera
         : estimator == Estimator::kUkf  ? Quantity::kUkf
                                         : Quantity::kKinematic;
}

AnalysisFigures analysisFigures(const Analysis& analysis, const ErrorRun& a, const ErrorRun* b,
                                const std::array<QString, 3>& joint_names) {
  AnalysisFigures figures;
  const QString of = b ? QObject::tr("A and B") : QString::fromStdString(analysis.title_a);
  const bool own = a.own_kinematics || (b && b->own_kinematics);
  const QString errors =
      own ? QObject::tr("differences from the robot's own kinematics") : QObject::tr("errors");
  const QString error = own ? QObject::tr("difference") : QObject::tr("error");
  figures.histogram.title = QObject::tr("Histogram of %1, %2").arg(errors, of);
  figures.boxplot.title = QObject::tr("Box plot of %1, %2").arg(errors, of);
  figures.histogram.note = figures.boxplot.note = noteOf(analysis);
  const QString quantity =
      analysis.options.absolute ? QStringLiteral("|%1|").arg(error) : QObject::tr("signed %1").arg(error);
  figures.histogram.quantity = figures.boxplot.quantity = quantity;
  const auto& chosen = analysis.options.estimators;
  // Where sample counts differ, shares are what can be compared.
  figures.histogram.density =
      b || std::find(chosen.begin(), chosen.end(), Estimator::kCamera) != chosen.end();
  for (const int joint : analysis.options.joints())
    addJoint(figures, analysis, a, b, joint, titleOf(joint, joint_names));
  return figures;
}

}  // namespace capstan::widgets
